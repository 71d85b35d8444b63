# %% [markdown]
# # A damper
#
# A damper is asymmetric: it resists rebound more than compression. A straight damper is fitted first; the diagnosis
# says what it lacks.

# %%
import dashpot as dp

truth = dp.Network(
    "damper",
    {
        "gas": {"element": "spring", "stiffness": "3 N/mm"},
        "valves": {"element": "asymmetric_damper", "compression": "0.8 N*s/mm", "rebound": "2.4 N*s/mm"},
    },
)
truth

# %% [markdown]
# ## The measurement
#
# Sines of 25 mm with rising frequency, and a slower one for the gas spring; 10 N of noise.

# %%
import numpy as np

rng = np.random.default_rng(2)
time = np.arange(0.0, 3.0, 1e-3)
parts = []
for amplitude in (10.0, 25.0):
    for frequency in (0.5, 1.5, 4.0):
        x = 1e-3 * amplitude * np.sin(2.0 * np.pi * frequency * time)
        name = f"a{amplitude:g}_f{frequency:g}".replace(".", "p")
        motion = dp.Data.from_arrays(time, x, x, name=name, kind="harmonic")  # its force is not known yet
        force = dp.simulate(truth, motion)[name] + 10.0 * rng.normal(size=time.size)
        parts.append(
            dp.Data.from_arrays(
                time,
                x,
                force,
                name=name,
                kind="harmonic",
                settings={"amplitude": 1e-3 * amplitude, "frequency": frequency},
            )
        )
data = dp.Data.join(parts, "damper bench")
data.plot("loops")

# %% [markdown]
# ## A straight damper

# %%
straight = dp.Network(
    "straight",
    {
        "gas": {"element": "spring", "stiffness": {"start": "2 N/mm"}},
        "oil": {"element": "damper", "damping": {"start": "1 N*s/mm"}},
    },
)
diagnosis = dp.diagnose(straight, data)
diagnosis

# %% [markdown]
# ## The extended model

# %%
diagnosis.extended

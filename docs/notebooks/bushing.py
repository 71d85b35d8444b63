# %% [markdown]
# # A rubber bushing
#
# A filled rubber bushing is stiffer when it is shaken less (Payne effect), and stiffer when it is shaken faster. Two of
# the shipped elements are enough to tell the two apart.

# %% [markdown]
# ## The measurement
#
# A model with known parameters stands for the bushing; the rig measures it at three amplitudes and adds noise.

# %%
from pathlib import Path

import dashpot as dp

truth = dp.Network(
    "rubber",
    {
        "elastic": {"element": "spring", "stiffness": "300 N/mm"},
        "relaxation": {"element": "maxwell", "stiffness": "80 N/mm", "relaxation_time": "15 ms"},
        "filler": {"element": "dahl", "stiffness": "250 N/mm", "limit": "25 N"},
    },
)
Path("bench.yaml").write_text("""
format: dashpot-rig/1
name: bench
tests:
  - {rig: hydropulser, amplitudes: [0.1 mm, 0.5 mm, 2 mm], preloads: [3 mm], direction: up, duration: 4 s,
     sampling: 500 Hz}
measuring: {force_noise: 2 N, repeats: 2}
""")
data = dp.measure(truth, "bench.yaml", seed=5)
data.plot("stiffness")

# %% [markdown]
# ## Which structure does it take?

# %%
elastic = {"element": "spring", "stiffness": {"start": "200 N/mm"}}
maxwell = {"element": "maxwell", "stiffness": {"start": "50 N/mm"}, "relaxation_time": {"start": "20 ms"}}
dahl = {"element": "dahl", "stiffness": {"start": "100 N/mm"}, "limit": {"start": "10 N"}}
models = [
    dp.Network("spring", {"elastic": elastic}),
    dp.Network("relaxing", {"elastic": elastic, "relaxation": maxwell}),
    dp.Network("relaxing_and_sliding", {"elastic": elastic, "relaxation": maxwell, "filler": dahl}),
]
comparison = dp.compare(models, data)
comparison

# %% [markdown]
# Only the last one is at the noise floor. Its identified parameters are those of the bushing:

# %%
comparison.fits[-1].table()

# %% [markdown]
# ## A table for a vehicle model
#
# Dynamic stiffness over amplitude, at 10 Hz around the preload:

# %%
import numpy as np

amplitude = np.array([0.1e-3, 0.3e-3, 1e-3, 2e-3])
found = comparison.fits[-1].model.dynamic_stiffness(10.0, amplitude, preload=3e-3)
for size, value in zip(amplitude, found, strict=True):
    print(f"{1e3 * size:.1f} mm: {abs(value) / 1e3:.0f} N/mm, {np.degrees(np.angle(value)):.1f} deg")

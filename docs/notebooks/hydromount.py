# %% [markdown]
# # A hydraulic mount
#
# An engine mount with an inertia track: the fluid in the track resonates, so that the loss angle peaks at the frequency
# at which the engine bounces. The turbulence in the track makes the peak lower for larger amplitudes.

# %%
import numpy as np

import dashpot as dp

mount = dp.Network(
    "hydromount",
    {
        "rubber": {"element": "spring", "stiffness": "180 N/mm"},
        "loss": {"element": "damper", "damping": "0.15 N*s/mm"},
        "track": {
            "element": "hydro",
            "fluid_mass": "35 kg",
            "stiffness": "160 N/mm",
            "damping": "0.8 N*s/mm",
            "quadratic_damping": "200 kN*s^2/m^2",
        },
    },
)
mount

# %% [markdown]
# ## Over frequency and amplitude

# %%
frequency = np.array([2.0, 5.0, 8.0, 10.0, 12.0, 16.0, 25.0])
amplitude = np.array([0.1e-3, 1.0e-3])
found = mount.dynamic_stiffness(frequency[:, None], amplitude)
print("frequency   0.1 mm               1 mm")
for hertz, row in zip(frequency, found, strict=True):
    print(f"{hertz:6.0f} Hz", *(f"{abs(k) / 1e3:7.0f} N/mm {np.degrees(np.angle(k)):5.1f} deg" for k in row))

# %% [markdown]
# Without turbulence the closed form k_b (-m w^2 + j w d) / (k_b - m w^2 + j w d) tells the track. At 0.1 um the
# turbulence hardly counts:

# %%
turning = 2.0 * np.pi * frequency
channel = -35.0 * turning**2 + 800.0j * turning
closed = 180e3 + 150.0j * turning + 160e3 * channel / (160e3 + channel)
small = mount.dynamic_stiffness(frequency, 1e-7)
print("largest deviation in percent:", (100.0 * abs(small / closed - 1.0)).max().round(2))

# %% [markdown]
# ## From measurements
#
# Sweeps at two amplitudes on a virtual rig without noise; the search starts elsewhere.

# %%
data = dp.measure(
    mount,
    "hydropulser",
    amplitudes="0.2 mm, 1 mm",
    preloads="2 mm",
    stop="30 Hz",
    duration="5 s",
    sampling="1 kHz",
    seed=1,
)
start = dp.declare(mount.text)
start["rubber"].stiffness = {"start": "100 N/mm"}
start["loss"].damping = {"start": "0.3 N*s/mm"}
start["track"].fluid_mass = {"start": "20 kg"}
start["track"].stiffness = {"start": "100 N/mm"}
start["track"].damping = {"start": "0.3 N*s/mm"}
start["track"].quadratic_damping = {"start": "50 kN*s^2/m^2"}
fit = dp.fit(start, data)
fit.table()

# %%
fit.plot("stiffness")

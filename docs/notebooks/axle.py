# %% [markdown]
# # An axle on two platforms
#
# Two wheels, two platforms, and a body that is held: a network with nodes. Each platform has a motion of its own, and
# each has a force that is measured.

# %%
import numpy as np

import dashpot as dp

axle = dp.load("axle_model_1")
axle["wheel_left"].mass = "42 kg"
axle

# %% [markdown]
# ## In phase and against each other
#
# The tires stand 20 mm pressed; the platforms move by 3 mm. A run with several ends has its channels at nodes.

# %%
time = np.arange(0.0, 4.0, 1e-3)


def platforms(name, side, frequency):
    left = 3e-3 * np.sin(2.0 * np.pi * frequency * time) * np.minimum(time, 1.0)
    unknown = np.sin(time)  # no force was measured: it is what is computed
    return dp.Data.from_arrays(
        time,
        channels={
            "displacement@platform_left": left,
            "displacement@platform_right": side * left,
            "force@platform_left": unknown,
            "force@platform_right": unknown,
        },
        name=name,
        kind="harmonic",
        settings={"added_mass": 0.0},
    )


frequencies = (4.0, 8.0, 11.0, 14.0, 18.0)
runs = [
    platforms(f"{word}_{frequency:g}", side, frequency)
    for word, side in (("phase", 1.0), ("against", -1.0))
    for frequency in frequencies
]
forces = dp.simulate(axle, dp.Data.join(runs, "platforms"))

# %% [markdown]
# The amplitude of the contact force at the left wheel over frequency: the wheel resonates on its tire, and against each
# other the anti-roll bar adds to the stiffness.

# %%
last = time > 2.0
print("frequency   in phase   against")
for frequency in frequencies:
    pair = [np.ptp(forces[f"{word}_{frequency:g}@platform_left"][last]) / 2.0 for word in ("phase", "against")]
    print(f"{frequency:6.0f} Hz", *(f"{force:8.0f} N" for force in pair))

# %% [markdown]
# ## Where the work goes

# %%
from dashpot.data.excitation import Excitation

balance = dp.energy_balance(axle, Excitation.of_run(runs[2].runs[0]))
print(f"put in {balance.put_in:.1f} J")
for share in sorted(balance.branches, key=lambda share: -share.work)[:4]:
    print(f"{share.name:30} {share.work:8.2f} J")

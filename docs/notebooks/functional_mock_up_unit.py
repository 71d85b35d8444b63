# %% [markdown]
# # A functional mock-up unit
#
# A network becomes a unit by FMI 3.0 that other simulators load; here `fmpy` runs it beside dashpot itself. Building it
# needs a C compiler, `cc`.

# %%
import shutil
from pathlib import Path

import numpy as np

import dashpot as dp

mount = dp.Network(
    "mount",
    {
        "rubber": {"element": "spring", "stiffness": "220 N/mm"},
        "relaxation": {"element": "maxwell", "stiffness": "60 N/mm", "relaxation_time": "20 ms"},
        "friction": {"element": "dahl", "stiffness": "400 N/mm", "limit": "20 N"},
    },
)
ready = shutil.which("cc") is not None
files = dp.load_registry().exports["fmu"]().files(mount) if ready else {}
for name, content in files.items():
    Path(name).write_bytes(content)
sizes = {name: f"{len(content) / 1e3:.0f} kB" for name, content in files.items()}
print(sizes or "no C compiler here: nothing was built")

# %% [markdown]
# ## Run by a simulator
#
# The unit takes the deflection and its rate and gives the force, step by step.

# %%
time = np.arange(0.0, 1.0, 1e-3)
turning = 2.0 * np.pi * 5.0
x, v = 1e-3 * np.sin(turning * time), 1e-3 * turning * np.cos(turning * time)
if ready:
    import fmpy

    motion = np.rec.fromarrays([time, x, v], names="time, displacement, velocity")
    run = fmpy.simulate_fmu(
        "mount.fmu", stop_time=time[-1], step_size=1e-3, output_interval=1e-3, input=motion, output=["force"]
    )
    own = dp.simulate(mount, dp.Data.from_arrays(time, x, x, name="sine"))["sine"]
    # what is handed to a step is the motion at its end: the simulator hands it over one step later
    off = run["force"][1 : len(own)] - own[: len(run["force"]) - 1]
    print(f"force up to {np.abs(own).max():.1f} N, the unit differs by {np.abs(off[2:]).max():.2g} N")

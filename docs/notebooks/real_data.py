# %% [markdown]
# # From the files of a rig to a diagnosis
#
# A rig has written CSV files, and the question is what describes the part. This is the whole way: import, check, look,
# correct, compare, diagnose. The commands are those of a terminal; from the comparison on the same is done in Python.
#
# ## The files
#
# So that the answer is known, the files are made here: a mount on a virtual rig, written the way a rig of a German
# laboratory does it, with lines of text on top, semicolons, decimal commas, millimetres and kilonewtons. The load
# cell counts tension as positive, and in one run the charge amplifier was left in another range: its force is twice
# as large as it was.

# %%
from pathlib import Path

import dashpot as dp

mount = dp.Network(
    "mount",
    {
        "rubber": {"element": "spring", "stiffness": "180 N/mm"},
        "damping": {"element": "damper", "damping": "0.3 N*s/mm"},
        "filler": {"element": "prandtl", "stiffness": "120 N/mm", "limit": "25 N"},
    },
)
Path("bench.yaml").write_text("""
format: dashpot-rig/1
name: bench
tests:
  - {rig: triangle, depth: 6 mm, loops: 1}
  - {rig: hydropulser, amplitudes: [0.5 mm, 1 mm], preloads: [2 mm, 4 mm], direction: up, duration: 3 s,
     sampling: 500 Hz}
measuring: {force_noise: 2 N, displacement_noise: 1 um, repeats: 2}
""")

HEAD = "Prüfstand 7;Hydropulser\nProbe;Lager 4711\nBemerkung;nach 3 Zyklen Einlauf\n\nZeit;Weg;Kraft\ns;mm;kN\n"
AMPLIFIED = "a1_p4_up"
Path("rig").mkdir()
for run in dp.measure(mount, "bench.yaml", seed=4).runs:
    force = -run.force * (2.0 if run.name == AMPLIFIED else 1.0)
    columns = zip(run.time, 1e3 * run.displacement, 1e-3 * force, strict=True)
    rows = "\n".join(f"{t:.3f};{x:.4f};{f:.5f}".replace(".", ",") for t, x, f in columns)
    Path("rig", f"{run.name}.csv").write_text(f"{HEAD}{rows}\n", encoding="latin-1")

print("\n".join(Path("rig", "a1_p2_up.csv").read_text(encoding="latin-1").splitlines()[:9]))

# %% [markdown]
# ## Import
#
# `dashpot import` finds columns, units, clock, kinds of runs and repeats, and lists what it guessed.

# %%
import subprocess
import sys


def dashpot(*arguments: str) -> None:
    """A command as in a terminal: what it prints, errors as well."""
    done = subprocess.run([sys.executable, "-m", "dashpot", *arguments], capture_output=True, text=True)
    print(done.stdout + done.stderr)


dashpot("import", "rig")

# %% [markdown]
# The sign of the force was turned: with tension positive the mount would give back work. All sweeps but one have a
# repeat; `a1_p4_up` and `a1_p4_up_b` should be alike and are not.
#
# ## Look
#
# Before any model: are the runs plausible?

# %%
dp.look(dp.load_dataset("rig")).table()

# %% [markdown]
# `a1_p4_up` has twice the stiffness of its neighbours, twice their loss stiffness and twice the force: it is the range
# of the charge amplifier, as the log of the rig confirms. The dataset file gets a gain for this run, and the repeat.
# The measured file stays as it is.

# %%
dataset = Path("rig", "dataset.yaml")
text = dataset.read_text(encoding="utf-8")
text = text.replace(
    "    file: a1_p4_up.csv\n",
    "    file: a1_p4_up.csv\n    channels: {force: {column: Kraft, unit: kN, sign: -1, gain: 0.5}}\n",
)
text = text.replace("    file: a1_p4_up_b.csv\n", "    file: a1_p4_up_b.csv\n    repeats: a1_p4_up\n")
dataset.write_text(text, encoding="utf-8")
dashpot("check", "rig")

# %%
data = dp.load_dataset("rig")
data.plot("stiffness")

# %% [markdown]
# ## Compare
#
# Is one of the simple models good enough? The noise floor comes from the repeats, the error from runs that were held
# out.

# %%
elastic = {"element": "spring", "stiffness": {"start": "150 N/mm"}}
damping = {"element": "damper", "damping": {"start": "0.5 N*s/mm"}}
maxwell = {"element": "maxwell", "stiffness": {"start": "50 N/mm"}, "relaxation_time": {"start": "20 ms"}}
simple = dp.Network("simple", {"rubber": elastic, "damping": damping})
solid = dp.Network("standard_solid", {"rubber": elastic, "maxwell": maxwell})
comparison = dp.compare([simple, solid], data)
comparison.table()

# %% [markdown]
# ## Diagnose
#
# Both are far above the noise. What does the simple one lack?

# %%
diagnosis = dp.diagnose(simple, data)
print(diagnosis.headline)

# %% [markdown]
# The extended network, to be saved, simulated or exported; its parameters can be compared with those of the mount
# above.

# %%
print(diagnosis.extended.text)

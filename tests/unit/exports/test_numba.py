"""What a program without dashpot gets: a module for numba."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from runpy import run_path

import numpy as np
import pytest
from unit.exports.mounts import leg, mount, sine

from dashpot import load_registry
from dashpot.kernel.network import compile_network

PROGRAM = """
import sys
sys.modules["dashpot"] = None  # nobody finds it
import numpy as np
import {name} as network

x, v = np.load("motion.npy")
force = np.empty(x.size)
network.simulate(x, v, {dt!r}, network.PARAMETERS, force)
state, out = network.fresh_state(4e-3), np.empty(len(network.DRIVEN) + len(network.FREE))
stepped = []
for k in range(50):
    network.step_nodes(state, x[k : k + 1], v[k : k + 1], np.empty(0), {dt!r}, network.PARAMETERS, out)
    stepped.append(out[0])
assert network.status(state) == 0
assert np.max(np.abs(stepped - force[:50])) <= 1e-12 * np.max(np.abs(force))
np.save("force.npy", force)
"""


@pytest.mark.parametrize("declared", [mount, leg])
def test_a_program_without_dashpot_gets_the_simulated_force(declared, tmp_path):
    [(file, content)] = load_registry().exports["numba"]().files(declared()).items()
    (tmp_path / file).write_bytes(content)
    drive = sine()
    np.save(tmp_path / "motion.npy", [drive.displacement, drive.velocity])
    program = PROGRAM.format(name=Path(file).stem, dt=drive.dt)
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True)
    network = compile_network(declared())
    expected = network.simulate(network.prepare(drive))
    assert np.max(np.abs(np.load(tmp_path / "force.npy") - expected)) <= 1e-12 * np.max(np.abs(expected))


def test_the_module_tells_where_it_is_from_and_names_its_numbers(tmp_path):
    [(file, content)] = load_registry().exports["numba"]().files(mount()).items()
    (tmp_path / file).write_bytes(content)
    found = run_path(str(tmp_path / file))
    assert found["__doc__"].startswith("mount: network ")
    assert found["NAMES"] == (
        "rubber.stiffness",
        "friction.stiffness",
        "friction.limit",
        "relaxation.stiffness",
        "relaxation.relaxation_time",
    )
    assert found["UNITS"][2] == "N" and found["PARAMETERS"][2] == 60.0

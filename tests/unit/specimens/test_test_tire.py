"""The virtual tire: its laws, what a rig would see of it, and the files."""

import ast
import sys
from pathlib import Path

import numpy as np
import pytest
from seeds import seed_of

import dashpot_specimens
from dashpot_specimens.test_tire import TireOnRig
from dashpot_specimens.tire_laws import Tire
from dashpot_specimens.tire_path import STEP, DrivenPath, loops, sweep

PACKAGE = Path(dashpot_specimens.__file__).parent
ALLOWED = sys.stdlib_module_names | {"numpy", "scipy", "numba", "pluggy", "dashpot_specimens"}


@pytest.fixture(scope="module")
def seed():
    value = seed_of("test_test_tire")
    print(f"seed {value}")
    return value


@pytest.fixture(scope="module")
def folder(seed, tmp_path_factory):
    return TireOnRig().measure(tmp_path_factory.mktemp("tire"), seed).parent


def steady(amplitude, preload, frequency):
    """A path of one frequency, and the complex stiffness of the tire in its last cycle [N/m]."""
    path = sweep(amplitude, preload, frequency, frequency, 2.0)
    turn = np.exp(-2j * np.pi * frequency * STEP * np.arange(path.deflection.size))[-round(1 / frequency / STEP) :]
    force = Tire().force(path)
    return (force[-turn.size :] @ turn) / (path.deflection[-turn.size :] @ turn)


@pytest.mark.parametrize("path", [sweep(5e-3, 17e-3, 1, 25, 10), loops(31e-3, 60, 3)])
def test_velocity_is_the_derivative_of_the_deflection(path):
    slope = np.gradient(path.deflection, STEP, edge_order=2)
    assert np.allclose(slope, path.velocity, atol=2e-4 * np.abs(path.velocity).max())


def test_loops_touch_zero_and_their_depth():
    path = loops(31e-3, 60.0, 3)
    assert path.deflection.min() == pytest.approx(0.0, abs=1e-9)
    assert path.deflection.max() == pytest.approx(31e-3)
    assert path.deflection[-1] == pytest.approx(0.0, abs=1e-6)


def test_dynamic_stiffness_and_loss_angle_are_those_of_a_tire():
    grid = [(x, p, f) for x in (0.25e-3, 2e-3, 5e-3) for p in (10e-3, 17e-3, 25e-3) for f in (2.0, 10.0, 25.0)]
    stiffness = np.array([steady(*at) for at in grid])
    assert 200e3 < np.abs(stiffness).min() and np.abs(stiffness).max() < 340e3
    assert 3.0 < np.degrees(np.angle(stiffness)).min() and np.degrees(np.angle(stiffness)).max() < 8.0


def test_stiffness_falls_with_amplitude_and_rises_with_frequency_and_preload():
    reference = abs(steady(2e-3, 17e-3, 10.0))
    assert abs(steady(5e-3, 17e-3, 10.0)) < reference < abs(steady(0.5e-3, 17e-3, 10.0))
    assert abs(steady(2e-3, 17e-3, 2.0)) < reference < abs(steady(2e-3, 17e-3, 25.0))
    assert abs(steady(2e-3, 10e-3, 10.0)) < reference < abs(steady(2e-3, 25e-3, 10.0))


def test_loss_angle_falls_with_preload():
    angles = [np.angle(steady(5e-3, preload, 10.0)) for preload in (10e-3, 17e-3, 25e-3)]
    assert angles[0] > angles[1] > angles[2]


def test_friction_does_not_depend_on_the_speed():
    there = np.concatenate([np.linspace(10e-3, 20e-3, 4001), np.linspace(20e-3, 12e-3, 4001)[1:]])
    twice_as_fast = np.union1d(np.arange(0, there.size, 2), [4000])
    assert np.allclose(Tire().sliding(there)[twice_as_fast], Tire().sliding(there[twice_as_fast]), atol=1e-6)


def test_relaxing_rubber_in_slow_motion_is_a_damper():
    # the integral of exp(-sqrt(t / T)) is 2 T
    tire, speed = Tire(), 2e-3
    deflection = speed * STEP * np.arange(80_000)
    path = DrivenPath(deflection, np.full(deflection.size, speed))
    level = 1 / (1 + (deflection[-1] / tire.level_length) ** 2)
    damping = tire.relaxing_stiffness * 2 * tire.relaxation_time + tire.damping
    assert tire.relaxing(path)[-1] == pytest.approx(level * damping * speed, rel=1e-4)


def test_carcass_stiffens_from_172_to_250_newtons_per_millimetre():
    x = np.linspace(0.0, 31e-3, 3101)
    tangent = np.diff(Tire().carcass(x)) / np.diff(x)
    assert (np.diff(tangent) > 0).all()
    assert (tangent[0], tangent[-1]) == pytest.approx((172e3, 250e3), rel=0.01)


def test_repeats_differ_by_the_noise_alone(folder):
    first, again = (np.load(folder / name)["F"] for name in ("a5_p25.npz", "a5_p25_b.npz"))
    assert np.std(first - again) / np.sqrt(2) == pytest.approx(9.0, rel=0.15)


def test_csv_is_written_as_rigs_write_it(folder):
    lines = (folder / "qs.csv").read_text().splitlines()
    assert lines[0].startswith("#")
    assert lines[2:4] == ["Time;Displacement;Force", "s;mm;kN"]
    time, displacement, force = (float(cell.replace(",", ".")) for cell in lines[4 + 2000].split(";"))
    assert time == 10.0
    assert displacement == pytest.approx(31.0, abs=0.01)
    assert force == pytest.approx(Tire().carcass(np.array(31e-3)) / 1e3, rel=0.03)


def test_dataset_names_every_file_and_says_what_was_driven(folder):
    text = (folder / "dataset.yaml").read_text()
    files = {file.name for file in folder.iterdir()} - {"dataset.yaml"}
    assert len(files) == 14
    assert all(text.count(f"file: {name}") == 1 for name in files)
    assert "settings: {amplitude: 0.5 mm, preload: 10 mm, start: 1 Hz, stop: 25 Hz}" in text
    assert "repeats: a5_p25" in text


def test_whole_dataset_is_a_few_megabytes_at_most(folder):
    assert sum(file.stat().st_size for file in folder.iterdir()) < 3e6


def test_same_seed_gives_the_same_bytes_and_another_seed_others(seed, folder, tmp_path):
    def contents(place):
        return {file.name: file.read_bytes() for file in place.iterdir()}

    assert contents(TireOnRig().measure(tmp_path / "same", seed).parent) == contents(folder)
    other = contents(TireOnRig().measure(tmp_path / "other", seed + 1).parent)
    assert all(other[name] != data for name, data in contents(folder).items())


def test_a_measured_tire_is_not_measured_again_and_nothing_foreign_is_overwritten(seed, folder):
    before = (folder / "qs.csv").stat().st_mtime_ns
    assert TireOnRig().measure(folder, seed) == folder / "dataset.yaml"
    assert (folder / "qs.csv").stat().st_mtime_ns == before
    with pytest.raises(FileExistsError, match=f"seed {seed + 1}, got another dataset; use an empty folder"):
        TireOnRig().measure(folder, seed + 1)


def test_specimen_shares_nothing_with_dashpot_but_its_base_class():
    outside = {
        (file.name, name)
        for file in PACKAGE.glob("**/*.py")
        for node in ast.walk(ast.parse(file.read_text()))
        for name in imported(node)
        if name.split(".")[0] not in ALLOWED
    }
    assert outside == {(file, "dashpot.contract.specimen") for file in ("test_tire.py", "test_mount.py", "test_car.py")}


def imported(node):
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    return [node.module] if isinstance(node, ast.ImportFrom) and node.level == 0 else []

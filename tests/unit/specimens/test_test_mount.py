"""The virtual hydraulic mount: its laws against closed forms, its amplitude dependence, and the files."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from seeds import seed_of

import dashpot as dp
from dashpot.data.dataset import Dataset
from dashpot_specimens.mount_laws import Mount
from dashpot_specimens.test_mount import MountOnRig
from dashpot_specimens.tire_path import STEP, DrivenPath, loops, sweep

PRELOAD = 3e-3


@pytest.fixture(scope="module")
def seed():
    value = seed_of("test_test_mount")
    print(f"seed {value}")
    return value


@pytest.fixture(scope="module")
def folder(seed, tmp_path_factory):
    return MountOnRig().measure(tmp_path_factory.mktemp("mount"), seed).parent


def steady(mount, amplitude, frequency, fluid_alone=False):
    """Complex stiffness in N/m in the last second, for whole cycles in it."""
    path = sweep(amplitude, PRELOAD, frequency, frequency, 3.0)
    force = mount.piston * mount.pressure(path.velocity) if fluid_alone else mount.force(path)
    last = slice(-round(1.0 / STEP), None)
    turn = np.exp(-2j * np.pi * frequency * STEP * np.arange(path.deflection.size))[last]
    return (force[last] @ turn) / (path.deflection[last] @ turn)


@pytest.mark.parametrize("frequency", [4.0, 8.0, 12.0, 20.0])
def test_a_mount_with_its_plate_stuck_and_no_turbulence_is_the_linear_one(frequency):
    mount = replace(Mount(), loss=0.0, seat_stiffness=1e7, travel=0.0, plate_damping=15.0)
    turn = 2j * np.pi * frequency
    # flow of the track and of the pressed plate between both chambers, by pressure
    flow = 1.0 / (mount.inertance * turn + mount.friction)
    plate = mount.plate**2 * turn / (mount.seat_stiffness + 15.0 * turn + mount.plate_mass * turn**2)
    between = flow + plate
    lower = 1.0 / (1.0 / between + 1.0 / (turn * mount.bellows))
    expected = mount.piston**2 * turn / (turn * mount.bulge + lower)
    assert steady(mount, 1e-3, frequency, fluid_alone=True) == pytest.approx(expected, rel=1e-3)


def test_the_fluid_keeps_out_as_long_as_the_plate_is_free():
    mount = Mount()
    free = mount.travel * mount.plate / mount.piston
    assert abs(steady(mount, 0.6 * free, 8.0, fluid_alone=True)) < 0.05 * mount.piston**2 / mount.bulge
    assert abs(steady(mount, 4.0 * free, 11.0, fluid_alone=True)) > 1.5 * mount.piston**2 / mount.bulge


def test_the_peak_is_highest_at_a_middle_amplitude_and_turbulence_lowers_it_beyond():
    mount = Mount()
    peaks = [
        max(abs(steady(mount, amplitude, frequency)) for frequency in (10.0, 11.0, 12.0, 13.0))
        for amplitude in (0.1e-3, 0.3e-3, 1e-3, 2e-3)
    ]
    assert peaks[0] < 0.5 * peaks[3] and peaks[1] > peaks[2] > peaks[3]


def test_the_pressure_agrees_with_an_integration_of_the_mount_as_masses_and_springs():
    # as felt at the piston: displacements of the fluid in the track and past the plate, in m
    mount, amplitude, frequency, seconds = Mount(), 0.8e-3, 9.0, 0.6
    area = mount.piston**2
    ratio = mount.piston / mount.plate
    walls, bellows, fluid = area / mount.bulge, area / mount.bellows, area * mount.inertance
    plate, seat, gap = ratio**2 * mount.plate_mass, ratio**2 * mount.seat_stiffness, mount.travel / ratio

    def pressed(t, state):
        return walls * (amplitude * np.sin(2.0 * np.pi * frequency * t) - state[0] - state[2])

    def rates(t, state):
        track, flowing, moved, moving = state
        drop = pressed(t, state) - bellows * (track + moved)
        over = max(moved - gap, 0.0) + min(moved + gap, 0.0)
        lost = area * mount.friction * flowing + mount.piston**3 * mount.turbulence * abs(flowing) * flowing
        held = ratio**2 * mount.plate_damping * moving + seat * over
        return [flowing, (drop - lost) / fluid, moving, (drop - held) / plate]

    time = np.arange(round(seconds / STEP)) * STEP
    truth = solve_ivp(rates, (0.0, time[-1]), np.zeros(4), "DOP853", time, rtol=1e-9, atol=1e-12, max_step=STEP)
    turn = 2.0 * np.pi * frequency
    found = mount.piston * mount.pressure(amplitude * turn * np.cos(turn * time))
    expected = pressed(time, truth.y)
    assert found == pytest.approx(expected, abs=5e-3 * np.abs(expected).max())


def test_no_closed_motion_gives_work_back():
    path, mount = loops(8e-3, 60.0, 3), Mount()
    work = np.cumsum(mount.force(path)[1:] * np.diff(path.deflection))
    third = path.deflection.size // 3
    assert work[2 * third - 1] - work[third - 1] > 0.0
    still = DrivenPath(np.full(1000, PRELOAD), np.zeros(1000))
    assert mount.force(still) == pytest.approx(mount.stiffness * PRELOAD + mount.cubic * PRELOAD**3)


def test_repeats_differ_by_the_noise_alone(folder):
    first, again = (np.load(folder / name)["F"] for name in ("a1_p3.npz", "a1_p3_b.npz"))
    assert np.std(first - again) / np.sqrt(2) == pytest.approx(1.0, rel=0.1)


def test_the_dataset_names_every_file_once_and_the_same_seed_gives_the_same_bytes(folder, seed, tmp_path):
    text = (folder / "dataset.yaml").read_text()
    files = {file.name: file.read_bytes() for file in folder.iterdir()}
    assert len(files) == 13
    assert all(text.count(f"file: {name}") == 1 for name in files if name != "dataset.yaml")
    again = MountOnRig().measure(tmp_path / "again", seed).parent
    assert {file.name: file.read_bytes() for file in again.iterdir()} == files
    with pytest.raises(FileExistsError, match=f"seed {seed + 1}, got another dataset"):
        MountOnRig().measure(folder, seed + 1)


@pytest.mark.slow
def test_a_fit_finds_the_fluid_of_the_mount_where_the_network_has_its_laws(folder):
    measured = dp.load_dataset(folder / "dataset.yaml")
    names = ("qs", "a03_p3", "a1_p3", "a2_p3")
    data = Dataset("mount", tuple(run for run in measured.runs if run.name in names))
    fits = {name: dp.fit(name, data) for name in ("engine_mount", "ubs")}
    found = {slot.path: slot.value.number for slot in fits["engine_mount"].fitted.slots()}
    mount = Mount()
    truth = {"fluid_mass": mount.piston**2 * mount.inertance, "quadratic_damping": mount.piston**3 * mount.turbulence}
    for key, number in truth.items():
        assert found[f"fluid.track.{key}"] == pytest.approx(number, rel=0.1)
    assert found["fluid.decoupler.gap"] == pytest.approx(mount.travel * mount.plate / mount.piston, rel=0.3)
    assert fits["engine_mount"].errors.all < 0.5 * fits["ubs"].errors.all

"""The virtual car against the equations of its linear case, and its files."""

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of

from dashpot import load_registry
from dashpot.data.dataset import read_dataset
from dashpot_specimens.car_laws import GRAVITY, STEP, Car, CarTire, drive_car, tire_force
from dashpot_specimens.car_path import sweep, triangle
from dashpot_specimens.test_car import CarOnRig, measure_car, random_car

SLOPE, SPRING, TIRE, OIL = 1500.0, 24e3, 210e3, 60.0


@pytest.fixture(scope="module")
def seed():
    value = seed_of("test_test_car")
    print(f"seed {value}")
    return value


@pytest.fixture(scope="module")
def folder(seed, tmp_path_factory):
    return CarOnRig().measure(tmp_path_factory.mktemp("car"), seed).parent


def linear(mount):
    """A car all of whose laws are straight lines."""
    tire = CarTire(TIRE, 1e-3, 0.0, (1e-3, 1e-2), 0.0, (1e-3, 1e-1), OIL)
    return Car(
        wheel_mass=45.0,
        tire=tire,
        spring=SPRING,
        spring_hardening=0.0,
        bump_at=1.0,
        rebound=(SLOPE, 1e9),
        compression=(SLOPE, 1e9),
        mount_stiffness=mount,
        friction=0.0,
        bar_friction=0.0,
    )


def transfer(car, frequency, added=0.0):
    """Platform force over platform motion in phase, from the linear equations [N/m]."""
    s = 2j * np.pi * frequency
    damper = s * SLOPE
    if np.isfinite(car.mount_stiffness):
        rubber = car.mount_stiffness + s * car.mount_damping + car.rod_mass * s**2
        damper = damper * rubber / (damper + rubber)
    tire, ride = TIRE + s * OIL, SPRING + damper + (car.wheel_mass + added) * s**2
    return tire * ride / (tire + ride)


@pytest.mark.parametrize("mount", [np.inf, 400e3])
@pytest.mark.parametrize(("frequency", "added"), [(5.0, 0.0), (11.5, 0.0), (11.5, 10.0), (20.0, 0.0)])
def test_a_straight_car_obeys_its_transfer_function(mount, frequency, added):
    car = linear(mount)
    time = STEP * np.arange(round(4.0 / STEP))
    path = 2e-3 * np.sin(2 * np.pi * frequency * time) * np.clip(time, 0.0, 1.0)
    force = drive_car(car, np.array([path, path]), added)["force"][0]
    turn = np.exp(-2j * np.pi * frequency * time)[-round(4 / frequency / STEP) :]
    found = (force[-turn.size :] @ turn) / (path[-turn.size :] @ turn)
    expected = transfer(car, frequency, added)
    assert abs(found - expected) < 2e-3 * abs(expected)


def test_a_car_at_rest_stands_on_its_weight():
    car = Car()
    found = drive_car(car, np.zeros((2, 2000)), 0.0)
    assert found["force"] == pytest.approx(car.spring_force + car.wheel_mass * GRAVITY, abs=1e-6)
    assert np.abs(found["wheel"]).max() < 1e-9


def test_an_added_mass_lowers_the_wheel_and_takes_load_off_the_spring():
    car = Car()
    found = drive_car(car, np.zeros((2, 2000)), 15.0)
    wheel, force = found["wheel"][0, -1], found["force"][0, -1]
    stiffness = car.tire.stiffness + car.tire.sliding_stiffness + car.spring
    assert -15.0 * GRAVITY / car.tire.stiffness < wheel < -15.0 * GRAVITY / stiffness / 1.5
    carried = car.spring_force + car.spring * wheel + (car.wheel_mass + 15.0) * GRAVITY
    assert force == pytest.approx(carried, abs=1.2 * car.friction)
    assert np.ptp(found["force"][0]) < 0.1


def test_the_bar_works_in_anti_phase_only():
    path = triangle(-10e-3, 10e-3, 8.0)
    plain, bare = replace(linear(np.inf), bar=20e3), replace(linear(np.inf), bar=0.0)

    def slope(car, side):
        wheel, force = (drive_car(car, np.array([path, side * path]), 0.0)[key][0] for key in ("wheel", "force"))
        return np.polyfit(wheel, force, 1)[0]

    assert slope(plain, 1.0) == pytest.approx(slope(bare, 1.0), rel=1e-6)
    assert slope(plain, -1.0) - slope(bare, -1.0) == pytest.approx(2 * 20e3, rel=1e-3)


def test_the_tire_leaves_the_ground():
    assert tire_force(CarTire(), np.linspace(5e-3, -5e-3, 4000)).min() == 0.0


def test_paths_begin_and_end_smoothly():
    for path in (sweep(2e-3, 1.0, 25.0, 4.0), triangle(0.0, 30e-3, 8.0), triangle(-4e-3, 4e-3, 4.0)):
        assert abs(path[0]) < 0.05 * np.ptp(path)
        assert np.abs(np.diff(path)).max() < 0.8 * STEP
        assert np.abs(np.diff(path, 2)).max() < 60.0 * STEP**2


def test_the_dataset_reads_back_with_its_noise(folder):
    registry = load_registry()
    data = read_dataset(folder, {word: reader() for word, reader in registry.formats.items()})
    assert not data.problems and len(data.runs) == 21
    one, two = (data.run(name).force for name in ("tire_a1_p17", "tire_a1_p17_b"))
    assert np.std(one - two) / np.sqrt(2) == pytest.approx(5.0, rel=0.05)
    masses = [run.settings["added_mass"] for run in data.runs if "added_mass" in run.settings]
    assert masses == [0.0, 5.0, 10.0, 15.0, 0.0]
    assert "displacement@wheel_right" in data.run("axle_m5").channels


def test_balance_and_damper_test_rig_stand_in_the_dataset(folder):
    data = read_dataset(folder, {word: reader() for word, reader in load_registry().formats.items()})
    mass, shock = data.references["wheel_left.mass"], data.references["shock_absorber.damping"]
    assert mass.number("kg") == pytest.approx(Car().wheel_mass, abs=5e-3)
    for velocity, force in zip(shock.velocity, shock.force, strict=True):
        slope, knee = Car().rebound if velocity < 0.0 else Car().compression
        assert force == pytest.approx(slope * velocity / (1.0 + abs(velocity) / knee), abs=0.06)


def test_the_same_seed_gives_the_same_bytes_and_another_dataset_is_kept(folder, seed, tmp_path):
    again = CarOnRig().measure(tmp_path, seed).parent
    files = sorted(path.name for path in folder.iterdir())
    assert sorted(path.name for path in again.iterdir()) == files
    assert all((again / name).read_bytes() == (folder / name).read_bytes() for name in files if name.endswith("yaml"))
    for name in (name for name in files if name.endswith("npz")):
        with np.load(again / name) as one, np.load(folder / name) as other:
            assert all((one[key] == other[key]).all() for key in one)
    with pytest.raises(FileExistsError, match="expected the test car of seed"):
        measure_car(random_car(np.random.default_rng(seed), mount=True), tmp_path, seed + 1)


def test_a_random_car_has_a_mount_only_if_asked(seed):
    rigid, soft = (random_car(np.random.default_rng(seed), mount) for mount in (False, True))
    assert np.isinf(rigid.mount_stiffness) and 300e3 <= soft.mount_stiffness <= 800e3
    assert rigid == soft.rigid

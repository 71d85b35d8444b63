"""A car's front axle on two platforms, and one of its tires on a hydropulser."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dashpot.contract.specimen import Specimen

if TYPE_CHECKING:
    import numpy as np

    from dashpot_specimens.car_laws import Car

AMPLITUDES = (1e-3, 2e-3, 5e-3)
PRELOADS = (12e-3, 17e-3, 22e-3)
STOP = 25.0
HOP, HOP_STOP = 10e-3, 15.0  # as far as a hopping wheel deflects its tire, and as fast as a hydropulser can do it
ADDED_MASSES = (0.0, 5.0, 10.0, 15.0)
TIRE_DEPTH, TIRE_LOOP, SLOW_LOOP = 30e-3, 60.0, 40.0
HEAVE, ROLL, AXLE_AMPLITUDE = 40e-3, 20e-3, 3e-3
TIRE_SWEEP, AXLE_SWEEP = 10.0, 20.0
SIDES = ("left", "right")

HEAD = """\
# seed {seed}; weighed: {mass:.3f} kg each wheel
format: dashpot-dataset/1
name: test car, axle on two platforms and one tire on a hydropulser (virtual)
runs:
"""
TIRE_CHANNELS = """\
    channels: {time: {column: t, unit: s}, displacement: {column: x, unit: mm}, force: {column: F, unit: N}}
    sensors: {displacement: {noise: 1 um}, force: {noise: 5 N}}
"""
AXLE_CHANNELS = """\
    channels:
      time: {column: t, unit: s}
      displacement@platform_left: {column: xl, unit: mm}
      displacement@platform_right: {column: xr, unit: mm}
      displacement@wheel_left: {column: zl, unit: mm}
      displacement@wheel_right: {column: zr, unit: mm}
      force@platform_left: {column: Fl, unit: N}
      force@platform_right: {column: Fr, unit: N}
"""
# as a balance and a damper test rig would have told it, to 10 g and 0.1 N
REFERENCES = """\
references:
  wheel_left.mass: {{value: {mass:.2f} kg, by: weighed}}
  shock_absorber.damping: &shock_absorber
    velocity: [{velocity}]
    force: [{force}]
    by: damper test rig
  strut.shock_absorber.damping: *shock_absorber     # of models with top mounts
"""
VELOCITIES = (-1.0, -0.7, -0.45, -0.25, -0.1, -0.03, 0.0, 0.03, 0.1, 0.25, 0.45, 0.7, 1.0)  # m/s


class CarOnRig(Specimen):
    """An axle whose tire, friction and shock absorber follow other laws than the models, with a rubber top mount."""

    word = "test_car"
    about = "a front axle with the body held, four masses screwed on; and its tire alone on a hydropulser"

    def measure(self, folder: Path, seed: int) -> Path:
        """Drive every run and write it down: about six megabytes, in about ten seconds.

        Raises FileExistsError where the folder holds a dataset of something else.
        """
        from dashpot_specimens.car_laws import Car

        return measure_car(Car(), folder, seed)


def measure_car(car: Car, folder: Path, seed: int, every: int = 20, axle_sweep: float = AXLE_SWEEP) -> Path:
    """Write the dataset of a car; see ``CarOnRig.measure``.

    Dynamic runs are sampled at every so many steps of 50 us; sweeps of the axle last ``axle_sweep`` seconds.
    """
    import numpy as np

    target = folder / "dataset.yaml"
    head = HEAD.format(seed=seed, mass=car.wheel_mass)
    if target.exists():
        if target.read_text(encoding="utf-8").startswith(head):
            return target
        raise FileExistsError(
            f"{target}: expected the test car of seed {seed}, got another dataset; use another folder"
        )
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(seed)
    entries = [*_tire_runs(car, folder, rng, every), *_axle_runs(car, folder, rng, every, axle_sweep)]
    part = target.with_suffix(".part")
    part.write_text(head + "".join(entries) + _references(car), encoding="utf-8")
    return part.replace(target)


def _references(car: Car) -> str:
    """What balance and damper test rig tell of a car."""
    from dashpot_specimens.car_laws import shock_force

    return REFERENCES.format(
        mass=car.wheel_mass,
        velocity=", ".join(f"{velocity:g} m/s" for velocity in VELOCITIES),
        force=", ".join(f"{shock_force(car, velocity):.1f} N" for velocity in VELOCITIES),
    )


def _tire_runs(car: Car, folder: Path, rng: np.random.Generator, dynamic: int) -> Iterator[str]:
    from dashpot_specimens import car_path
    from dashpot_specimens.car_laws import tire_force

    def run(name: str, path: np.ndarray, every: int, about: str) -> str:
        channels = {"x": path[::every], "F": tire_force(car.tire, path)[::every]}
        _write(folder / f"{name}.npz", every, channels, rng)
        return f"  - name: {name}\n    file: {name}.npz\n    {about}\n{TIRE_CHANNELS}"

    yield run("tire_slow", car_path.triangle(0.0, TIRE_DEPTH, TIRE_LOOP), 200, "kind: quasi_static")
    plans = [(amplitude, preload, "") for amplitude, preload in product(AMPLITUDES, PRELOADS)]
    again = [(amplitude, PRELOADS[1], "_b") for amplitude in AMPLITUDES]
    for amplitude, preload, mark in [*plans, *again, (HOP, PRELOADS[1], "")]:
        first, stop = f"tire_a{amplitude * 1e3:g}_p{preload * 1e3:g}", HOP_STOP if amplitude == HOP else STOP
        settings = (
            f"{{amplitude: {amplitude * 1e3:g} mm, preload: {preload * 1e3:g} mm, start: 1 Hz, stop: {stop:g} Hz}}"
        )
        about = f"kind: sweep\n    settings: {settings}" + (f"\n    repeats: {first}" if mark else "")
        yield run(first + mark, preload + car_path.sweep(amplitude, 1.0, stop, TIRE_SWEEP), dynamic, about)


def _axle_runs(car: Car, folder: Path, rng: np.random.Generator, dynamic: int, duration: float) -> Iterator[str]:
    import numpy as np

    from dashpot_specimens import car_path
    from dashpot_specimens.car_laws import drive_car

    def run(name: str, paths: np.ndarray, every: int, added: float, about: str) -> str:
        found = drive_car(car, paths, added)
        channels = {
            f"{key}{side[0]}": values[number, ::every]
            for number, side in enumerate(SIDES)
            for key, values in (("x", paths), ("z", found["wheel"]), ("F", found["force"]))
        }
        _write(folder / f"{name}.npz", every, channels, rng)
        return f"  - name: {name}\n    file: {name}.npz\n    {about}\n{AXLE_CHANNELS}"

    slow = {"heave": (HEAVE, 1.0), "roll": (ROLL, -1.0)}
    for name, (depth, side) in slow.items():
        path = car_path.triangle(-depth, depth, SLOW_LOOP)
        yield run(f"axle_{name}", np.array([path, side * path]), 200, 0.0, "kind: quasi_static")
    path = car_path.sweep(AXLE_AMPLITUDE, 5.0, 20.0, duration)
    plans = [(f"axle_m{added:g}", 1.0, added) for added in ADDED_MASSES] + [("axle_anti", -1.0, 0.0)]
    for name, side, added in plans:
        settings = f"{{amplitude: {AXLE_AMPLITUDE * 1e3:g} mm, start: 5 Hz, stop: 20 Hz, added_mass: {added:g} kg}}"
        yield run(name, np.array([path, side * path]), dynamic, added, f"kind: sweep\n    settings: {settings}")


def _write(path: Path, every: int, channels: dict[str, np.ndarray], rng: np.random.Generator) -> None:
    import numpy as np

    from dashpot_specimens.car_laws import STEP
    from dashpot_specimens.rig_log import coloured_noise

    size = len(next(iter(channels.values())))
    noisy: dict[str, Any] = {
        key: np.round(values + coloured_noise(rng, size, 5.0), 1)
        if key[0] == "F"
        else np.round(1e3 * (values + 1e-6 * rng.standard_normal(size)), 4)
        for key, values in channels.items()
    }
    np.savez_compressed(path, t=np.arange(size) * every * STEP, **noisy)


def random_car(rng: np.random.Generator, mount: bool) -> Car:
    """A car whose every number is drawn.

    With ``mount`` its shock absorbers, with rods of 1 to 2 kg, stand in rubber of 300 to 800 N/mm.
    """
    from dashpot_specimens.car_laws import Car, CarTire

    def around(number: float, spread: float) -> float:
        return float(number * rng.uniform(1.0 - spread, 1.0 + spread))

    plain = Car()
    tire = replace(
        CarTire(),
        stiffness=around(190e3, 0.15),
        hardening=around(2.2e6, 0.4),
        sliding_stiffness=around(45e3, 0.4),
        relaxing_stiffness=around(30e3, 0.4),
        damping=around(35.0, 0.5),
    )
    car = replace(
        plain,
        wheel_mass=float(rng.uniform(36.0, 55.0)),
        tire=tire,
        spring=around(plain.spring, 0.2),
        rebound=(around(4200.0, 0.3), around(0.32, 0.2)),
        compression=(around(2100.0, 0.3), around(0.28, 0.2)),
        friction=around(40.0, 0.5),
        friction_travel=around(0.35e-3, 0.3),
        bar=around(11e3, 0.3),
        mount_stiffness=float(rng.uniform(300e3, 800e3)),
        rod_mass=float(rng.uniform(1.0, 2.0)),
    )
    return car if mount else car.rigid

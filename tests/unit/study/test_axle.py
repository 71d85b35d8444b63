"""What the runs of an axle tell beside a fit; truth: the virtual car with straight laws."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.data.run import Run
from dashpot.model.reading import parse_network
from dashpot.study.axle import Axle, axle_of, contact_responses, measured_curves, simulated_curves, wheel_masses
from dashpot_specimens.car_laws import STEP, Car, CarTire, drive_car
from dashpot_specimens.car_path import sweep, triangle

SIDES = ("left", "right")
MASS, SPRING, TIRE, BAR, SLOPE, FRICTION = 45.0, 24e3, 210e3, 12e3, 1500.0, 30.0
CAR = Car(
    wheel_mass=MASS,
    tire=CarTire(TIRE, 1e-3, 0.0, (1e-3, 1e-2), 0.0, (1e-3, 1e-1), 0.0),
    spring=SPRING,
    spring_hardening=0.0,
    bump_at=1.0,
    rebound=(SLOPE, 1e9),
    compression=(SLOPE, 1e9),
    mount_stiffness=np.inf,
    friction=FRICTION,
    breakaway=1.0,
    bar=BAR,
    bar_friction=0.0,
)
NETWORK = """\
format: dashpot-network/1
name: straight
gravity: 9.81 m/s^2
nodes:
  platform_left: driven
  platform_right: driven
  wheel_left: {mass: {start: 45 kg}, added_mass: {setting: added_mass, value: 0 kg}}
  wheel_right: {same_as: wheel_left}
  body: ground
branches:
  tire: {between: [platform_left, wheel_left], element: spring, stiffness: 210 N/mm}
  tire_right: {same_as: tire, between: [platform_right, wheel_right]}
  ride: {between: [wheel_left, body], element: spring, stiffness: 24 N/mm}
  ride_right: {same_as: ride, between: [wheel_right, body]}
  friction: {between: [wheel_left, body], element: dahl, limit: 30 N, stiffness: 90 N/mm}
  friction_right: {same_as: friction, between: [wheel_right, body]}
  oil: {between: [wheel_left, body], element: damper, damping: 1500 N*s/m}
  oil_right: {same_as: oil, between: [wheel_right, body]}
  bar: {between: [wheel_left, wheel_right], element: spring, stiffness: 12 N/mm}
"""


def record(name: str, kind: str, paths: np.ndarray, every: int, added: float = 0.0) -> Run:
    found = drive_car(CAR, paths, added)
    channels = {}
    for number, side in enumerate(SIDES):
        channels[f"displacement@platform_{side}"] = paths[number, ::every]
        channels[f"displacement@wheel_{side}"] = found["wheel"][number, ::every]
        channels[f"force@platform_{side}"] = found["force"][number, ::every]
    time = every * STEP * np.arange(channels["force@platform_left"].size)
    return Run(name, kind, time, channels, {"added_mass": added} if kind == "sweep" else {}, group=name)


@pytest.fixture(scope="module")
def axle() -> Axle:
    slow, fast = triangle(-20e-3, 20e-3, 12.0), sweep(3e-3, 5.0, 20.0, 6.0)
    runs = [
        record("heave", "quasi_static", np.array([slow, slow]), 200),
        record("roll", "quasi_static", np.array([slow, -slow]), 200),
        *(record(f"m{added:g}", "sweep", np.array([fast, fast]), 20, added) for added in (0.0, 10.0)),
    ]
    spec = parse_network(NETWORK, load_registry().elements, "straight.yaml")
    found = axle_of(spec, one_force_each(Dataset("axle", tuple(runs))).runs)
    assert found is not None
    return found


def test_an_axle_has_a_wheel_behind_each_platform(axle):
    assert axle.wheels == {"platform_left": "wheel_left", "platform_right": "wheel_right"}
    assert [axle.added_mass(run, "wheel_right") for run in axle.records] == [0.0, 0.0, 0.0, 10.0]
    alone = "format: dashpot-network/1\nname: a\nbranches: {k: {element: spring, stiffness: 1 N/mm}}\n"
    assert axle_of(parse_network(alone, load_registry().elements, "a.yaml"), axle.runs) is None


def without_wheels(axle: Axle) -> Axle:
    runs = [
        replace(run, channels={name: each for name, each in run.channels.items() if "@wheel" not in name})
        for run in axle.runs
    ]
    return replace(axle, runs=tuple(runs))


@pytest.mark.parametrize("blind", [False, True], ids=["wheels measured", "tires of the network"])
def test_springs_friction_and_bar_are_those_of_the_car(axle, blind):
    curves = measured_curves(without_wheels(axle) if blind else axle)
    for side in curves.suspension:
        assert side.rate == pytest.approx(SPRING, rel=5e-3)
        assert side.friction == pytest.approx(FRICTION + SLOPE * side.speed, rel=0.03)
    assert curves.bar_rate == pytest.approx(BAR, rel=0.01)


def test_the_model_of_the_car_shows_the_same_curves(axle):
    measured, simulated = measured_curves(axle), simulated_curves(axle, axle.network)
    assert simulated.bar_rate == pytest.approx(measured.bar_rate, rel=0.01)
    for one, other in zip(measured.suspension, simulated.suspension, strict=True):
        assert other.rate == pytest.approx(one.rate, rel=0.01)
        assert other.friction == pytest.approx(one.friction, rel=0.03)


def test_without_measured_wheels_there_is_no_mass_without_a_model(axle):
    found = wheel_masses(axle)
    assert list(found) == ["wheel_left", "wheel_right"]
    assert found["wheel_left"]["rigid"].mass == pytest.approx(MASS, rel=0.01)
    assert wheel_masses(without_wheels(axle)) == {}


def test_contact_forces_are_told_by_wheel_and_added_mass(axle):
    frequency, force = np.array([6.0, 12.0]), np.array([300.0, 2000.0])
    response = {"force": force}
    curves = [
        {"run": run.name, "frequency": frequency, "measured": response, "simulated": {"m": response}}
        for run in axle.runs
    ]
    found = [curve for curve in contact_responses(axle, curves) if curve["run"].startswith("m")]
    assert [(each["wheel"], each["added_mass"]) for each in found] == [
        ("wheel_left", 0.0),
        ("wheel_right", 0.0),
        ("wheel_left", 10.0),
        ("wheel_right", 10.0),
    ]
    assert found[0]["simulated"]["m"] is force

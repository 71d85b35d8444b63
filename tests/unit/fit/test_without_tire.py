"""Masses without the tire, and what a damper has seen; truth: the virtual car with straight laws."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.data.run import Run
from dashpot.fit.begin_at_wheels import begin_at_wheels
from dashpot.fit.excited import velocity_curves
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.scored import ScoredRun, score_run
from dashpot.fit.without_tire import masses_without_tire, wheels_behind
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import parse_network
from dashpot_specimens.car_laws import STEP, Car, CarTire, drive_car
from dashpot_specimens.car_path import sweep

EVERY = 20
MASS, SLOPE, SPRING = 45.0, 1500.0, 24e3
CAR = Car(
    wheel_mass=MASS,
    tire=CarTire(210e3, 1e-3, 0.0, (1e-3, 1e-2), 0.0, (1e-3, 1e-1), 0.0),
    spring=SPRING,
    spring_hardening=0.0,
    bump_at=1.0,
    rebound=(SLOPE, 1e9),
    compression=(SLOPE, 1e9),
    mount_stiffness=np.inf,
    friction=0.0,
    bar_friction=0.0,
)
QUARTER = """\
format: dashpot-network/1
name: quarter
gravity: 9.81 m/s^2
nodes:
  platform: driven
  wheel: {mass: {start: 41 kg, bounds: [15 kg, 90 kg]}, added_mass: {setting: added_mass, value: 0 kg}}
  body: ground
branches:
  tire: {between: [platform, wheel], offset: 20 mm, element: spring, stiffness: 190 N/mm}
  ride: {between: [wheel, body], element: spring,
         stiffness: {deflection: [-40 mm, 0 mm, 40 mm], force: [{start: 2.5 kN}, {start: 3.5 kN}, {start: 4.5 kN}]}}
  oil: {between: [wheel, body], element: damper,
        damping: {velocity: [-2 m/s, -0.2 m/s, 0 m/s, 0.2 m/s, 2 m/s],
                  force: [{start: -2.8 kN}, {start: -280 N}, 0 N, {start: 280 N}, {start: 2.8 kN}]}}
"""


@pytest.fixture(scope="module")
def runs() -> list[Run]:
    path = sweep(2e-3, 5.0, 20.0, 6.0)
    found = []
    for added in (0.0, 10.0):
        answer = drive_car(CAR, np.array([path, path]), added)
        channels = {
            "displacement@platform": path[::EVERY],
            "displacement@wheel": answer["wheel"][0, ::EVERY],
            "force@platform": answer["force"][0, ::EVERY],
        }
        time = EVERY * STEP * np.arange(channels["force@platform"].size)
        own = {"displacement": channels["displacement@platform"], "force": channels["force@platform"]}
        found.append(
            Run(
                f"m{added:g}@platform",
                "sweep",
                time,
                {**channels, **own},
                {"added_mass": added},
                group=f"m{added:g}@platform",
                end="platform",
            )
        )
    return found


@pytest.fixture(scope="module")
def quarter(runs) -> NetworkSpec:
    spec = parse_network(QUARTER, load_registry().elements, "quarter.yaml")
    return with_ranges(spec, natural_sizes([score_run(run) for run in runs]))


def test_a_wrong_tire_does_not_touch_the_mass_found_without_it(quarter, runs):
    [found] = masses_without_tire(quarter, runs)
    assert found.node == "wheel" and found.mass == pytest.approx(MASS, rel=1e-3)
    assert found.rmse < 2.0


def test_without_the_motion_of_the_wheel_or_without_a_wheel_there_is_no_answer(quarter, runs):
    bare = [
        replace(run, channels={name: values for name, values in run.channels.items() if "wheel" not in name})
        for run in runs
    ]
    assert masses_without_tire(quarter, bare) == []
    alone = parse_network(
        "format: dashpot-network/1\nname: a\nbranches: {k: {element: spring, stiffness: 1 N/mm}}\n",
        load_registry().elements,
        "a.yaml",
    )
    assert wheels_behind(alone) == {} and masses_without_tire(alone, runs) == []


def test_a_damper_is_known_as_far_as_the_wheel_was_fast(quarter, runs):
    text = QUARTER
    for assumed, true in (
        ("190 N/mm", "210 N/mm"),
        ("{start: 41 kg, bounds: [15 kg, 90 kg]}", "45 kg"),
        ("2.8 kN", "3 kN"),
        ("280 N", "300 N"),
        ("2.5 kN", "2.54 kN"),
        ("4.5 kN", "4.46 kN"),
    ):
        text = text.replace(assumed, true)
    [curve] = velocity_curves(
        parse_network(text, load_registry().elements, "quarter.yaml"), [score_run(run) for run in runs]
    )
    speed = np.gradient(np.concatenate([run.channels["displacement@wheel"] for run in runs]), EVERY * STEP)
    assert curve.path == "oil.damping"
    assert curve.reached == pytest.approx(np.quantile(speed, [1e-3, 1.0 - 1e-3]), rel=0.03)
    assert curve.excited == (False, True, True, True, False)


def test_a_damper_between_two_ends_sees_the_drive():
    spec = parse_network(
        "format: dashpot-network/1\nname: a\nbranches:\n  oil: {element: damper, damping: {velocity: "
        "[-1 m/s, 0 m/s, 1 m/s], force: [{start: -100 N}, 0 N, {start: 100 N}]}}\n",
        load_registry().elements,
        "a.yaml",
    )
    time = 1e-3 * np.arange(4000)
    path = 5e-3 * np.sin(2.0 * np.pi * 5.0 * time)
    one: ScoredRun = score_run(Run("a", "harmonic", time, {"displacement": path, "force": 0.0 * path}))
    [curve] = velocity_curves(spec, [one])
    assert curve.reached == pytest.approx((-0.157, 0.157), rel=0.01)
    assert curve.excited == (False, True, False)


def begun_of(spec, runs, budget=500):
    scored = [score_run(run) for run in runs]
    objective = Objective(compile_network(spec), scored)
    found, vectors = begin_at_wheels(spec, objective, lambda slot: slot.value.searched, budget)
    return found, vectors, [float(objective.losses(compile_network(each).start)[0]) for each in (spec, found)]


def test_a_search_begins_near_the_truth_although_the_tire_is_wrong(quarter, runs):
    far = quarter.with_values(
        {slot.path: replace(slot.value, number=30.0) for slot in quarter.slots() if slot.path == "wheel.mass"}
    )
    found, vectors, losses = begun_of(far, runs)
    numbers = {slot.path: slot.value.number for slot in found.slots()}
    assert numbers["wheel.mass"] == pytest.approx(MASS, rel=1e-2)
    assert numbers["tire.stiffness"] == 190e3
    assert vectors > 0 and losses[1] < 0.5 * losses[0]
    for budget in (1, 3, 30):
        assert begun_of(far, runs, budget)[1] <= budget


def test_a_search_begins_where_it_is_if_that_is_better_or_nothing_is_known_of_the_wheel(quarter, runs):
    true = {"tire.stiffness": 210e3, "wheel.mass": MASS}
    good = quarter.with_values(
        {slot.path: replace(slot.value, number=true[slot.path]) for slot in quarter.slots() if slot.path in true}
    )
    # a motion of the wheel that is not its own
    wrong = [
        replace(run, channels={**run.channels, "displacement@wheel": 0.5 * run.channels["displacement@wheel"]})
        for run in runs
    ]
    found, vectors, losses = begun_of(good, wrong)
    assert found is good and vectors > 0 and losses[0] == losses[1]
    bare = [
        replace(run, channels={name: values for name, values in run.channels.items() if "wheel" not in name})
        for run in runs
    ]
    assert begun_of(good, bare)[:2] == (good, 0)

"""Inspection tests on a virtual quarter car; truth: its frequency response in closed form, and forces made by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.linear_car import AMPLITUDE, car, least_force, response

from dashpot import load_registry
from dashpot.compare.metrics import metric_rows, named_rows
from dashpot.contract.bench import find_bench
from dashpot.data.run import Run
from dashpot.fit.virtual_test import virtual_test
from dashpot.model.reading import parse_network
from dashpot_metrics.eusama import Eusama
from dashpot_metrics.phase_shift import PhaseShift, angles
from dashpot_metrics.phase_shift_first_crossings import FirstCrossings

REGISTRY = load_registry()
TIRE = 253.2e3


def least_angle(damping: float) -> float:
    return float(np.min(180.0 - np.abs(np.degrees(np.angle(response(np.arange(6.0, 18.0, 0.05), damping, TIRE))))))


def measured(rig: str, damping: float, **options: str) -> list[Run]:
    spec = parse_network(car(damping, TIRE), REGISTRY.elements)
    bench = find_bench(rig, REGISTRY.rigs, {"sampling": "500 Hz", **options})
    return [
        replace(
            run,
            channels={"displacement": run.channels["displacement@platform"], "force": run.channels["force@platform"]}
            if "force@platform" in run.channels
            else run.channels,
        )
        for run in virtual_test(spec, bench)
    ]


@pytest.mark.parametrize(("damping", "told"), [(300.0, 18.0), (600.0, 35.0), (1474.0, 71.0)])
def test_the_least_angle_is_that_of_the_frequency_response(damping, told):
    """``told`` are values of the same car from an implementation of others, to a degree."""
    (run,) = measured("phase_shift", damping)
    assert least_angle(damping) == pytest.approx(told, abs=1.0)
    assert PhaseShift().measure(run) == pytest.approx(least_angle(damping), abs=2.0)


@pytest.mark.parametrize("damping", [800.0, 1474.0, 3000.0])
def test_the_least_contact_force_is_that_of_the_frequency_response(damping):
    (run,) = measured("eusama", damping)
    assert Eusama().measure(run) == pytest.approx(least_force(damping, TIRE), abs=1.5)


def test_a_wheel_that_leaves_the_platform_has_no_adhesion():
    (run,) = measured("eusama", 100.0)
    assert run.force.min() < 0.0  # this car's tire can pull
    assert Eusama().measure(run) == 0.0


def test_added_masses_are_runs_of_their_own():
    light, heavy = measured("eusama", 1474.0, added_masses="0 kg, 10 kg")
    assert [run.name for run in (light, heavy)] == ["eusama_m0", "eusama_m10"]
    truth = least_force(1474.0, TIRE, added=10.0)
    assert Eusama().measure(heavy) == pytest.approx(truth, abs=1.5)
    assert Eusama().measure(light) != pytest.approx(truth, abs=1.5)


def first_crossings(run: Run) -> float:
    """The least angle as taken from the first two crossings behind each top: the trap."""
    static, time, force = float(np.mean(run.force[:200])), run.time, run.force
    path = run.displacement
    tops = np.flatnonzero((path[1:-1] > path[:-2]) & (path[1:-1] >= path[2:]) & (path[1:-1] > 1e-3)) + 1
    found = []
    for top, after in zip(tops, tops[1:], strict=False):
        inside = np.arange(top, after)
        crossed = inside[np.flatnonzero(np.diff(np.sign(force[inside] - static)) != 0)]
        frequency = 1.0 / (time[after] - time[top])
        if crossed.size >= 2 and 6.0 <= frequency <= 18.0:
            angle = 360.0 * frequency * (0.5 * (time[crossed[0]] + time[crossed[1]]) - time[top])
            found.append(min(angle, 360.0 - angle))
    return min(found)


def test_the_first_two_crossings_behind_a_top_never_fail_a_car():
    """With a third of the damping that is wanted the trough lies less than 35 degrees behind the top."""
    (run,) = measured("phase_shift", 300.0)
    assert PhaseShift().measure(run) < 25.0
    assert first_crossings(run) > 80.0
    assert FirstCrossings().measure(run) > 80.0


@pytest.mark.parametrize("angle", [10.0, 60.0, 89.0, 91.0, 150.0])
def test_every_angle_of_a_force_made_by_hand_is_found(angle):
    time = 1e-3 * np.arange(20000)
    phase = 2.0 * np.pi * (25.0 * time - 0.5 * time**2)
    moving = np.clip(time - 0.5, 0.0, 1.0)
    force = 4000.0 - 2000.0 * moving * np.cos(phase - np.radians(angle)) + 150.0 * np.sin(1200.0 * time)
    run = Run(
        "made",
        "sweep",
        time,
        {"displacement": AMPLITUDE * moving * np.cos(phase), "force": force},
        {"start": 25.0, "stop": 5.0},
    )
    frequency, found = angles(run)
    inside = (frequency > 6.0) & (frequency < 18.0)
    assert np.median(found[inside]) == pytest.approx(angle, abs=1.0)
    assert PhaseShift().measure(run) == pytest.approx(angle, abs=2.0)
    # the crest of those whose trough comes before a quarter of the period, half a period away from it
    folded = angle if angle > 90.0 else 180.0 - angle
    assert FirstCrossings().measure(run) == pytest.approx(folded, abs=2.0)


def test_the_pitfall_is_told_only_where_it_is_named():
    (run,) = measured("phase_shift", 300.0)
    words = [row["metric"] for row in metric_rows(REGISTRY.metrics.values(), [run])]
    assert "phase_shift" in words and FirstCrossings.word not in words
    assert [row["metric"] for row in named_rows([FirstCrossings], [run])] == [FirstCrossings.word]


@pytest.mark.parametrize(
    ("kind", "start", "stop", "mean"),
    [
        ("sweep", 1.0, 25.0, 4000.0),
        ("sweep", 12.0, 5.0, 4000.0),
        ("harmonic", 25.0, 5.0, 4000.0),
        ("sweep", 25.0, 5.0, 0.0),
    ],
)
def test_other_tests_have_no_such_number(kind, start, stop, mean):
    time = 1e-3 * np.arange(4000)
    x = AMPLITUDE * np.sin(60.0 * time)
    run = Run("other", kind, time, {"displacement": x, "force": mean - 1e5 * x - 1.0}, {"start": start, "stop": stop})
    assert Eusama().measure(run) is None and PhaseShift().measure(run) is None


def test_a_test_that_cannot_be_driven_is_refused():
    for options in ({"start": "5 Hz"}, {"sampling": "100 Hz"}, {"amplitude": "0 mm"}):
        with pytest.raises(ValueError, match=r"expected|sampling"):
            find_bench("phase_shift", REGISTRY.rigs, options)

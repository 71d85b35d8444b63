"""What a rig makes of its plan, held against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.contract.bench import Bench, read_bench
from dashpot.contract.limits import Limits
from dashpot.contract.rig import PORT
from dashpot.fit.driven import NOTE, as_driven
from dashpot.fit.virtual_test import bench_as_driven, virtual_test
from dashpot.model.reading import parse_network
from dashpot.text.document import Document
from dashpot.text.problem import InputError

REGISTRY = load_registry()
RATE = 1e5
SPRING = parse_network(
    f"format: dashpot-network/1\nname: s\nbranches: {{s: {{element: spring, stiffness: {RATE}}}}}", REGISTRY.elements
)


def sines(**options):
    default = {"frequencies": (10.0,), "amplitudes": (2e-3,), "preloads": (10e-3,), "sampling": 4000.0}
    return REGISTRY.rigs["stepped_sine"](**{**default, **options})


def only(rig, **limits):
    [run] = bench_as_driven(SPRING, Bench("b", (rig,), limits=Limits(**limits))).runs()
    return run


def test_what_is_within_the_limits_stays_as_planned_and_says_nothing():
    [planned] = sines().runs()
    driven = only(sines(), stroke=5e-3, speed=0.2, force=1300.0)
    assert NOTE not in driven.notes
    assert np.array_equal(driven.motion[PORT].displacement, planned.motion[PORT].displacement)


def test_a_stroke_that_is_too_long_is_made_shorter_around_its_first_place():
    run = only(sines(), stroke=3e-3)
    path = run.motion[PORT]
    assert np.ptp(path.displacement) == pytest.approx(3e-3) and path.displacement[0] == pytest.approx(10e-3)
    assert run.settings["amplitude"] == pytest.approx(1.5e-3, rel=1e-3) and run.settings["preload"] == 10e-3
    assert "stroke 4 mm, at most 3 mm" in run.notes[NOTE]


def test_a_speed_that_is_too_high_is_made_lower_with_the_amplitude():
    run = only(sines(), speed=0.1)
    assert np.abs(run.motion[PORT].velocity).max() == pytest.approx(0.1)
    assert np.ptp(run.motion[PORT].displacement) == pytest.approx(2.0 * 0.1 / (20.0 * np.pi), rel=1e-3)
    assert "speed 0.1257 m/s, at most 0.1 m/s" in run.notes[NOTE]


def test_a_force_that_is_too_large_is_brought_within_a_hundredth_below_its_limit():
    run = only(sines(), force=1100.0)
    largest = RATE * np.abs(run.motion[PORT].displacement).max()
    assert 0.99 * 1100.0 <= largest <= 1100.0
    assert "force 1200 N, at most 1100 N" in run.notes[NOTE]


def test_a_specimen_that_presses_too_hard_at_rest_is_told():
    with pytest.raises(InputError, match="presses with 1000 N at the first place of the run, the rig bears 900 N"):
        only(sines(), force=900.0)


@pytest.mark.parametrize("bandwidth", [10.0, 40.0])
def test_a_servo_follows_late_and_with_less_as_its_transfer_function_says(bandwidth):
    run = only(sines(cycles=20), bandwidth=bandwidth)
    path, turn = run.motion[PORT], 2.0 * np.pi * 10.0 * run.time
    steady = slice(10 * 400, 20 * 400)
    transfer = 1.0 / (1.0 + 1j * 10.0 / bandwidth)
    for order, rate in enumerate((path.displacement - 10e-3, path.velocity, path.acceleration)):
        expected = (2e-3 * (20j * np.pi) ** order * transfer * np.exp(1j * turn)).imag
        assert rate[steady] == pytest.approx(expected[steady], abs=1e-6 * np.ptp(expected))
    assert f"the servo of {bandwidth:g} Hz reaches" in run.notes[NOTE]


def test_all_nodes_of_a_run_are_made_smaller_alike():
    rig = REGISTRY.rigs["four_post"](duration=2.0, amplitude=5e-3)
    for run in as_driven(Bench("b", (rig,), limits=Limits(stroke=6e-3)), lambda run: 0.0).runs():
        left, right = (run.motion[node].displacement for node in ("platform_left", "platform_right"))
        assert np.abs(left) == pytest.approx(np.abs(right), abs=0.0)
        assert max(np.ptp(left), np.ptp(right)) == pytest.approx(6e-3)


def test_what_was_made_of_a_run_stands_in_its_dataset():
    text = (
        "format: dashpot-rig/1\nname: small\ntests: [{rig: stepped_sine, amplitudes: 2 mm, preloads: 10 mm}]\n"
        "limits: {stroke: 1 mm, force: 20 kN}\n"
    )
    bench = read_bench(Document.parse(text), REGISTRY.rigs)
    [run] = virtual_test(SPRING, bench)
    assert "at most 1 mm" in run.notes[NOTE] and np.ptp(run.displacement) == pytest.approx(1e-3)


def test_a_limit_of_nothing_is_refused():
    with pytest.raises(ValueError, match="more than 0"):
        Limits(stroke=0.0)

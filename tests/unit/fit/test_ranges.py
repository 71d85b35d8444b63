"""A parameter without bounds is searched over what the runs can feel, from the gentlest to the strongest of them."""

from __future__ import annotations

import numpy as np
import pytest
from unit.fit.bench import network

from dashpot.data.drive import drive_from_samples
from dashpot.fit.ranges import ABOVE, BELOW, natural_sizes, with_ranges
from dashpot.fit.scored import ScoredRun

STEP = 1e-3
TIME = STEP * np.arange(4000)


def harmonic(amplitude: float, frequency: float, stiffness: float, kind: str = "harmonic") -> ScoredRun:
    displacement = amplitude * np.sin(2.0 * np.pi * frequency * TIME)
    return ScoredRun(kind, kind, drive_from_samples(STEP, displacement), stiffness * displacement, 0)


def test_the_range_reaches_from_far_below_the_softest_run_to_well_above_the_stiffest():
    soft, stiff = 1e5, 4e6
    low, high = natural_sizes([harmonic(25e-3, 1.0, soft), harmonic(1e-3, 5.0, stiff)]).range_of("N/m")
    assert low == pytest.approx(BELOW * soft, rel=1e-3)
    assert high == pytest.approx(ABOVE * stiff, rel=1e-3)


def test_a_run_of_a_millimetre_keeps_its_sliders_in_reach_beside_long_strokes():
    # limit / stiffness is the travel after which a slider slides; it has to come far below the smallest amplitude
    amplitude = 1e-3
    sizes = natural_sizes([harmonic(amplitude, 5.0, 1e6), harmonic(100.0 * amplitude, 0.5, 1e4)])
    stiffest = sizes.range_of("N/m")[1]
    assert 1e6 * amplitude / stiffest < 0.05 * amplitude


def test_damping_follows_force_over_speed_and_times_the_record():
    amplitude, frequency, stiffness = 2e-3, 4.0, 3e5
    sizes = natural_sizes([harmonic(amplitude, frequency, stiffness)])
    speed = amplitude * 2.0 * np.pi * frequency / np.sqrt(2.0)
    assert sizes.of_unit("N*s/m") == pytest.approx(2 * (stiffness * amplitude / speed,), rel=1e-3)
    assert sizes.range_of("s") == pytest.approx((0.5 * STEP, STEP * TIME.size))


def test_a_quasi_static_run_says_nothing_about_the_size_of_dynamic_forces():
    dynamic = harmonic(2e-3, 4.0, 3e5)
    assert natural_sizes([dynamic, harmonic(0.1, 0.25, 1e6, "quasi_static")]).of_unit("N/m") == natural_sizes(
        [dynamic]
    ).of_unit("N/m")


def test_pure_numbers_and_dead_channels_have_no_natural_size():
    assert natural_sizes([harmonic(2e-3, 4.0, 3e5)]).of_unit("1") is None
    assert natural_sizes([harmonic(2e-3, 4.0, 0.0)]).of_unit("m/N") is None


def ranged(branches: str, runs: list[ScoredRun], more: str = "") -> dict[str, tuple[float, float]]:
    spec = with_ranges(network(branches, more), natural_sizes(runs))
    return {slot.path: slot.value.bounds for slot in spec.slots() if slot.value.searched}


RUNS = [harmonic(2e-3, 4.0, 3e5)]


def test_bounds_of_the_file_stay_and_fixed_numbers_get_none():
    found = ranged("it: {element: dahl, stiffness: {start: 5, bounds: [2, 9]}, limit: 3}", RUNS)
    assert found == {"it.stiffness": (2.0, 9.0)}


def test_a_logarithmic_number_is_searched_over_what_the_runs_can_feel_inside_what_makes_sense():
    found = ranged("it: {element: maxwell, stiffness: {start: 5}, relaxation_time: {start: 5 ms}}", RUNS)
    assert found["it.stiffness"] == pytest.approx((BELOW * 3e5, ABOVE * 3e5), rel=1e-3)
    assert found["it.relaxation_time"] == pytest.approx((0.5 * STEP, STEP * TIME.size))
    soft = ranged("it: {element: spring, stiffness: {start: 5}}", [harmonic(2e-3, 4.0, 1.0)])
    assert soft["it.stiffness"][0] == 1e-3


def test_a_pure_number_is_searched_where_it_makes_sense():
    branches = "it: {element: prandtl, stiffness: 5, limit: 5, sharpness: {start: 5}, exponent: {start: 0}}"
    assert ranged(branches, RUNS) == {"it.sharpness": (0.1, 1e3), "it.exponent": (0.0, 4.0)}


def test_a_linear_number_is_searched_to_both_sides():
    low, high = ranged("it: {element: inerter, inertance: {start: 0}}", RUNS)["it.inertance"]
    assert low == -high < 0.0
    assert high == pytest.approx(10.0 * 3e5 * 2.0 / (2.0 * np.pi * 4.0) ** 2, rel=1e-3)


def test_the_force_channel_is_searched_where_a_channel_may_be_wrong():
    channel = "measurement: {force: {delay: {start: 0 s}, gain: {start: 1}}}\n"
    found = ranged("it: {element: spring, stiffness: 5}", RUNS, channel)
    assert found["measurement.force.gain"] == (0.2, 5.0)
    low, high = found["measurement.force.delay"]
    assert low == -high and 0.1 <= high < 0.25  # a period of 4 Hz


def test_where_nothing_is_known_a_number_is_searched_around_its_start():
    dead = [harmonic(2e-3, 4.0, 0.0)]
    assert ranged("it: {element: spring, stiffness: {start: 600}}", dead)["it.stiffness"] == (1e-3, 1e12)


def test_a_start_outside_its_range_moves_to_the_nearest_end():
    spec = with_ranges(network("it: {element: spring, stiffness: {start: 1e9}}"), natural_sizes(RUNS))
    assert spec.slots()[0].value.number == spec.slots()[0].value.bounds[1] < 1e9


@pytest.mark.parametrize(("frequency", "latest"), [(0.5, 4.0 / np.pi / np.sqrt(0.5)), (25.0, 0.1)])
def test_a_delay_is_searched_over_less_than_a_period_of_the_motion(frequency, latest):
    """Four times what a sine of frequency f takes for its amplitude at its RMS speed, or a tenth of a second."""
    late = network("it: {element: spring, stiffness: 2 N/mm}", "measurement: {force: {delay: {start: 0 s}}}\n")
    sizes = natural_sizes([harmonic(1e-3, frequency, 2e5)])
    (slot,) = [slot for slot in with_ranges(late, sizes).slots() if slot.value.searched]
    assert slot.value.bounds == pytest.approx((-latest, latest), rel=2e-2)

"""A parameter without bounds is searched over what the runs can feel, from the gentlest to the strongest of them."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.data.drive import drive_from_samples
from dashpot.fit.ranges import ABOVE, BELOW, natural_sizes
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

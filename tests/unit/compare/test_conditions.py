"""Runs that were meant alike have the same conditions, and bands of frequency have round edges."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.compare.bands import frequency_bands
from dashpot.compare.conditions import conditions_of
from dashpot.data.order_tracking import follow
from dashpot.data.run import Run

TIME = np.arange(6000) * 1e-3


def conditions(stroke, middle=0.0, sweep=0.0, **settings):
    """Of a run from 2 Hz upwards."""
    x = middle + stroke * np.sin(2.0 * np.pi * (2.0 * TIME + 0.5 * sweep * TIME**2))
    run = Run("a", "sweep", TIME, {"displacement": x, "force": x}, settings)
    return conditions_of(run, follow(run.displacement, run.sample_time))


def test_what_the_dataset_says_counts():
    """A rig that reaches 1.64 of 2 mm has made a run of 2 mm."""
    found = conditions(1.64e-3, 20.02e-3, amplitude=2e-3, preload=20e-3, frequency=2.5)
    assert (found.amplitude, found.preload, found.frequency) == (2e-3, 20e-3, 2.5)


def test_motions_that_differ_by_a_hair_are_one_condition():
    """A regulator never reaches the same amplitude twice."""
    one, other = conditions(0.4952e-3, 15.02e-3), conditions(0.4953e-3, 14.98e-3)
    assert one == other
    assert one.amplitude == pytest.approx(0.5e-3) and one.preload == pytest.approx(15e-3)


def test_a_middle_that_is_off_by_little_is_no_preload():
    """A tenth of a millimetre beside strokes of 38."""
    assert conditions(38e-3, -0.12e-3).preload == 0.0


def test_a_sweep_has_no_frequency():
    """A steady run has one."""
    assert conditions(1e-3, sweep=2.0).frequency is None
    assert conditions(1e-3).frequency == pytest.approx(2.0)


@given(st.floats(0.01, 100.0), st.floats(1.11, 1000.0))
def test_bands_cover_the_range_with_few_round_edges(low, ratio):
    """Neighbours touch, no band is empty of the range."""
    bands = frequency_bands(low, low * ratio)
    assert 1 <= len(bands) <= 7
    assert bands[0][0] <= low * (1 + 1e-6) and bands[-1][1] >= low * ratio * (1 - 1e-6)
    assert all(one[1] == other[0] for one, other in zip(bands, bands[1:], strict=False))
    assert bands[0][1] > low and bands[-1][0] < low * ratio


def test_the_bands_of_a_usual_sweep():
    """1 to 25 Hz."""
    assert frequency_bands(1.0, 25.0) == [(0, 5), (5, 10), (10, 15), (15, 20), (20, 25)]

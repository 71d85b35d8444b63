"""Tables in numpy against scipy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator
from seeds import seed_of
from unit.kernel.networks import network

from dashpot.kernel.curves import TableLaw, cubic_coefficients, segment_of

SPEC = network("""
    it:
      element: damper
      damping: {velocity: [-1 m/s, -0.2 m/s, 0 m/s, 0.5 m/s, 2 m/s], force: [-9, -5, 0, 1, 30]}
      scale: {deflection: [5 mm, 12 mm, 20 mm], factor: [1.4, 1.2, 1]}
""")
CURVE, FACTOR = SPEC.curves().values()


def random_table(curve, lanes=6):
    values = np.random.default_rng(seed_of("test_curves")).uniform(-10.0, 10.0, (len(curve.at), lanes))
    return values, TableLaw(curve, cubic_coefficients(curve, values))


@pytest.mark.parametrize("order", [0, 1, 2])
def test_inside_its_knots_a_table_is_the_monotone_cubic(order):
    values, law = random_table(CURVE)
    cubic = PchipInterpolator(CURVE.at, values, axis=0)
    for place in np.random.default_rng(seed_of("test_curves2")).uniform(CURVE.at[0], CURVE.at[-1], 50):
        assert law(place, order) == pytest.approx(cubic(place, order), rel=1e-11, abs=1e-11)


def test_a_characteristic_goes_on_straight_beyond_its_knots():
    values, law = random_table(CURVE)
    cubic = PchipInterpolator(CURVE.at, values, axis=0)
    for end, beyond in ((-1.0, -7.0), (2.0, 55.0)):
        assert law(beyond) == pytest.approx(cubic(end) + cubic(end, 1) * (beyond - end), rel=1e-12, abs=1e-12)
        assert law(beyond, 1) == pytest.approx(cubic(end, 1), rel=1e-12, abs=1e-12)
        assert np.all(law(beyond, 2) == 0.0)


def test_a_factor_stays_what_it_is_beyond_its_knots():
    values, law = random_table(FACTOR)
    assert law(-3.0) == pytest.approx(values[0])
    assert law(3.0) == pytest.approx(values[-1])
    assert np.all(law(3.0, 1) == 0.0)


def test_every_lane_may_be_asked_at_its_own_place():
    values, law = random_table(CURVE)
    places = np.array([-3.0, -1.0, -0.1, 0.0, 0.5, 9.0])
    expected = [law(place)[lane] for lane, place in enumerate(places)]
    assert law(places) == pytest.approx(np.array(expected))


def test_the_slope_does_not_jump_at_a_knot():
    _, law = random_table(CURVE)
    for place in CURVE.at:
        assert law(place - 1e-9, 1) == pytest.approx(law(place + 1e-9, 1), abs=1e-4)


def test_segments_are_measured_from_the_knot_below():
    segment, distance = segment_of(CURVE, np.array([-4.0, -1.0, -0.1, 0.5, 7.0, np.nan]))
    assert segment.tolist() == [0, 1, 2, 4, 5, 5]
    assert distance[:5] == pytest.approx([-3.0, 0.0, 0.1, 0.0, 5.0])
    assert np.isnan(distance[5])


def test_a_lane_with_a_value_that_is_no_number_is_nan_throughout_and_alone():
    values, law = random_table(CURVE)
    broken = values.copy()
    broken[4, 1], broken[0, 3] = np.nan, np.inf
    found = TableLaw(CURVE, cubic_coefficients(CURVE, broken))
    for place in (-5.0, 0.1, 5.0):
        assert np.isnan(found(place)[[1, 3]]).all()
        assert np.array_equal(np.delete(found(place), [1, 3]), np.delete(law(place), [1, 3]))


def test_two_knots_are_a_straight_line():
    curve = replace(CURVE, at=(0.0, 2.0))
    law = TableLaw(curve, cubic_coefficients(curve, np.array([[1.0], [5.0]])))
    assert [float(law(place)[0]) for place in (-1.0, 0.0, 0.5, 2.0, 3.0)] == pytest.approx([-1.0, 1.0, 2.0, 5.0, 7.0])

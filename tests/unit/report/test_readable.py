"""Numbers are written with the digits they deserve, in the units of the rig."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.report.readable import join, number, percent, percent_interval, rig_unit, with_interval


@given(st.floats(-1e12, 1e12), st.integers(1, 8))
def test_a_written_number_is_right_to_its_last_digit(value, digits):
    written = float(number(value, digits))
    assert abs(written - value) <= 0.5000001 * 10.0 ** (math.floor(math.log10(abs(value) or 1.0)) + 1 - digits)


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [(61.0, 3, "61.0"), (14.53, 3, "14.5"), (4.207, 2, "4.2"), (9.996, 3, "10.0"), (1234.5, 3, "1234"), (0.0, 3, "0")],
)
def test_trailing_digits_are_kept_and_whole_digits_never_cut(value, digits, text):
    assert number(value, digits) == text


@pytest.mark.parametrize("value", [None, math.nan, math.inf])
def test_a_missing_number_is_a_dash(value):
    assert number(value) == percent(value) == with_interval(value, None, "N") == "–"


@pytest.mark.parametrize(
    ("value", "interval", "unit", "text"),
    [
        (41.0, [38.0, 44.0], "N", "41 N [38, 44]"),
        (220e3, [219.2e3, 220.9e3], "N/m", "220.0 N/mm [219.2, 220.9]"),
        (0.16, [0.02, 0.9], "s", "160 ms [20, 900]"),
        (45e-6, [40e-6, 50e-6], "s", "45 us [40, 50]"),
        (41.0, None, "N", "41.0 N"),
        (41.0, [38.0, None], "N", "41.0 N"),
        (0.5, [0.5, 0.5], "", "0.5000 [0.5000, 0.5000]"),
    ],
)
def test_a_value_has_as_many_decimals_as_its_interval_deserves(value, interval, unit, text):
    assert with_interval(value, interval, unit) == text


@given(st.floats(1e-6, 1e9), st.sampled_from(["N", "m", "s", "N/m", "N*s/m", "kg", "Hz"]))
def test_the_rig_unit_means_the_same_value(value, unit):
    from dashpot.text.quantity import si

    factor, name = rig_unit(unit, value)
    assert si(f"{value * factor!r} {name}", unit) == pytest.approx(value, rel=1e-12)


def test_shares_are_written_in_percent():
    assert percent(0.76) == "76 %"
    assert percent_interval([0.71, 0.80]) == "71 to 80"
    assert percent_interval([-0.03, 0.06]) == "-3 to 6"
    assert percent_interval(None) is None


def test_words_are_joined_as_in_a_sentence():
    assert [join(list("abc")[:count]) for count in (1, 2, 3)] == ["a", "a and b", "a, b and c"]

"""Numbers are written with the digits they deserve, in the units of the rig."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.text.digits import beside, number, number_within, rig_unit, typeset, with_interval


@pytest.mark.parametrize("value", [None, math.nan, math.inf])
def test_a_missing_number_is_a_dash(value):
    assert number(value) == with_interval(value, None, "N") == "–"


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


@pytest.mark.parametrize(
    ("value", "interval", "unit", "text"),
    [
        (41.0, [38.0, 44.0], "N", "41 N [38, 44]"),
        (220e3, [219.2e3, 220.9e3], "N/m", "220.0 N/mm [219.2, 220.9]"),
        (0.16, [0.02, 0.9], "s", "160 ms [20, 900]"),
        (45e-6, [40e-6, 50e-6], "s", "45 µs [40, 50]"),
        (41.0, None, "N", "41.0 N"),
        (41.0, [38.0, None], "N", "41.0 N"),
        (0.5, [0.5, 0.5], "", "0.500 [0.500, 0.500]"),
        (7.97, [4.92, 12.91], "N*s/m", "8 N·s/m [5, 13]"),
        (2.5e-3, [2.4999e-3, 2.5001e-3], "m", "2.50000 mm [2.49990, 2.50010]"),
        (2e-4, [0.0, 4e-3], "", "0.0002 [0, 0.004]"),
        (1e-9, [0.0, 0.5], "", "1e-09 [0, 0.5]"),
        (2.54e-10, [2.31e-10, 2.77e-10], "", "2.5e-10 [2.3e-10, 2.8e-10]"),
        (2.54e-10, [-1.1e-11, 5.2e-10], "", "3e-10 [-1e-11, 5e-10]"),
        (8.17e14, [1e14, 3e15], "N", "8.17e+11 kN [1.00e+11, 3.00e+12]"),
    ],
)
def test_a_value_has_as_many_decimals_as_its_interval_deserves(value, interval, unit, text):
    assert with_interval(value, interval, unit) == text


@given(st.floats(1e-6, 1e9), st.sampled_from(["N", "m", "s", "N/m", "N*s/m", "kg", "Hz"]))
def test_the_rig_unit_means_the_same_value(value, unit):
    from dashpot.text.quantity import si

    factor, name = rig_unit(unit, value)
    assert si(f"{value * factor!r} {name}", unit) == pytest.approx(value, rel=1e-12)


@given(st.floats(-1e6, 1e6).filter(lambda value: abs(value) > 1e-6), st.floats(1e-9, 1e6))
def test_a_number_is_right_to_a_half_of_its_interval_and_never_shown_as_zero(value, half):
    shown = float(number_within(value, (value - half, value + half)))
    assert shown != 0.0
    assert abs(shown - value) <= half


@pytest.mark.parametrize(
    ("written", "printed"),
    [
        ("N*s/mm", "N·s/mm"),
        ("5 kN*s^2/m^2", "5 kN·s²/m²"),
        ("45 um", "45 µm"),
        ("N/um", "N/µm"),
        ("mm/s", "mm/s"),
        ("1/(us*K)", "1/(µs·K)"),
        ("a drum", "a drum"),
    ],
)
def test_units_are_printed_with_their_signs(written, printed):
    from dashpot.text.quantity import si

    assert typeset(written) == printed
    if written[0].isdigit() and "/" not in written:
        assert si(printed, "m") == si(written, "m")


def test_what_is_measured_beside_zero_is_zero():
    assert str(beside(-0.83e-6, 31e-3)) == "0.0"
    assert [beside(value, 31e-3) for value in (9.58768e-3, 31.0016e-3)] == [9.59e-3, 31e-3]
    assert beside(2e-9, 0.0) == 2e-9

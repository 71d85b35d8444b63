"""Any unit at the border, SI inside; a unit of the wrong kind never passes."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dashpot.text.quantity import (
    USUAL,
    USUAL_POWERS,
    base_unit,
    factor,
    force_dimension,
    in_unit,
    is_unit,
    measure,
    powers,
    pretty,
    pretty_all,
    si,
    unit_of,
)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("220 N/mm", "N/m", 220e3),
        ("3 mm", "m", 3e-3),
        ("160 ms", "s", 0.16),
        ("160ms", "s", 0.16),
        ("0.2 N*s/mm", "N*s/m", 200.0),
        ("0.2 Ns/mm", "N*s/m", 200.0),
        ("0.2 N·s/mm", "N*s/m", 200.0),
        ("0.2 N s/mm", "N*s/m", 200.0),
        ("0.2 N/(mm/s)", "N*s/m", 200.0),
        ("5 %", "1", 0.05),
        ("0.3", "1", 0.3),
        ("600 1/min", "Hz", 10.0),
        ("600 /min", "Hz", 10.0),
        ("600 rpm", "Hz", 10.0),
        ("50 us", "s", 50e-6),
        ("50 µs", "s", 50e-6),
        ("50 μs", "s", 50e-6),
        ("1 tonf", "N", 9806.65),
        ("1 kgf", "N", 9.80665),
        ("1 kip", "N", 4448.2216152605),
        ("1 lbf", "N", 4.4482216152605),
        ("1 in", "m", 0.0254),
        ("23 °C", "K", 296.15),
        ("23 degC", "K", 296.15),
        ("2 N/mm²", "Pa", 2e6),
        ("1 bar", "Pa", 1e5),
        ("3 g0", "m/s^2", 29.41995),
        ("4 N/(mm/s)^0.5", "N/(m/s)^0.5", 4 * math.sqrt(1000)),
        ("−3 mm", "m", -3e-3),
        ("1.5e3 N", "N", 1500.0),
        ("180 deg", "rad", math.pi),
        ("2 t", "kg", 2000.0),
        ("3 N", "N", 3.0),
        (5, "m", 5.0),
        (2.5, "N/m", 2.5),
        ("7", "N", 7.0),
    ],
)
def test_a_quantity_becomes_an_si_number(text, unit, value):
    assert si(text, unit) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("3 mm", "N", "expected a quantity in N, got 'mm', which measures length; write it in N"),
        ("3 N", "1", "expected a plain number, got 'N'"),
        ("3 hz", "Hz", "unknown unit 'hz'; did you mean 'Hz'?"),
        ("3 KN", "N", "did you mean 'kN'?"),
        ("3 furlong", "m", "units look like"),
        ("1,5 mm", "m", "the decimal sign is a point"),
        ("mm", "m", "expected a quantity in m, got 'mm'"),
        ("", "m", "expected a quantity in m, got ''"),
        ("10 rad/s", "Hz", "divide by 2*pi"),
        ("3 g", "m/s^2", "written g0"),
        ("3 lb", "N", "written lbf"),
        ("5 deg", "m", "on a lever of 1 m: 'unit: m, gain: 0.0174533' for degrees"),
        ("5 kN*m", "N", "'unit: N' for N*m"),
        ("1e999 m", "m", "expected a finite number"),
        (math.nan, "m", "expected a finite number"),
        (True, "m", "expected a quantity in m, got 'True'"),
        (None, "m", "expected a quantity in m, got 'None'"),
        ("3 N/mm)", "m", "unknown unit"),
        ("3 m^99", "m", "unknown unit"),
        ("3 m^", "m", "unknown unit"),
        ("3 N/0", "N", "unknown unit"),
        ("3 __import__('os')", "m", "unknown unit"),
    ],
)
def test_what_is_wrong_with_a_quantity_is_told(text, unit, expected):
    with pytest.raises(ValueError) as caught:
        si(text, unit)
    assert expected in str(caught.value)


@given(st.text("Nm/s*^%()1 23k.-_", max_size=12))
def test_any_text_is_a_quantity_or_a_value_error(text):
    try:
        value = si("1 " + text, "N*s/m")
    except ValueError:
        return
    assert math.isfinite(value)


def test_a_factor_and_an_offset_lead_to_si():
    assert factor("mm", "m") == (1e-3, 0.0)
    assert factor("degC", "K") == (1.0, 273.15)
    assert factor("%", "1") == (0.01, 0.0)


@pytest.mark.parametrize(
    ("unit", "power"),
    [("N/m", 1), ("N", 1), ("s", 0), ("N*s/m", 1), ("kg", 1), ("1", 0), ("m/N", -1), ("N/(m/s)^0.5", 1), ("Pa", 1)],
)
def test_the_power_of_the_force_in_a_unit(unit, power):
    assert force_dimension(unit) == power


def test_a_broken_power_of_the_force_is_refused():
    with pytest.raises(ValueError, match="whole power of force"):
        force_dimension("N^0.5")


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (220e3, "N/m", "220 N/mm"),
        (0.16, "s", "160 ms"),
        (200.0, "N*s/m", "0.2 N*s/mm"),
        (0.0042, "m", "4.2 mm"),
        (41.0, "N", "41 N"),
        (15e3, "N", "15 kN"),
        (0.0, "m", "0 mm"),
        (3.0, "1", "3"),
        (5.5, "N*s^2/m^2", "5.5 N*s^2/m^2"),
        (-0.003, "m", "-3 mm"),
        (2.5, "s", "2.5 s"),
        (1.23456, "Hz", "1.235 Hz"),
        (1e12, "1", "1e+12"),
        (60.0, "kg", "60 kg"),
        (5.75e-6, "N/Pa", "0.575 N/bar"),
        (-0.02, "N/m/Pa", "-2 N/mm/bar"),
        (0.0, "N*s/m/Pa", "0 N*s/mm/bar"),
        (0.4, "N/K", "0.4 N/K"),
    ],
)
def test_a_number_is_shown_in_the_units_of_the_rig(value, unit, text):
    assert pretty(value, unit) == text


@given(
    value=st.floats(-1e300, 1e300),
    unit=st.sampled_from(["N/m", "s", "N*s/m", "m", "1", "kg", "Hz", "N*s^2/m^2", "K", "N/Pa", "N/m/Pa"]),
)
def test_what_is_shown_reads_back(value, unit):
    assert si(pretty(value, unit, digits=17), unit) == pytest.approx(value, rel=1e-15, abs=1e-320)
    assert si(pretty(value, unit), unit) == pytest.approx(value, rel=5.0001e-4, abs=1e-320)


@pytest.mark.parametrize("value", [math.inf, math.nan])
def test_only_finite_numbers_are_shown(value):
    with pytest.raises(ValueError, match="expected a finite number in N"):
        pretty(value, "N")


@pytest.mark.parametrize(
    ("text", "known"), [("kN", True), ("N*s/mm", True), ("%", True), ("Kraft", False), ("", False)]
)
def test_a_unit_is_told_from_other_words(text, known):
    assert is_unit(text) is known


@pytest.mark.parametrize(("unit", "base"), [("kN", "kg^1*m^1*s^-2"), ("degC", "K^1"), ("%", "1"), ("rpm", "s^-1")])
def test_every_unit_has_an_si_base_unit(unit, base):
    assert base_unit(unit) == base


@pytest.mark.parametrize(
    ("text", "value"), [("3 bar", 3e5), ("30 lbf", 133.446648457815), ("2.5", 2.5), (4, 4.0), ("23 °C", 296.15)]
)
def test_a_quantity_of_any_kind_is_measured_in_base_units(text, value):
    assert measure(text) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "unit"), [("3 bar", "bar"), (" 23 °C", "°C"), ("2 /s", "1/s"), ("5", ""), ("-1.5e3 N/mm", "N/mm")]
)
def test_a_quantity_is_written_again_in_its_unit(text, unit):
    assert unit_of(text) == unit
    assert measure(in_unit(measure(text), unit, 12)) == pytest.approx(measure(text), rel=1e-12)


@pytest.mark.parametrize("text", ["dry", "3 furlong", "", "1,5 mm"])
def test_what_is_no_quantity_is_not_measured(text):
    with pytest.raises(ValueError):
        measure(text)


@pytest.mark.parametrize(("given", "wanted"), list(USUAL))
def test_the_factors_of_usual_units_are_those_of_the_library_of_units(given, wanted):
    assert factor(given, wanted) == factor(f"1*{given}", wanted)


@pytest.mark.parametrize("unit", USUAL_POWERS)
def test_the_powers_of_usual_units_are_those_of_the_library_of_units(unit):
    assert powers(unit) == powers(f"1*{unit}")


@pytest.mark.parametrize("unit", ["N/mmm", "", "parsec?", "N N N"])
def test_a_unit_that_is_wanted_from_itself_is_still_looked_up_where_it_is_odd(unit):
    with pytest.raises(ValueError, match="unknown unit|expected"):
        factor(unit, "N")


def test_numbers_of_one_kind_stand_in_one_unit():
    assert pretty_all([-0.83646106e-6, 1.347095e-3, 31e-3], "m", 8) == ["-0.00083646106 mm", "1.347095 mm", "31 mm"]
    assert pretty_all([0.0, 0.0], "m") == ["0 mm", "0 mm"]
    assert pretty_all([12.9e3, 4.92e-2], "N") == ["12.9 kN", "0.0000492 kN"]
    assert pretty_all([], "N") == []


def test_a_compliance_stands_in_millimetres_a_newton():
    assert pretty(7.69e-5, "m/N") == "0.0769 mm/N"

"""Numbers over a setting or a channel: reading them, their paths, and writing what was found."""

from dataclasses import replace

import pytest
from jsonschema import Draft7Validator

from dashpot import load_registry
from dashpot.model.patch import fill_numbers
from dashpot.model.reading import parse_network
from dashpot.model.schema import network_schema
from dashpot.text.document import Document
from dashpot.text.problem import InputError

ELEMENTS = load_registry().elements


def text(number, more=""):
    return (
        "format: dashpot-network/1\nname: over\nbranches:\n  it:\n    element: dahl\n    stiffness: 100 N/mm\n"
        f"    limit: {number}\n{more}"
    )


def read(number, more=""):
    return parse_network(text(number, more), ELEMENTS, "n.yaml")


LINE = "{start: 30 N, over: {setting: pressure, at: 2 bar, slope: {start: 5 N/bar}}}"
RATE = "{fixed: 30 N, over: {channel: temperature, at: 20 degC, rate: -1 %/K}}"
TABLE = "{start: 30 N, over: {setting: current, at: [0 A, 1 A, 2 A], factor: [1, {start: 2}, {start: 2.5}]}}"

KEPT = "{start: 30 N, over: {setting: moved, kept: {start: 0.4}}}"
WLF = "{start: 30 N, over: {setting: temperature, at: 20 degC, wlf: [17.44, {start: 51.6 K}]}}"
ARRHENIUS = "{start: 30 N, over: {channel: temperature, at: 20 degC, arrhenius: {start: 5000 K}}}"


def slots(spec):
    return {slot.path: slot.value for slot in spec.slots()}


def test_a_slope_is_a_number_of_its_own():
    found = slots(read(LINE))
    assert list(found) == ["it.stiffness", "it.limit", "it.limit.slope"]
    assert found["it.limit.slope"].number == pytest.approx(5e-5)
    assert found["it.limit.slope"].unit == "N/Pa"
    assert found["it.limit"].over.at == (2e5,)
    assert [value.searched for value in found.values()] == [False, True, True]


def test_a_rate_over_a_channel_on_a_fixed_number():
    found = slots(read(RATE))
    assert found["it.limit.rate"].number == pytest.approx(-0.01)
    assert found["it.limit"].over.at == (pytest.approx(293.15),)
    assert (found["it.limit"].over.word, found["it.limit"].over.channel) == ("temperature", True)
    assert not any(value.searched for value in found.values())


def test_factors_between_places():
    found = slots(read(TABLE))
    assert list(found)[2:] == ["it.limit.factor[0]", "it.limit.factor[1]", "it.limit.factor[2]"]
    assert [value.searched for value in found.values()][2:] == [False, True, True]


@pytest.mark.parametrize(
    ("number", "message"),
    [
        ("{start: 30 N, over: {setting: p, slope: 1 N/bar}}", "lacks 'at'. give the setting"),
        ("{start: 30 N, over: {setting: p, at: 2 bar}}", "lacks one of slope, rate, factor, wlf, arrhenius, kept"),
        ("{start: 30 N, over: {setting: moved, at: 0 J, kept: 0.5}}", "has no key 'at'"),
        ("{start: 30 N, over: {setting: moved, kept: 1.5}}", "expected 0 to 1"),
        ("{start: 30 N, over: {setting: T, at: 20 degC, wlf: 17}}", "expected [C1, C2], got"),
        ("{start: 30 N, over: {setting: T, at: 20 degC, wlf: [17, 50 mm]}}", "expected a quantity in K, got 'mm'"),
        ("{start: 30 N, over: {setting: p, at: 2 bar, arrhenius: 5000 K}}", "expected a temperature, as 'arrhenius'"),
        ("{start: 30 N, over: {at: 2 bar, slope: 1 N/bar}}", "lacks 'setting'"),
        ("{start: 30 N, over: {setting: p, at: 2 bar, slope: 1 N/mm}}", "expected a quantity in N/Pa, got 'N/mm'"),
        ("{start: 30 N, over: {setting: p, at: 2 furlong, slope: 1 N}}", "unknown unit 'furlong'"),
        ("{start: 30 N, over: {setting: p, at: [1, 2], factor: [1]}}", "expected a list of 2 factors"),
        ("{start: 30 N, over: {setting: p, at: [2, 1], factor: [1, 2]}}", "expected growing settings"),
        ("{start: 30 N, over: {setting: p, at: [1 bar, 2], factor: [1, 2]}}", "expected settings of one kind"),
        ("{start: 30 N, over: {setting: p, at: 1, slope: 1 N, rate: 2}}", "has no key 'rate'"),
        (
            "{start: 30 N, over: {setting: p, at: 1, slope: {start: 1 N, over: {setting: q, at: 1, slope: 1 N}}}}",
            "the slope cannot depend on a setting itself",
        ),
        ("{fixed: 30 N}", "'fixed' is for a parameter with 'over'. write the value alone"),
        ("{fixed: 1e12 N, over: {setting: p, at: 1, slope: 1 N}}", "expected 1e-06 to 1e+09 N, got 1e+12"),
    ],
)
def test_mistakes_are_told_where_they_are(number, message):
    with pytest.raises(InputError) as caught:
        read(number)
    assert message in str(caught.value)
    assert "n.yaml:7" in str(caught.value)


def test_most_numbers_of_the_load_cell_and_a_knot_of_a_table_stay_as_they_are():
    over = "{start: 1 N, over: {setting: p, at: 1, slope: 1 N}}"
    with pytest.raises(InputError, match="of the load cell only gain and offset may depend on a setting"):
        read("30 N", f"measurement: {{force: {{largest: {over}}}}}\n")
    with pytest.raises(InputError, match="a knot of a table cannot depend on a setting"):
        read("30 N", f"  s: {{element: spring, stiffness: {{deflection: [0 mm, 1 mm], force: [0 N, {over}]}}}}\n")


def test_what_is_kept_of_the_runs_before_needs_no_place():
    found = slots(read(KEPT))
    assert list(found)[2:] == ["it.limit.kept"]
    assert (found["it.limit.kept"].number, found["it.limit.kept"].sensible) == (0.4, (0.0, 1.0))
    assert found["it.limit.kept"].searched


def test_shifts_with_temperature():
    found = slots(read(WLF))
    assert list(found)[2:] == ["it.limit.wlf[0]", "it.limit.wlf[1]"]
    assert [(value.number, value.unit, value.searched) for value in list(found.values())[2:]] == [
        (17.44, "1", False),
        (51.6, "K", True),
    ]
    found = slots(read(ARRHENIUS))
    assert found["it.limit.arrhenius"].number == 5000.0 and found["it.limit"].over.at == (pytest.approx(293.15),)


@pytest.mark.parametrize("number", [LINE, RATE, TABLE, WLF, ARRHENIUS, KEPT])
def test_the_schema_knows_them(number):
    validator = Draft7Validator(network_schema(ELEMENTS))
    assert not list(validator.iter_errors(Document.parse(text(number)).root.plain()))


@pytest.mark.parametrize(
    "over",
    [
        "{setting: p, slope: 1}",
        "{setting: p, channel: q, at: 1, slope: 1}",
        "{setting: p, at: 1, factor: [1, 2]}",
        "{setting: p, at: 1}",
    ],
)
def test_the_schema_refuses_what_reading_refuses(over):
    number = f"{{start: 30 N, over: {over}}}"
    validator = Draft7Validator(network_schema(ELEMENTS))
    assert list(validator.iter_errors(Document.parse(text(number)).root.plain()))
    with pytest.raises(InputError):
        read(number)


@pytest.mark.parametrize("number", [LINE, TABLE, KEPT])
def test_what_was_found_is_written_and_read_again(number):
    spec = read(number)
    moved = {
        path: replace(value, number=1.5 * value.number, interval=(value.number, 2.0 * value.number))
        for path, value in slots(spec).items()
        if value.searched
    }
    again = parse_network(fill_numbers(spec, spec.with_values(moved), {}), ELEMENTS)
    for path, value in moved.items():
        assert slots(again)[path].number == pytest.approx(value.number)
        assert slots(again)[path].role == "identified"
        assert slots(again)[path].interval == pytest.approx(value.interval)
    assert slots(again)["it.limit"].over.at == slots(spec)["it.limit"].over.at


def test_the_copies_of_a_repeated_branch_have_slopes_of_their_own_that_are_written_as_a_list():
    more = (
        "  r: {repeat: 2, element: maxwell, relaxation_time: [10 ms, 0.1 s], stiffness: {start: [5 N/mm, 6 N/mm], "
        "over: {setting: p, at: 2 bar, slope: {start: 0 N/mm/bar}}}}\n"
    )
    spec = read("30 N", more)
    slopes = [path for path in slots(spec) if path.endswith("slope")]
    assert slopes == ["r_1.stiffness.slope", "r_2.stiffness.slope"]
    moved = {path: replace(slots(spec)[path], number=float(number)) for number, path in enumerate(slopes, 1)}
    again = slots(parse_network(fill_numbers(spec, spec.with_values(moved), {}), ELEMENTS))
    assert [again[path].number for path in slopes] == [1.0, 2.0]


def test_a_slope_over_a_pressure_is_written_per_bar():
    spec = read(
        LINE,
        "  s: {element: spring, stiffness: {start: 1 N/mm, over: {setting: p, "
        "at: 2 bar, slope: {start: 1 N/mm/bar}}}}\n",
    )
    assert "slope: {value: 1 N/mm/bar}" in fill_numbers(spec, spec, {})

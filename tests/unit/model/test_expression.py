"""Numbers that follow from others: where names are looked up, what is computed, what is refused."""

from __future__ import annotations

import math
from textwrap import dedent

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.model.expression import parse_expression
from dashpot.model.lint import find_weaknesses
from dashpot.model.patch import fill_numbers
from dashpot.model.reading import parse_network, read_network
from dashpot.text.problem import InputError

HEAD = "format: dashpot-network/1\nname: tied\nbranches:\n"


def network(branches: str, more: str = "", file: str | None = None):
    text = HEAD + "".join(f"  {line}\n" for line in dedent(branches).strip().splitlines()) + more
    return parse_network(text, load_registry().elements, file)


def numbers(spec) -> dict[str, float]:
    return {slot.path: slot.value.number for slot in spec.slots()}


def complaint(branches: str) -> str:
    with pytest.raises(InputError) as caught:
        network(branches)
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2 * rubber.stiffness", 4e5),
        ("rubber.stiffness / 4 + 10 N/mm - 1 kN/m", 59e3),
        ("rubber.stiffness - 2 * ( 10 N/mm + 20 N/mm )", 140e3),
        ("sqrt(rubber.stiffness ^ 2 + (3 N/mm) ^ 2)", math.hypot(2e5, 3e3)),
        ("max(rubber.stiffness, 300 N/mm, 1 N/m) * exp(-0.5)", 3e5 * math.exp(-0.5)),
        ("rubber.stiffness * log(2.5) / min(2, 4)", 1e5 * math.log(2.5)),
        ("400 N / 2 mm", 2e5),
    ],
)
def test_an_expression_is_computed_as_written(text, expected):
    spec = network(f"""
        rubber: {{element: spring, stiffness: {{start: 200 N/mm}}}}
        other: {{element: spring, stiffness: {{expression: "{text}"}}}}
    """)
    assert numbers(spec)["other.stiffness"] == pytest.approx(expected, rel=1e-14)


def test_the_unit_of_critical_damping_follows_from_stiffness_and_mass():
    text = """\
format: dashpot-network/1
name: wheel
nodes: {road: driven, wheel: {mass: {start: 40 kg}}, body: ground}
branches:
  tire: {element: spring, stiffness: {start: 200 N/mm}, between: [road, wheel]}
  oil: {element: damper, damping: {expression: 0.2 * 2 * sqrt(tire.stiffness * wheel.mass)}, between: [wheel, body]}
"""
    spec = parse_network(text, load_registry().elements)
    assert numbers(spec)["oil.damping"] == pytest.approx(0.4 * math.sqrt(2e5 * 40.0), rel=1e-14)


def test_what_follows_from_what_follows_is_computed_in_turn():
    spec = network("""
        last: {element: spring, stiffness: {expression: 2 * middle.stiffness}}
        middle: {element: spring, stiffness: {expression: 3 * first.stiffness}}
        first: {element: spring, stiffness: {start: 1 N/mm}}
    """)
    assert numbers(spec) == pytest.approx({"last.stiffness": 6e3, "middle.stiffness": 3e3, "first.stiffness": 1e3})


def test_lanes_are_filled_side_by_side():
    spec = network("""
        first: {element: spring, stiffness: {start: 1 N/mm}}
        oil: {element: damper, damping: {expression: 2 ms * first.stiffness}}
    """)
    lanes = spec.derived.fill(np.array([[1e3, 0.0], [5e3, 0.0], [np.inf, 0.0]]))
    assert lanes[:2, 1] == pytest.approx([2.0, 10.0])
    assert np.isnan(lanes[2, 1])  # outside of what a damping can be: this lane fails


def test_a_name_is_that_of_the_nearest_group_around_it():
    spec = network("""
        rubber: {element: spring, stiffness: 100 N/mm}
        group:
          parallel:
            rubber: {element: spring, stiffness: 7 N/mm}
            near: {element: spring, stiffness: {expression: 2 * rubber.stiffness}}
            own: {element: maxwell, stiffness: 3 N/mm, relaxation_time: {expression: "1 s * stiffness / 30 N/mm"}}
        far: {element: spring, stiffness: {expression: 2 * rubber.stiffness}}
    """)
    found = numbers(spec)
    assert found["group.near.stiffness"] == pytest.approx(14e3)
    assert found["far.stiffness"] == pytest.approx(200e3)
    assert found["group.own.relaxation_time"] == pytest.approx(0.1)


def test_a_used_network_keeps_its_own_names_also_written_out(tmp_path):
    (tmp_path / "inner.yaml").write_text(
        HEAD
        + "  rubber: {element: spring, stiffness: {start: 7 N/mm}}\n"
        + "  twice: {element: spring, stiffness: {expression: 2 * rubber.stiffness}}\n"
    )
    file = tmp_path / "outer.yaml"
    file.write_text(HEAD + "  rubber: {element: spring, stiffness: 1 N/mm}\n  part: {use: inner.yaml}\n")
    spec = read_network(file, load_registry().elements)
    assert numbers(spec)["part.twice.stiffness"] == pytest.approx(14e3)
    moved = spec.with_values(
        {
            "part.rubber.stiffness": parse_network(
                HEAD + "  rubber: {element: spring, stiffness: {start: 9 N/mm}}\n", load_registry().elements
            )
            .slots()[0]
            .value
        }
    )
    assert numbers(moved)["part.twice.stiffness"] == pytest.approx(18e3)
    again = parse_network(fill_numbers(spec, moved, {}), load_registry().elements)
    assert numbers(again) == pytest.approx(numbers(moved))
    assert {slot.path: slot.value.expression for slot in again.slots()}["part.twice.stiffness"]


def test_copies_follow_each_by_an_expression_of_its_own():
    spec = network("""
        ladder:
          repeat: 2
          element: maxwell
          stiffness: [6 N/mm, 4 N/mm]
          relaxation_time: {expression: ["0.1 s * ladder_2.stiffness / ladder_1.stiffness", 0.3 s]}
    """)
    found = numbers(spec)
    assert found["ladder_1.relaxation_time"] == pytest.approx(0.1 * 4 / 6)
    assert found["ladder_2.relaxation_time"] == pytest.approx(0.3)


def test_a_knot_and_a_measured_gain_may_follow():
    spec = network(
        """
        curve:
          element: spring
          stiffness: {deflection: [0 mm, 1 mm], force: [0 N, {expression: 1 mm * rubber.stiffness}]}
        rubber: {element: spring, stiffness: 5 N/mm}
        """,
        "measurement: {force: {gain: {expression: rubber.stiffness / 4 N/mm}, offset: {start: 0 N}}}\n",
    )
    found = numbers(spec)
    assert found["curve.stiffness[1]"] == pytest.approx(5.0)
    assert found["measurement.force.gain"] == pytest.approx(1.25)


SPRING = "front: {element: spring, stiffness: {start: 200 N/mm}}\n"


@pytest.mark.parametrize(
    ("expression", "told"),
    [
        ("0.5 * front.stiffness", "expected an expression in N/(m/s), got one that measures mass * time^-2"),
        ("0.5 s * frunt.stiffness", "there is no parameter 'frunt.stiffness'. did you mean 'front.stiffness'?"),
        ("front.stiffness + 5", "expected quantities of one kind on both sides of a sum"),
        ("2 * damping", "the parameter refers to itself by 'damping'"),
        ("0.5*front.stiffness", "write operators between spaces"),
        ("1 s * front.stiffness )", "expected an operator, got ')'"),
        ("1 s * ( front.stiffness", "expected ')', got nothing"),
        ("1 s *", "at the end of the expression, got nothing"),
        ("1 s * front.stiffness ^ front.stiffness", "expected a plain number as exponent"),
        ("exp(front.stiffness) * 1 N*s/m", "expected a ratio in exp(...), got mass * time^-2"),
        ("min(1 N*s/m)", "expected two or more numbers in min(...), got 1"),
        ("sqrt(-1) * 1 N*s/m", "got a constant that is none"),
        ("1 furlong", "unknown unit 'furlong'"),
        ("__import__('os')", "expected"),
        ("1 s * front.stiffness - 300 N*s/mm", "expected an expression that gives 0.0001 to 1e+11 N/(m/s)"),
    ],
)
def test_what_is_no_expression_is_refused_with_its_place(expression, told):
    message = complaint(SPRING + f'oil: {{element: damper, damping: {{expression: "{expression}"}}}}')
    assert told in message
    assert message.split(":")[1] == "5" or ":5:" in message


def test_numbers_that_follow_from_one_another_are_refused():
    message = complaint("""
        a: {element: spring, stiffness: {expression: 2 * b.stiffness}}
        b: {element: spring, stiffness: {expression: 0.5 * a.stiffness}}
    """)
    assert "'a.stiffness', 'b.stiffness' follow from one another in a circle" in message


def test_a_number_that_runs_give_cannot_be_referred_to():
    message = complaint("""
        a: {element: spring, stiffness: {setting: stiffness, value: 5 N/mm}}
        b: {element: spring, stiffness: {expression: 2 * a.stiffness}}
    """)
    assert "depends on a setting and differs from run to run" in message


def test_a_long_or_deep_text_is_refused_at_once():
    with pytest.raises(ValueError, match="up to 500 characters"):
        parse_expression("1 + " * 200 + "1")
    with pytest.raises(ValueError, match="up to 50 deep"):
        parse_expression("(" * 60 + "1" + ")" * 60)


def test_a_number_that_is_felt_only_through_another_has_influence():
    spec = network("""
        rubber: {element: spring, stiffness: 100 N/mm}
        own: {element: maxwell, stiffness: {start: 30 N/mm}, relaxation_time: {expression: 2 * other.relaxation_time}}
        other: {element: maxwell, stiffness: {expression: 0.5 * own.stiffness}, relaxation_time: {start: 5 ms}}
    """)
    assert list(find_weaknesses(spec)) == []

"""What is weak in a structure is told before any data; what is not weak is not complained of."""

from __future__ import annotations

from textwrap import dedent

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dashpot import load_registry
from dashpot.model.element import Element, Parameter, Response
from dashpot.model.lint import find_weaknesses
from dashpot.model.reading import parse_network, read_network
from dashpot.model.shipped import shipped_networks
from dashpot.text.problem import Problem

ELEMENTS = load_registry().elements
SPRING = "element: spring, stiffness: 200 N/mm"


def weak(branches: str, nodes: str = "", gravity: str = "") -> list[Problem]:
    head = f"format: dashpot-network/1\nname: n\n{gravity}" + (f"nodes: {nodes}\n" if nodes else "")
    text = head + "branches:\n  " + dedent(branches).strip("\n").replace("\n", "\n  ") + "\n"
    return list(find_weaknesses(parse_network(text, ELEMENTS, "n.yaml")))


def told(found: list[Problem]) -> list[str]:
    return [str(problem) for problem in found]


@pytest.mark.parametrize("name", shipped_networks())
def test_no_shipped_network_is_weak(name):
    assert told(find_weaknesses(read_network(name, ELEMENTS))) == []


def test_a_node_that_nothing_connects():
    (found,) = weak(f"it: {{{SPRING}, between: [a, b]}}", "{a: driven, b: ground, c: {mass: 3 kg}}")
    assert str(found) == "n.yaml:3:34: nothing connects the node 'c'. connect it by a branch, or remove it"
    (found,) = weak(f"it: {{{SPRING}, between: [a, b]}}", "{a: driven, b: ground, c: driven}")
    assert str(found).startswith("n.yaml:3:34: warning: nothing connects the node 'c'")


def test_nodes_that_hang_on_nothing():
    found = weak(
        f"""
        it: {{{SPRING}, between: [a, b]}}
        other: {{{SPRING}, between: [c, d]}}
    """,
        "{a: driven, b: ground, c: {mass: 3 kg}, d: free}",
    )
    assert told(found) == [
        f"n.yaml:3:{column}: the node '{name}' floats: no chain of branches leads from it to a driven or held node. "
        "connect it to a node that is 'driven' or 'ground'"
        for column, name in ((34, "c"), (51, "d"))
    ]


def test_a_network_that_nothing_moves():
    (found,) = weak(f"it: {{{SPRING}, between: [a, b]}}", "{a: {mass: 3 kg}, b: ground}")
    assert "nothing moves the network: no node is driven or loaded" in str(found) and found.severity == "error"


def test_the_mass_of_a_held_node():
    (found,) = weak(f"it: {{{SPRING}, between: [a, b]}}", "{a: driven, b: {hold: ground, mass: 3 kg}}")
    assert "nothing depends on the mass of 'b', which is held still" in str(found) and found.severity == "warning"


@pytest.mark.parametrize(
    "branch",
    [
        "{element: damper, damping: 100}",
        "{element: quadratic_damper, damping: 100}",
        "{element: inerter, inertance: 3}",
        "{element: dahl, stiffness: 60 N/mm, limit: 15}",
        "{element: prandtl, stiffness: 60 N/mm, limit: 15}",
        "{element: coulomb, limit: 15, creep_velocity: 1e-3}",
        "{element: maxwell, stiffness: 60 N/mm, relaxation_time: 1}",
        "{element: spring, stiffness: 0}",
        "{element: stribeck, stiffness: 60 N/mm, limit: 9, breakaway: 15, stribeck_velocity: 1 mm/s}",
        "{element: hydro, fluid_mass: 50, stiffness: 200 N/mm, damping: 1600}",
    ],
)
def test_a_node_that_can_only_slide(branch):
    found = weak(
        f"""
        top: {branch.replace("}", ", between: [a, m]}")}
        bottom: {branch.replace("}", ", between: [m, b]}")}
    """,
        "{a: driven, m: {mass: 3 kg}, b: ground}",
        "gravity: 9.81\n",
    )
    (slides,) = [problem for problem in found if "can only slide" in problem.message]
    assert str(slides) == (
        "n.yaml:4:23: warning: the node 'm' can only slide: no chain of branches that hold a static force leads from "
        "it to a driven or held node, but gravity pulls at its mass. add a stiffness"
    )


@pytest.mark.parametrize(
    "branch",
    [
        SPRING,
        "element: spring, stiffness: {polynomial: [0, 1 N/mm^2]}",
        "element: contact, stiffness: 200 N/mm",
        "element: bedding_in, stiffness: 60 N/mm, depth: 5 mm",
        "element: hydro, fluid_mass: 50, stiffness: 200 N/mm, damping: 1600, compensation_stiffness: 20 N/mm",
        "element: spring, stiffness: {deflection: [0 mm, 5 mm, 10 mm], force: [0 N, 0 N, 900 N]}",
        "parallel: {x: {element: damper, damping: 5}, y: {element: spring, stiffness: 5}}",
    ],
)
def test_a_node_that_a_spring_holds_does_not_slide(branch):
    assert not weak(
        f"""
        top: {{element: damper, damping: 100, between: [a, m]}}
        bottom: {{{branch}, between: [m, b]}}
    """,
        "{a: driven, m: {mass: 3 kg}, b: ground}",
    )


def test_a_series_that_can_only_slide():
    (found,) = weak("leg: {series: {x: {element: damper, damping: 5}, y: {element: dahl, stiffness: 5, limit: 5}}}")
    assert "the node behind part 1 of the series 'leg' can only slide" in str(found)
    assert found.place.line == 4


def test_a_loaded_node_that_can_only_slide():
    (found,) = weak("it: {element: damper, damping: 5, between: [a, b]}", "{a: loaded, b: ground}")
    assert "can only slide" in str(found) and "but a load acts on it" in str(found)


def test_a_branch_on_which_nothing_depends():
    found = weak(
        f"""
        it: {{{SPRING}, between: [a, b]}}
        dead: {{element: damper, damping: {{start: 5}}, between: [b, c]}}
        end: {{{SPRING}, between: [b, d]}}
    """,
        "{a: driven, b: ground, c: ground, d: free}",
    )
    assert told(found) == [
        f"n.yaml:{line}: warning: nothing that can be measured depends on the branch '{name}'. connect it to a node "
        "that moves, or remove it"
        for line, name in (("6:9", "dead"), ("7:8", "end"))
    ]


@pytest.mark.parametrize(
    "before",
    ["{setting: moved, value: 0 m^2/s}", "{fixed: 0 m^2/s, over: {setting: moved, kept: {start: 0.5}}}"],
)
def test_a_number_that_acts_beside_what_a_run_gives_is_not_complained_of(before):
    """What it says of the runs before shows in no motion by itself; with nothing before it says nothing at all."""
    oil = "element: self_heating, damping: {start: 300}, power: 5, time: 20, share: {start: 0.5}"
    assert weak(f"it: {{{SPRING}}}\noil: {{{oil}, before: {before}}}") == []
    (found,) = weak(f"it: {{{SPRING}}}\noil: {{{oil}}}")
    assert "'oil.share' is free, but has no influence" in str(found)


def test_a_number_on_which_nothing_depends():
    (found,) = weak(
        f"""
        it: {{{SPRING}, between: [a, b]}}
        oil: {{element: damper, damping: 5, between: [a, b], offset: {{start: 3 mm}}}}
    """,
        "{a: driven, b: ground}",
    )
    assert str(found) == (
        "n.yaml:6:63: warning: 'oil.offset' is free, but has no influence on the measured signals. fix it at a "
        "value, or remove it"
    )


def confused(found: list[Problem]) -> list[list[str]]:
    """What cannot be distinguished, as lists of paths."""
    groups = [problem.message for problem in found if "cannot be distinguished" in problem.message]
    return [[word for word in message.split("'")[1::2]] for message in groups]


@pytest.mark.parametrize(
    ("branches", "paths"),
    [
        (
            "{a: {element: damper, damping: {start: 5}}, b: {element: damper, damping: {start: 9}}}",
            ["a.damping", "b.damping"],
        ),
        (
            "{a: {element: spring, stiffness: {start: 5}}, b: {parallel: {c: {element: "
            "spring, stiffness: {start: 9}}}}}",
            ["a.stiffness", "b.c.stiffness"],
        ),
        (
            "{a: {element: spring, stiffness: {from: quasi_static}}, b: {element: spring, stiffness: {start: 5 N/mm}}}",
            ["a.stiffness", "b.stiffness"],
        ),
        (
            "{a: {series: {b: {element: spring, stiffness: {start: 5}}, c: {element: spring, stiffness: {start: 9}}}}}",
            ["a.b.stiffness", "a.c.stiffness"],
        ),
        (
            "{a: {series: {b: {element: damper, damping: {start: 5}}, c: {element: damper, damping: {start: 9}}}}}",
            ["a.b.damping", "a.c.damping"],
        ),
        (
            "{s: {element: spring, stiffness: 1e5}, a: {element: damper, damping: {start: "
            "5 N*s/mm}, scale: {deflection: "
            "[0 mm, 5 mm], factor: [{start: 1.1}, {start: 0.9}]}}}",
            ["a.damping", "a.scale"],
        ),
        (
            "{m: {element: maxwell, stiffness: {start: 5 N/mm}, relaxation_time: {start: 1 s}}, s: {element: spring, "
            "stiffness: 0}, a: {series: {b: {element: spring, stiffness: {start: 8 "
            "N/mm}}, c: {element: damper, damping: "
            "{start: 9 N*s/mm}}}}, d: {series: {e: {element: spring, stiffness: {start: 9 N/mm}}, f: {element: spring, "
            "stiffness: 7 N/mm}, g: {element: spring, stiffness: {start: 9 N/mm}}}}}",
            ["d.e.stiffness", "d.g.stiffness"],
        ),
    ],
)
def test_numbers_that_cannot_be_told_apart(branches, paths):
    assert confused(weak(branches)) == [paths]


@given(sizes=st.tuples(*(st.floats(0.0, 3.0) for _ in range(3))), series=st.booleans())
@settings(max_examples=10, deadline=None)
def test_parts_of_one_kind_cannot_be_told_apart_whatever_their_numbers(sizes, series):
    first, second, third = (10.0**size for size in sizes)
    law = "element: damper, damping: {start: %r N*s/mm}"
    parts = f"{{b: {{{law % first}}}, c: {{{law % second}}}, d: {{element: spring, stiffness: {third!r} N/mm}}}}"
    assert confused(weak(f"{{a: {{{'series' if series else 'parallel'}: {parts}}}}}")) == [
        ["a.b.damping", "a.c.damping"]
    ]


def test_numbers_that_cannot_be_told_apart_are_told_at_the_last_of_them():
    (found,) = weak("""
        a: {element: damper, damping: {start: 5}}
        b: {element: damper, damping: {start: 9}}
    """)
    assert str(found) == (
        "n.yaml:5:33: warning: 'a.damping' and 'b.damping' cannot be distinguished: they compensate each other. "
        "fix one of them at a value, or remove a branch"
    )


def test_a_gain_of_the_load_cell_and_a_free_specimen():
    text = (
        "format: dashpot-network/1\nname: n\nbranches:\n  a: {element: spring, stiffness: {start: 5}}\n"
        "measurement: {force: {gain: {start: 1.0}}}\n"
    )
    assert confused(list(find_weaknesses(parse_network(text, ELEMENTS)))) == [["a.stiffness", "measurement.force.gain"]]


FREE = "{a: {element: spring, stiffness: {start: 80 N/mm}}, b: {element: damper, damping: {start: 300 N*s/m}}}"


def in_the_channel(branches: str, entry: str) -> list[Problem]:
    text = f"format: dashpot-network/1\nname: n\nbranches: {branches}\nmeasurement: {{force: {{{entry}}}}}\n"
    return list(find_weaknesses(parse_network(text, ELEMENTS)))


@pytest.mark.parametrize(
    "entry",
    [
        "lag: {start: 3 ms}",
        "largest: {start: 3 kN}",
        "least: {start: 0 N}",
        "offset: {start: 3 N}",
        "hum: {frequency: {start: 50 Hz}, cosine: {start: 1 N}, sine: {start: 0 N}}",
    ],
)
def test_a_channel_that_the_specimen_does_not_make_up_for(entry):
    assert told(in_the_channel(FREE, entry)) == []


def test_a_fixture_is_told_from_a_damped_specimen_but_not_from_a_spring():
    entry = "compliance: {start: 1e-6 m/N, bounds: [0 m/N, 1e-5 m/N]}"
    maxwell = "{a: {element: spring, stiffness: {start: 80 N/mm}}, b: {element: damper, damping: {start: 9 N*s/mm}}}"
    assert told(in_the_channel(maxwell, entry)) == []
    spring = "{a: {element: spring, stiffness: {start: 80 N/mm}}}"
    assert confused(in_the_channel(spring, entry)) == [["a.stiffness", "measurement.force.compliance"]]


@pytest.mark.parametrize(
    "branches",
    [
        "{a: {element: damper, damping: {start: 5}}, b: {element: damper, damping: 9}}",
        "{a: {element: damper, damping: {start: 5}}, b: {element: quadratic_damper, damping: {start: 9}}}",
        "{a: {element: damper, damping: {start: 5 N*s/mm}, scale: {deflection: [0 mm, 5 "
        "mm], factor: [{start: 1.1}, 1]}}}",
        "{a: {element: spring, stiffness: {start: 5}}, b: {element: dahl, stiffness: "
        "{start: 5 N/mm}, limit: {start: 9}}}",
        "{a: {series: {b: {element: spring, stiffness: {start: 8 N/mm}}, c: {element: damper, damping: {start: 9}}}}}",
        "{a: {element: spring, stiffness: {polynomial: [{start: 5 N/mm}, {start: 5 N/mm^2}, {start: 1 N/mm^3}]}}}",
        "{a: {repeat: 2, element: maxwell, stiffness: {start: 5 N/mm}, relaxation_time: {start: [1 s, 10 ms]}}}",
    ],
)
def test_numbers_that_can_be_told_apart(branches):
    assert told(weak(branches)) == []


def test_springs_in_series_are_told_apart_by_the_motion_between_them():
    branches = """
        a: {element: spring, stiffness: {start: 5 N/mm}, between: [a, m]}
        b: {element: spring, stiffness: {start: 5 N/mm}, between: [m, b]}
    """
    assert not weak(branches, "{a: driven, m: free, b: ground}")


def test_masses_are_told_apart_from_springs_and_not_from_each_other():
    branches = f"""
        a: {{{SPRING}, between: [a, m]}}
        b: {{element: spring, stiffness: {{start: 5 N/mm}}, between: [m, b]}}
    """
    assert not weak(branches, "{a: driven, m: {mass: {start: 30 kg}}, b: ground}")
    (found,) = weak(branches, "{a: driven, m: {mass: {start: 30 kg}, added_mass: {start: 3 kg}}, b: ground}")
    assert confused([found]) == [["m.added_mass", "m.mass"]]


def test_equal_branches_in_parallel_that_start_alike():
    (found,) = weak("""
        a: {element: maxwell, stiffness: {start: 5 N/mm}, relaxation_time: {start: 1 s}}
        b: {element: maxwell, stiffness: {start: 5 N/mm}, relaxation_time: {start: 1 s}}
    """)
    assert str(found) == (
        "n.yaml:5:6: warning: 'a' and 'b' are alike and in parallel: no gradient-based search can distinguish "
        "them. give them different starts"
    )


class Mass(Element):
    """Inertia between two ends: what it stores depends on the velocity, so a factor over deflection pumps."""

    word = "mass_between"
    mass = Parameter("kg", "mass")

    def step(self, x, z, p, dt):
        return Response(p.mass * x.acceleration)


FALLING = "scale: {deflection: [-5 mm, 5 mm], factor: [3, 0.3]}"


def test_a_factor_that_makes_a_law_give_work():
    text = f"format: dashpot-network/1\nname: n\nbranches:\n  it: {{element: mass_between, mass: 3, {FALLING}}}\n"
    (found,) = find_weaknesses(parse_network(text, {"mass_between": Mass}, "n.yaml"))
    assert str(found) == (
        "n.yaml:4:47: warning: with its factor over deflection the branch 'it' can generate energy. "
        "use the factor on a law that dissipates at every instant"
    )
    even = text.replace("[3, 0.3]", "[2, 2]")
    assert not find_weaknesses(parse_network(even, {"mass_between": Mass}))


@pytest.mark.parametrize(
    "element",
    [
        "damper, damping: 100",
        "quadratic_damper, damping: 100",
        "maxwell, stiffness: 9 N/mm, relaxation_time: 50 ms",
        "dahl, stiffness: 60 N/mm, limit: 15 N",
        "prandtl, stiffness: 60 N/mm, limit: 15 N",
        "spring, stiffness: 60 N/mm",
        "coulomb, limit: 15 N, creep_velocity: 1 mm/s",
    ],
)
def test_a_factor_on_a_law_that_loses_work_at_every_instant(element):
    for factors in ("[3, 0.3]", "[0.3, 3]"):
        assert not weak(f"it: {{element: {element}, {FALLING.replace('[3, 0.3]', factors)}}}")


def test_a_rigid_stop_is_depended_on_however_little_its_force_matters():
    stop = "stop: {element: rigid_stop, compression: 2 mm, rebound: -2 mm, between: [b, c]}"
    spring = "it: {element: spring, stiffness: 3 N/mm, between: [a, b]}"
    assert not weak(f"{spring}\n{stop}", "{a: driven, b: {mass: 1 kg}, c: ground}")

"""Networks are compared by structure: names and order do not count, laws, forms and what is to be found do."""

from __future__ import annotations

from textwrap import dedent

import pytest

from dashpot import load_registry
from dashpot.model.likeness import Likeness, compare_structures
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import parse_network, read_network
from dashpot.model.shipped import shipped_networks

ELEMENTS = load_registry().elements
NODES = "nodes: {a: driven, b: ground, m: {mass: {start: 30 kg}}}"
LAW = {
    "s": "element: spring, stiffness: 200 N/mm",
    "d": "element: damper, damping: 90",
    "r": "element: dahl, stiffness: 60 N/mm, limit: 15 N",
}


def net(branches: str, head: str = "", name: str = "n") -> NetworkSpec:
    for word, law in LAW.items():
        branches = branches.replace(f"<{word}>", law)
    text = f"format: dashpot-network/1\nname: {name}\n" + (f"{head}\n" if head else "")
    return parse_network(text + f"branches: {dedent(branches)}\n", ELEMENTS)


def against(first: str, second: str, head: str = "", other: str | None = None) -> Likeness:
    return compare_structures(net(first, head, "one"), net(second, head if other is None else other, "two"))


@pytest.mark.parametrize("name", shipped_networks())
def test_every_shipped_network_is_like_itself_and_not_like_the_next(name):
    spec = read_network(name, ELEMENTS)
    likeness = compare_structures(spec, read_network(name, ELEMENTS))
    assert likeness.same_structure and not likeness.numbers
    names = list(shipped_networks())
    other = names[names.index(name) - 1]
    assert not compare_structures(spec, read_network(other, ELEMENTS)).same_structure


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("{x: {<s>}, y: {<d>}}", "{oil: {<d>}, rubber: {<s>}}"),
        ("{x: {<s>}, y: {<d>}}", "{both: {parallel: {oil: {<d>}, rubber: {<s>}}}}"),
        ("{x: {series: {p: {<s>}, q: {<d>}}}}", "{x: {series: {p: {<d>}, q: {<s>}}}}"),
        (
            "{x: {series: {p: {<s>}, q: {<d>}, r: {<r>}}}}",
            "{x: {series: {p: {series: {u: {<r>}, v: {<s>}}}, q: {<d>}}}}",
        ),
        (
            "{x: {series: {p: {<d>}, q: {parallel: {u: {<s>}, v: {<d>}}}}}}",
            "{x: {series: {p: {parallel: {u: {<d>}, v: {<s>}}}, q: {<d>}}}}",
        ),
        (
            "{x: {element: dahl, stiffness: 60 N/mm, limit: 15 N}}",
            "{x: {element: dahl, stiffness: 60 N/mm, limit: 15 N, exponent: 1}}",
        ),
    ],
)
def test_names_and_order_do_not_count(first, second):
    likeness = against(first, second)
    assert likeness == Likeness((), ())


def test_nodes_may_have_other_names_and_a_linear_law_may_lie_the_other_way_round():
    first = net("{x: {<s>, between: [a, m]}, y: {<d>, between: [m, b]}}", NODES)
    second = net(
        "{p: {<d>, between: [body, wheel]}, q: {<s>, between: [road, wheel]}}",
        "nodes: {wheel: {mass: {start: 30 kg}}, body: ground, road: driven}",
    )
    assert compare_structures(first, second) == Likeness((), ())


def test_a_massless_node_is_the_same_whether_it_is_named_or_not():
    first = net("{x: {series: {p: {<s>}, q: {<d>}}, between: [a, b]}}", "nodes: {a: driven, b: ground}")
    second = net("{p: {<s>, between: [a, m]}, q: {<d>, between: [m, b]}}", "nodes: {a: driven, b: ground, m: free}")
    assert compare_structures(first, second) == Likeness((), ())


def test_two_ends_are_the_same_whether_they_are_named_or_not():
    assert against("{x: {<s>}}", "{x: {<s>, between: [p, q]}}", "", "nodes: {p: driven, q: ground}") == Likeness((), ())


@pytest.mark.parametrize(
    ("first", "second", "told"),
    [
        ("{x: {<s>}}", "{x: {<s>}, y: {<r>}}", "'two' has one dahl more between the driven end and ground"),
        ("{x: {<s>}, y: {<r>}, z: {<r>}}", "{x: {<s>}}", "'one' has two dahl more between the driven end and ground"),
        (
            "{x: {<s>}}",
            "{x: {element: spring, stiffness: {start: 5}}}",
            "between the driven end and ground: spring (nothing free) in 'one', spring (stiffness free) in 'two'",
        ),
        (
            "{x: {<s>}}",
            "{x: {element: spring, stiffness: {polynomial: [5, 6]}}}",
            "between the driven end and ground: "
            "spring (nothing free) in 'one', spring (stiffness as a polynomial of degree 2; nothing free) in "
            "'two'",
        ),
        (
            "{x: {<d>}}",
            "{x: {<d>, scale: {deflection: [0 mm, 1 mm], factor: [1, 2]}}}",
            "between the driven end and "
            "ground: damper (nothing free) in 'one', damper (scale as a table of 2; nothing free) in 'two'",
        ),
    ],
)
def test_what_one_has_more_or_otherwise_is_told(first, second, told):
    assert against(first, second).structure == (told,)


def test_a_series_is_told_as_one_part():
    assert against(
        "{x: {<s>}}", "{x: {<s>}, y: {series: {p: {<d>}, q: {parallel: {u: {<s>}, v: {<d>}}}}}}"
    ).structure == (
        "'two' has one series of damper and (spring parallel to damper) more between the driven end and ground",
    )


def test_where_a_branch_lies_counts():
    springs = "x: {<s>, between: [a, m]}, y: {<s>, between: [m, b]}"
    likeness = against(
        f"{{{springs}, z: {{<r>, between: [m, b]}}}}", f"{{{springs}, z: {{<r>, between: [a, m]}}}}", NODES
    )
    assert likeness.structure == ("'two' has one dahl more between a and m", "'one' has one dahl more between b and m")


def test_a_two_sided_characteristic_may_not_be_turned_round():
    table = "element: damper, damping: {velocity: [-1 m/s, 0 m/s, 1 m/s], force: [-9 N, 0 N, 5 N]}"
    likeness = against(
        f"{{x: {{{table}, between: [a, b]}}, y: {{<s>, between: [a, m]}}, z: {{<s>, between: [m, b]}}}}",
        f"{{x: {{{table}, between: [b, a]}}, y: {{<s>, between: [a, m]}}, z: {{<s>, between: [m, b]}}}}",
        NODES,
    )
    (found,) = likeness.structure
    assert found == (
        "between a and b: damper (damping as a table of 3; nothing free) in 'one', damper (damping "
        "as a table of 3; nothing free; reversed) in 'two'"
    )


@pytest.mark.parametrize(
    ("other", "told"),
    [
        (
            "nodes: {a: driven, b: ground, m: {mass: 30 kg}}",
            "the node m is free with mass free in 'one', m is free with mass in 'two'",
        ),
        (
            "nodes: {a: loaded, b: ground, m: {mass: {start: 30 kg}}}",
            "the node a is driven in 'one', a is loaded in 'two'",
        ),
        (
            "nodes: {a: driven, b: ground, m: {mass: {start: 30 kg}}, c: ground}",
            "'two' has one node more, c, which is ground",
        ),
    ],
)
def test_what_is_different_about_a_node_is_told(other, told):
    branches = "{x: {<s>, between: [a, m]}, y: {<d>, between: [m, b]}}"
    assert against(branches, branches, NODES, other).structure == (told,)


def test_numbers_that_a_twin_shares_are_not_numbers_of_its_own():
    model = "x: {element: spring, stiffness: {start: 5}, between: [a, m]}"
    own = model.replace("x:", "y:").replace("[a, m]", "[m, b]")
    (found,) = against(f"{{{model}, y: {{same_as: x, between: [m, b]}}}}", f"{{{model}, {own}}}", NODES).structure
    assert found == (
        "between b and m: spring (stiffness free, as those of another branch) in 'one', spring "
        "(stiffness free) in 'two'"
    )


def test_of_one_structure_the_numbers_are_compared():
    head = "gravity: 9.81\nnodes: {a: driven, b: ground, m: {mass: {start: 30 kg}}}"
    other = "gravity: 9.80\nnodes: {a: driven, b: ground, n: {mass: {start: 33 kg}}}"
    likeness = against(
        "{x: {<s>, between: [a, m], offset: 3 mm}, y: {<r>, between: [m, b]}, z: {<s>, between: [m, b]}}",
        "{z: {<s>, between: [n, b]}, x: {<s>, between: [a, n], offset: 4 mm}, "
        "q: {element: dahl, stiffness: 60 N/mm, limit: 16 N, exponent: 2, between: [n, b]}}",
        head,
        other,
    )
    assert likeness.structure == ()
    assert likeness.numbers == (
        "x.offset: 3 mm in 'one', 4 mm in 'two'",
        "y.limit: 15 N in 'one', 16 N in 'two' (q.limit)",
        "y.exponent: 1 in 'one', 2 in 'two' (q.exponent)",
        "m.mass: 30 kg in 'one', 33 kg in 'two' (n.mass)",
        "gravity: 9.81 m/s^2 in 'one', 9.8 m/s^2 in 'two'",
    )


def test_tables_are_compared_knot_by_knot():
    table = "{x: {element: spring, stiffness: {deflection: [0 mm, %s], force: [0 N, %s]}}}"
    assert against(table % ("5 mm", "9 N"), table % ("6 mm", "8 N")).numbers == (
        "x.stiffness[1]: 9 N in 'one', 8 N in 'two'",
        "x.stiffness, knot 2: 5 mm in 'one', 6 mm in 'two'",
    )


def test_what_the_load_cell_does_is_compared():
    spec = (
        "format: dashpot-network/1\nname: n\nbranches: {x: {element: spring, stiffness: 5}}\n"
        "measurement: {force: {%s}}\n"
    )
    first, second, third = (parse_network(spec % cell, ELEMENTS) for cell in ("gain: 1.1", "gain: 1.2", "delay: 1 ms"))
    assert compare_structures(first, second).numbers == ("measurement.force.gain: 1.1 in the first, 1.2 in the second",)
    assert compare_structures(first, third).structure == (
        "measurement: force.gain in the first, force.delay in the second",
    )


def test_many_nodes_are_paired_exactly():
    def chain(names: list[str], first: int = 0) -> NetworkSpec:
        masses = ", ".join(f"{name}: {{mass: 3 kg}}" for name in names[1:-1])
        branches = ", ".join(
            f"x{k}: {{<{'sd'[(k + first) % 3 > 0]}>, between: [{low}, {high}]}}"
            for k, (low, high) in enumerate(zip(names, names[1:], strict=False))
        )
        return net(f"{{{branches}}}", f"nodes: {{{names[0]}: driven, {masses}, {names[-1]}: ground}}")

    names = [f"n{k}" for k in range(12)]
    assert not compare_structures(chain(names), chain(names, 1)).same_structure
    assert compare_structures(chain(names), chain([f"p{7 * k % 12}" for k in range(12)])) == Likeness((), ())

"""What leaves the inner loop."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.kernel.networks import network

from dashpot.expr.interpret import interpret
from dashpot.expr.node import Node, symbol, symbols_of, walk
from dashpot.kernel.compiler.tiers import Program, sort_tiers
from dashpot.kernel.compiler.trace import TracedBranch, trace_network

MAXWELL = "it: {element: maxwell, stiffness: 5, relaxation_time: 5}"
DAHL = "it: {element: dahl, stiffness: 5, limit: 5}"


def program(branches: str) -> Program:
    return sort_tiers(trace_network(network(branches)))


def inner(program: Program) -> list[Node]:
    """What the loop over lanes computes."""
    hoisted = {node.serial for node in (*program.columns, *program.constants)}
    found, stack = {}, program.roots
    while stack:
        node = stack.pop()
        if node.serial not in found and node.serial not in hoisted and node.arguments:
            found[node.serial] = node
            stack += node.arguments
    return list(found.values())


def test_what_depends_on_the_drive_alone_is_a_column():
    for node in program(f"{MAXWELL}\nother: {{element: damper, damping: 5}}").columns:
        assert all(name.startswith(("path.", "still.")) or name == "dt" for name in symbols_of(node))


def test_what_depends_on_a_lane_alone_is_a_constant():
    found = program(MAXWELL)
    for node in found.constants:
        assert symbols_of(node) <= {"dt", "it.stiffness", "it.relaxation_time"}


def test_a_maxwell_element_is_a_product_and_three_additions_in_the_loop():
    operations = sorted(node.operation for node in inner(program(MAXWELL)))
    assert set(operations) <= {"add", "multiply"}
    assert len(operations) <= 8


def test_a_dahl_element_divides_nothing_in_the_loop_and_takes_one_exponential():
    operations = [node.operation for node in inner(program(DAHL))]
    assert operations.count("exp") == 1
    assert "divide" not in operations and "where" not in operations and "absolute" not in operations


def test_branches_of_one_law_keep_their_own_numbers_and_states():
    found = program("it: {repeat: 3, element: dahl, stiffness: 5, limit: 5}")
    assert found.states == ("it_1|force", "it_2|force", "it_3|force")
    assert found.turning == found.states
    assert len(found.constants) == 3 * len(program(DAHL).constants)
    assert len(found.columns) == len(program(DAHL).columns)


def test_only_rate_independent_branches_move_at_turning_points():
    assert program(f"{MAXWELL}\nother: {DAHL.partition(': ')[2]}").turning == ("other|force",)


def test_a_table_is_looked_up_once_for_all_lanes():
    found = program("""
        a: {element: spring, stiffness: {deflection: [0, 1], force: [0, 5]}}
        b: {element: damper, damping: 5, scale: {deflection: [0, 1], factor: [2, 1]}}
    """)
    assert [look.curve for look in found.lookups] == ["a.stiffness", "b.scale"]
    assert all(symbols_of(look.argument) == {"still.new"} for look in found.lookups)


def test_regrouping_does_not_change_the_value():
    x, z, p, q = symbol("still.new"), symbol("it|s"), symbol("it.p"), symbol("it.q")
    force = -(p * x / q) * (z / p) + (x - z) - (p - x * 3.0) / (q * x) * 2.0 + np.exp(-p * x / q) * z * 0.5 / x
    found = sort_tiers((TracedBranch("it", "still", force, {"it|s": z * p - x / q * z + force}),))
    rng = np.random.default_rng(seed_of("test_tiers"))
    values = {name: rng.uniform(0.5, 2.0, 50) for name in ("still.new", "it|s", "it.p", "it.q")}
    before = interpret([force, z * p - x / q * z + force], values)
    after = interpret([found.force, found.updates["it|s"]], values)
    assert np.array(after) == pytest.approx(np.array(before), rel=1e-13)


def test_what_is_used_twice_is_computed_once():
    found = program(DAHL)
    assert found.force is found.updates["it|force"]
    assert len([node for node in walk(found.roots) if node.operation == "exp"]) == 1


def test_a_law_without_numbers_is_a_column():
    x = symbol("still.new")
    found = sort_tiers((TracedBranch("it", "still", 3.0 * x, {}),))
    assert found.columns == (found.force,) and not found.constants

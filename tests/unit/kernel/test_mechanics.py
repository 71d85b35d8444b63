"""The equations written for a network: what is balanced, which motion an edge sees, what is known."""

from __future__ import annotations

import pytest
from unit.kernel.networks import ELEMENTS

from dashpot.expr.interpret import interpret
from dashpot.expr.node import symbols_of
from dashpot.kernel.compiler.equations import Equations, write_equations
from dashpot.kernel.compiler.mechanics import DISTANCE, force_row, reached_row, row_of
from dashpot.model.reading import parse_network
from dashpot.model.topology import topology_of

HANGER = """
gravity: 9.81 m/s^2
nodes: {table: driven, block: {mass: 3 kg, added_mass: 1 kg}, wall: ground}
branches:
  foot: {element: spring, stiffness: 50 N/m, between: [table, block], offset: 20 mm}
  top: {element: damper, damping: 7 N*s/m, between: [block, wall]}
"""
NUMBERS = {
    "foot.stiffness": 50.0,
    "foot.offset": 0.02,
    "top.damping": 7.0,
    "block.mass": 3.0,
    "block.added_mass": 1.0,
    "gravity": 9.81,
    "dt": 0.1,
    "rule.slope": 20.0,
    "rule.now": -20.0,
    "rule.before": 0.0,
    "rule.swing": -1.0,
    "rule.pull": 20.0,
    "rule.adams": 0.0,
    "rule.renewed": 1.0,
    "newton.tolerance": 1e-9,
    "newton.farthest": 10.0,
    "newton|done": 0.0,
    "newton|damping": 1.0,
    "newton|distance": 1e300,
    "newton|nothing": 0.0,
}


KEPT = {reached_row(force_row("table")): 123.0}


def equations(text: str = HANGER) -> Equations:
    return write_equations(
        topology_of(parse_network(f"format: dashpot-network/1\nname: n\n{text}", ELEMENTS, "n.yaml"))
    )


def value(rows, name: str, **more: float) -> float:
    """The new value of a row."""
    known = NUMBERS | {f"node:{joint}": number for joint, number in MOVING.items()} | more
    return float(interpret([rows[name]], known)[0])


MOVING = {
    "table.old": 0.0,
    "table.new": 0.01,
    "table.velocity_old": 0.0,
    "table.velocity_new": 0.2,
    "table.acceleration": 0.0,
    "block|position": 0.001,
    "block|velocity": 0.03,
    "block|acceleration": 0.4,
    "block|position_before": 0.0005,
    "block|velocity_before": 0.01,
    "block|next": 0.004,
    "block|drift": 0.05,
    "block|swing": 0.6,
    "block|acceleration_before": 0.3,
    "block|acceleration_earlier": 0.1,
}


def test_the_platform_feels_the_spring_and_its_offset_where_newtons_step_leads_to():
    rows = equations().passes["improve"]
    step = value(rows, row_of("block", "next"), **KEPT) - 0.004
    # 50 N/m (0.01 m - 0.004 m - step + 0.02 m)
    assert value(rows, reached_row(force_row("table")), **KEPT) == pytest.approx(50.0 * (0.026 - step))


def test_a_finished_lane_keeps_what_it_reached():
    passes, finished = equations().passes, {"newton|done": 1.0}
    assert value(passes["improve"], reached_row(force_row("table")), **KEPT, **finished) == 123.0
    assert value(passes["commit"], force_row("table"), **KEPT) == 123.0


def test_newtons_step_solves_a_linear_balance_at_once():
    velocity, slope = 20.0 * 0.004 + 0.05, 20.0
    acceleration = slope * velocity + 0.6
    # m (a + g) = k (z_P - z + offset) - d v, all linear in z
    missing = 50.0 * 0.026 - 7.0 * velocity - 4.0 * (acceleration + 9.81)
    step = missing / (50.0 + 7.0 * slope + 4.0 * slope**2)
    rows = equations().passes["improve"]
    assert value(rows, row_of("block", "next")) == pytest.approx(0.004 + step)
    assert value(rows, DISTANCE) == pytest.approx(abs(step))


def test_a_step_is_no_longer_than_the_farthest():
    rows = equations().passes["improve"]
    near = value(rows, row_of("block", "next"), **{"newton.farthest": 1e-4})
    assert abs(near - 0.004) == pytest.approx(1e-4)


def test_a_finished_lane_stays():
    assert value(equations().passes["improve"], row_of("block", "next"), **{"newton|done": 1.0}) == 0.004


def test_a_step_that_was_kept_short_and_came_nearer_does_not_count_as_stalled():
    rows, far = equations().passes["improve"], {"newton.farthest": 1e-4}
    distance = value(rows, DISTANCE)
    grown = value(rows, "newton|damping", **far, **{"newton|distance": distance + 1e-4, "newton|damping": 0.5})
    stalled = value(rows, "newton|damping", **far, **{"newton|distance": distance, "newton|damping": 0.5})
    assert (grown, stalled) == (1.0, 0.25)


def test_the_prediction_goes_on_with_velocity_and_acceleration():
    rows = equations().passes["predict"]
    assert value(rows, row_of("block", "next")) == pytest.approx(0.001 + 0.1 * (0.03 + 0.05 * 0.4))
    assert value(rows, row_of("block", "drift")) == pytest.approx(-20.0 * 0.001 - 1.0 * 0.03)
    assert value(rows, row_of("block", "swing")) == pytest.approx(-20.0 * 0.03 - 1.0 * 0.4)


def test_at_rest_only_springs_and_weights_count():
    rows = equations().passes["settle"]
    step = (50.0 * 0.026 - 4.0 * 9.81) / 50.0
    assert value(rows, row_of("block", "next")) == pytest.approx(0.004 + step)
    others = {"top.damping": 1e9, "rule.slope": 7.0, "dt": 3.0}
    assert value(rows, row_of("block", "next"), **others) == pytest.approx(0.004 + step)


def test_nodes_inside_a_series_are_unknown_and_have_no_mass():
    rows = equations("""
branches:
  leg: {series: {a: {element: spring, stiffness: 50 N/m}, b: {element: damper, damping: 7 N*s/m}}}
""").passes["improve"]
    assert row_of("leg:1", "next") in rows
    assert not any("mass" in name for name in symbols_of(rows[row_of("leg:1", "next")]))


def test_what_drives_the_steps_is_known():
    found = equations("""
nodes: {table: driven, block: {hold: loaded, mass: 2 kg}}
branches:
  k: {element: spring, stiffness: 50 N/m, between: [table, block]}
""").known
    assert {"node:block.load", "node:table.new", "rule.slope", "newton.tolerance"} <= found
    assert "node:block.new" not in found

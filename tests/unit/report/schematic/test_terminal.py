"""The schematic in characters."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from unit.report.schematic.networks import TEXTS, jointed, two_ended

from dashpot import load_registry
from dashpot.model.reading import parse_network, read_network
from dashpot.model.shipped import shipped_networks
from dashpot.report.schematic.drawing import drawing_of
from dashpot.report.schematic.sizes import TERMINAL, columns
from dashpot.report.schematic.terminal import COLUMNS, text_drawing

RANDOM = settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
VOIGT = """
format: dashpot-network/1
name: voigt
branches:
  spring: {element: spring, stiffness: 220 N/mm}
  damper: {element: damper, damping: {start: 100 N*s/m}}
"""
DRAWN = """\
voigt
≈ start of a parameter to be identified


                     spring  k = 220 N/mm
             ┠──────────────╱╲╱╲╱──────────────┨
driven end ↔ ┃      damper  d ≈ 0.1 N·s/mm     ┃[F]▒ ground
             ┠───────────────╢ ╟───────────────┨
"""


@pytest.fixture(scope="module")
def elements():
    return load_registry().elements


WIDE = {"axle_model_3_top_mount": 125}  # four nodes one behind the other, each with a label


def network(name, elements):
    return parse_network(TEXTS[name], elements) if name in TEXTS else read_network(name, elements)


def last_part(branch):
    return branch.name.rpartition(".")[2]


def test_springs_and_dashpots_lie_between_two_rails(elements):
    assert text_drawing(parse_network(VOIGT, elements)) == DRAWN


@pytest.mark.parametrize("name", [*dict.fromkeys([*TEXTS, *shipped_networks()])])
def test_a_drawing_names_everything_in_a_hundred_columns(name, elements):
    spec = network(name, elements)
    text = text_drawing(spec)
    assert all(last_part(branch) in text for branch in spec.leaves())
    assert all(joint in text for joint in spec.joints)
    assert max(columns(line) for line in text.splitlines()) <= WIDE.get(name, 100)


@pytest.mark.parametrize("name", [*TEXTS, "tire_model_5", "ubs"])
def test_ascii_is_enough(name, elements):
    spec = network(name, elements)
    plain = text_drawing(spec, ascii_only=True)
    assert plain.isascii()
    assert all(last_part(branch) in plain for branch in spec.leaves())


def test_formulas_are_spelt_out_in_ascii(elements):
    plain = text_drawing(network("axle", elements), ascii_only=True)
    assert "sigma = 100 N/mm" in plain and "F_c ~ 80 N" in plain and "g = 9.81 m/s^2" in plain


@RANDOM
@given(two_ended())
def test_any_tree_keeps_its_labels(spec):
    assert_labels_are_whole(spec)


@RANDOM
@given(jointed())
def test_any_network_with_nodes_keeps_its_labels(spec):
    assert_labels_are_whole(spec)


def assert_labels_are_whole(spec):
    # whatever overlapped would have been overwritten
    text = text_drawing(spec)
    assert all(last_part(branch) in text for branch in spec.leaves())
    assert all(joint in text for joint in spec.joints)
    boxes = sum(branch.element.word == "box" for branch in spec.leaves())
    assert text.count("[box]") == boxes


# the wall of an even number of lines is what decides where the drawing begins
WALL = """
format: dashpot-network/1
name: wall
nodes: {table: driven, bracket: ground}
branches:
  spring: {between: [table, bracket], element: spring, stiffness: 220 N/mm}
  damper: {between: [table, bracket], element: damper, damping: {start: 100 N*s/m}}
"""


def test_a_wall_of_an_even_height_leaves_the_rows_whole(elements):
    drawing = drawing_of(parse_network(WALL, elements), [TERMINAL], COLUMNS)
    edges = [edge for shape in drawing.shapes for edge in (shape.box.top, shape.box.bottom)]
    assert edges == [round(edge) for edge in edges]

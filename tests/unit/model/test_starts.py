"""Starts that were computed begin where elements admit them."""

from __future__ import annotations

import pytest

from dashpot import load_registry
from dashpot.model.reading import parse_network
from dashpot.model.starts import starts_within_bounds
from dashpot.text.document import Document

ELEMENTS = load_registry().elements
TEXT = """\
format: dashpot-network/1
name: made
branches:
  soft: {element: maxwell, stiffness: {start: 1.68701e-5 N/m}, relaxation_time: {start: 2 ms}}
  own:
    element: coulomb
    limit: {start: 3 kN, bounds: [1 N, 2 kN]}
    creep_velocity: 1 mm/s
  group:
    series:
      below: {element: spring, stiffness: {start: -2 N/mm}}
      above: {element: springpot, stiffness: {start: 1 N/mm}, order: {start: 1.5}}
"""


def test_what_is_outside_begins_at_the_nearer_end_and_the_rest_stays():
    text = starts_within_bounds(Document.parse(TEXT), ELEMENTS)
    found = {slot.path: slot.value.number for slot in parse_network(text, ELEMENTS).slots()}
    declared = {word: ELEMENTS[word].declares for word in ("maxwell", "spring", "springpot")}
    assert found["soft.stiffness"] == declared["maxwell"].parameters["stiffness"].bounds[0]
    assert found["soft.relaxation_time"] == 2e-3
    assert found["own.limit"] == 2e3
    assert found["group.below.stiffness"] == declared["spring"].curves["stiffness"].bounds[0]
    assert found["group.above.order"] == declared["springpot"].parameters["order"].bounds[1]
    assert starts_within_bounds(Document.parse(text), ELEMENTS) == text


@pytest.mark.parametrize(
    ("there", "other"), [("{start: 3 kN, bounds: [1 N, 2 kN]}", "{start: many}"), ("coulomb", "nothing")]
)
def test_what_cannot_be_read_is_left_to_the_reader(there, other):
    text = TEXT.replace(there, other)
    assert other in starts_within_bounds(Document.parse(text), ELEMENTS)

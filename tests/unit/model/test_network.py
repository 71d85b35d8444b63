"""A network as data: its slots, and copies with other numbers."""

from __future__ import annotations

from dataclasses import replace

import pytest
from unit.model.specimens import network, numbers

SPEC = """
    rubber: {element: elastic, stiffness: {polynomial: [180 N/mm, {start: 1 N/mm^2}]}}
    leg:
      parallel:
        oil:
          element: viscous
          damping: {start: 3}
          scale: {deflection: [5 mm, 20 mm], factor: [1.4, 1.0]}
    friction: {element: slider, stiffness: 6e4, limit: {start: 15 N}}
"""


def test_the_slots_come_branch_by_branch_in_the_order_of_the_declaration():
    assert [slot.path for slot in network(SPEC).slots()] == [
        "rubber.stiffness[0]",
        "rubber.stiffness[1]",
        "leg.oil.damping",
        "leg.oil.scale[0]",
        "leg.oil.scale[1]",
        "friction.stiffness",
        "friction.limit",
    ]


def test_other_values_take_their_places_and_leave_the_rest():
    spec = network(SPEC)
    values = {slot.path: slot.value for slot in spec.slots()}
    new = {
        "leg.oil.scale[1]": replace(values["leg.oil.scale[1]"], number=0.7),
        "rubber.stiffness[0]": replace(values["rubber.stiffness[0]"], number=1.0),
    }
    changed = spec.with_values(new)
    assert numbers(changed) == numbers(spec) | {"leg.oil.scale[1]": 0.7, "rubber.stiffness[0]": 1.0}
    assert changed.with_values({path: values[path] for path in new}) == spec
    assert numbers(spec)["leg.oil.scale[1]"] == 1.0


def test_a_path_that_is_not_there_is_refused():
    spec = network(SPEC)
    with pytest.raises(KeyError, match="'bench' has no slot friction.limits"):
        spec.with_values({"friction.limits": spec.slots()[0].value})
    with pytest.raises(KeyError, match="'bench' has no curve friction.stiffness"):
        spec.with_curve("friction.stiffness", spec.curves()["rubber.stiffness"])


def test_another_curve_takes_its_place():
    spec = network(SPEC)
    curves = spec.curves()
    assert list(curves) == ["rubber.stiffness", "leg.oil.damping", "leg.oil.scale"]
    straight = replace(curves["rubber.stiffness"], form="constant", values=curves["rubber.stiffness"].values[:1])
    assert numbers(spec.with_curve("rubber.stiffness", straight))["rubber.stiffness"] == 180e3
    other = replace(curves["leg.oil.scale"], at=(0.0, 1.0))
    assert spec.with_curve("leg.oil.scale", other).curves()["leg.oil.scale"].at == (0.0, 1.0)


def test_a_value_is_searched_unless_it_is_fixed():
    value = network(SPEC).slots()[0].value
    assert [value.as_role(role).searched for role in ("fixed", "free", "identified")] == [False, True, True]

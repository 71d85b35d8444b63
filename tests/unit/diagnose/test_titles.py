"""What is told of a dependence: of which branch, and on which setting."""

from types import SimpleNamespace

import pytest

from dashpot import load_registry
from dashpot.diagnose.named import about_of, dependence
from dashpot.model.reading import parse_network

TEXT = """\
format: dashpot-network/1
name: rack
branches:
  friction: {element: dahl, limit: {value: 130 N, over: {setting: yoke, at: 1 kN, slope: 0.1 N/N}}, stiffness: 700 N/mm}
  dry_friction: {element: ideal_coulomb, limit: {value: 9 N, over: {setting: yoke, at: [1 kN, 2 kN], factor: [1, 2]}}}
  damping: {element: damper, damping: {value: 100 N*s/m, over: {channel: current, at: 1 A, slope: 9 N*s/m/A}}}
  setting_stiffness: {element: signed_spring, stiffness: {fixed: 0 N/m, over: {setting: room_heat, at: 0, slope: 5}}}
"""
NETWORK = parse_network(TEXT, load_registry().elements)
FRICTION, DRY = "friction.limit.slope", "dry_friction.limit.factor[1]"


@pytest.mark.parametrize(
    ("paths", "told"),
    [
        ([FRICTION], "dependence of friction on yoke"),
        ([FRICTION, DRY, "dry_friction.limit.factor[0]"], "dependence of friction and dry friction on yoke"),
        ([DRY, "damping.damping.slope"], "dependence of dry friction on yoke and damping on current"),
        (
            ["setting_stiffness.stiffness", "setting_stiffness.stiffness.slope"],
            "dependence of stiffness on room heat",
        ),
        (["friction.limit"], ""),
    ],
)
def test_a_dependence_is_called_by_the_branch_and_the_setting(paths, told):
    assert dependence(NETWORK, paths) == told


@pytest.mark.parametrize(("changes", "told"), [(True, "dependence of friction on yoke"), (False, "some cause")])
def test_other_causes_keep_their_names(changes, told):
    """Also one that brings a number over a setting."""
    name = ("word", "")
    term = SimpleNamespace(name=name, cause=SimpleNamespace(changes_numbers=changes), about="some cause")
    model = SimpleNamespace(terms=(term,), causes=(term,), owned=((FRICTION,),))
    assert about_of(model, name, NETWORK) == told

"""Where an element could be added to a network with nodes, and what its text is then."""

import pytest

from dashpot.contract.registry import load_registry
from dashpot.model.reading import parse_network, read_network
from dashpot.model.sites import At, Site, rig_site, sites_of
from dashpot.text.problem import InputError

ELEMENTS = load_registry().elements
TEXT = """\
format: dashpot-network/1
name: pair
nodes: {left: driven, right: driven, one: {mass: 3 kg}, two: {same_as: one}, wall: ground}   # five
branches:
  pad: {between: [left, one], offset: 20 mm, element: spring, stiffness: 2 N/mm}
  pad_b: {same_as: pad, between: [right, two]}
  spring: {between: [one, wall], element: spring, stiffness: 1 N/mm}
  twin: {same_as: spring, between: [two, wall]}
  link:                                  # from side to side
    between: [two, one]
    series:
      bar: {element: spring, stiffness: 1 N/mm}
      bush: {element: spring, stiffness: 9 N/mm}
  loss: {between: [wall, one], element: damper, damping: 4 N*s/m}
"""
EXTENDED = (
    TEXT
    + """\
  slider:
    element: dahl
    limit: {start: 5 N}
    stiffness: 3 N/mm
    between: [left, one]
    offset: 20 mm
  slider_b: {same_as: slider, between: [right, two]}
"""
)
SLIDER = "  slider:\n    element: dahl\n    limit: {start: 5 N}\n    stiffness: 3 N/mm\n"


def sites(text=TEXT):
    return sites_of(parse_network(text, ELEMENTS))


def test_every_pair_of_nodes_is_a_site_once_together_with_its_twins():
    assert [site.words for site in sites()] == [
        "between left and one, likewise right and two",
        "between one and wall, likewise two and wall",
        "between two and one",
    ]


def test_a_site_knows_its_members_and_offset():
    pad, spring, _ = sites()
    assert (pad.offset, spring.offset) == (20e-3, 0.0)
    assert [member.name for member in spring.members] == ["spring", "loss"]


def test_a_network_with_two_ends_has_no_sites():
    assert sites_of(read_network("tire_model_5", ELEMENTS)) == ()


def test_the_shipped_axle_has_tire_suspension_and_anti_roll_bar():
    assert [site.pairs[0] for site in sites_of(read_network("axle_model_3", ELEMENTS))] == [
        ("platform_left", "wheel_left"),
        ("wheel_left", "body"),
        ("wheel_left", "wheel_right"),
    ]


def test_what_is_added_is_connected_at_all_twins_and_the_rest_of_the_text_stays():
    extended = At(sites()[0], lambda text, atoms: text + SLIDER)(TEXT, [])
    assert extended == EXTENDED
    spec = parse_network(extended, ELEMENTS)
    paths = [slot.path for slot in spec.slots()]
    assert "slider.limit" in paths and "slider_b.limit" not in paths
    assert spec.ends["slider_b"].offset.number == 20e-3


def test_a_second_one_finds_names_of_its_own():
    at = At(sites()[0], lambda text, atoms: text + SLIDER.replace("slider", atoms))
    again = at(at(TEXT, "slider"), "other")
    taken = at(at(TEXT.replace("twin", "slider_b"), "slider"), "other")
    assert parse_network(again, ELEMENTS).ends["other_b"].lower == "right"
    assert parse_network(taken, ELEMENTS).ends["slider_b_2"].lower == "right"


def test_a_change_that_adds_no_branch_is_left_as_it_is():
    assert At(None, lambda text, atoms: text + "about: more\n")(TEXT, []) == TEXT + "about: more\n"


def test_the_rig_reaches_from_the_driven_nodes_to_one_that_is_held():
    assert rig_site(parse_network(TEXT, ELEMENTS)) == Site((("left", "wall"), ("right", "wall")), ("_right",))


def test_where_nothing_is_held_the_rig_has_no_site_and_a_branch_there_is_refused():
    spec = read_network("quarter_car", ELEMENTS)
    assert rig_site(spec) is None
    with pytest.raises(InputError, match="'slider' would lie between a driven node and ground"):
        At(None, lambda text, atoms: text + SLIDER)(TEXT, [])

"""The schematic as SVG: nothing overlaps, everything is there once, and the wires connect what the network connects."""

from __future__ import annotations

import re

import pytest
from hypothesis import HealthCheck, given, settings
from unit.report.schematic.drawn import Drawn
from unit.report.schematic.networks import KINDS, LOADED, TEXTS, jointed, two_ended
from unit.report.schematic.rules import ends_of_network, misdrawn, outside, overlaps

from dashpot import load_registry
from dashpot.model.network import Branch, Group, NetworkSpec
from dashpot.model.reading import parse_network, read_network
from dashpot.model.shipped import shipped_networks
from dashpot.report.schematic.svg import svg

RANDOM = settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))


@pytest.fixture(scope="module")
def elements():
    return load_registry().elements


def network(name, elements):
    return parse_network(TEXTS[name], elements) if name in TEXTS else read_network(name, elements)


def judge(spec):
    drawn = Drawn(svg(spec))
    assert not overlaps(drawn)
    assert not outside(drawn)
    assert not misdrawn(spec, drawn)
    assert set(drawn.rails) >= ends_of_network(spec)
    return drawn


@pytest.mark.parametrize("name", [*dict.fromkeys([*TEXTS, *shipped_networks()])])
def test_the_picture_of_a_network_is_right(name, elements):
    judge(network(name, elements))


@RANDOM
@given(two_ended())
def test_the_picture_of_any_tree_is_right(spec):
    judge(spec)


@RANDOM
@given(jointed())
def test_the_picture_of_any_network_with_nodes_is_right(spec):
    judge(spec)


@pytest.mark.parametrize("name", [*TEXTS, "tire_model_5"])
def test_every_number_stands_once_in_its_label(name, elements):
    from dashpot.text.quantity import pretty

    spec = network(name, elements)
    drawn = Drawn(svg(spec))
    for slot in spec.slots():
        owner = re.sub(r"\[\d+\]$", "", slot.path).rpartition(".")[0]
        shown = pretty(slot.value.number, slot.value.unit).replace("*", "·").replace("^2", "²")
        texts = [line for label in drawn.words(owner) for line in label]
        if owner.startswith("measurement"):
            texts = [line for group in drawn.of("title") for line in re.split(", |: |\n", "".join(group.itertext()))]
        ending = [line for line in texts if re.search(rf"[=≈] {re.escape(shown)}$", line)]
        likes = [
            other
            for other in spec.slots()
            if other.value.number == slot.value.number
            and re.sub(r"\[\d+\]$", "", other.path).rpartition(".")[0] == owner
        ]
        assert len(ending) == len(likes), (slot.path, texts)


def test_a_start_is_told_from_a_number(elements):
    drawn = Drawn(svg(network("axle", elements)))
    assert "Fc ≈ 80 N" in drawn.words("rub")[0]
    assert "σ = 100 N/mm" in drawn.words("rub")[0]
    assert drawn.words("wheel_left")[0] == ["wheel_left", "m ≈ 40 kg", "m+ = 5 kg"]
    assert drawn.words("rub_right")[0] == ["rub_right", "as rub"]


def test_a_large_group_has_a_figure_of_its_own_which_its_twin_shares(elements):
    drawn = Drawn(svg(network("axle", elements)))
    assert drawn.words("tire.carcass") == drawn.words("tire_right.carcass")
    assert drawn.words("tire.carcass")[0][0] == "carcass"
    titles = ["".join(group.itertext()).strip() for group in drawn.of("title")]
    assert "tire, tire_right" in titles


def test_the_wheels_of_an_axle_stand_side_by_side(elements):
    drawn = Drawn(svg(network("axle", elements)))
    left, right = ([box for box in drawn.rails[name] if box.what == "body"] for name in ("wheel_left", "wheel_right"))
    (left,), (right,) = left, right
    assert left.right < right.left
    assert (left.top + left.bottom) / 2 == pytest.approx((right.top + right.bottom) / 2, abs=0.2)
    assert drawn.rails["body"][0].bottom < left.top < drawn.rails["platform_left"][0].top
    [bar] = [sign for sign in drawn.signs if sign.branches == ("bar.twist",)]
    assert not bar.upright and left.right < bar.rectangle.left < bar.rectangle.right < right.left


def test_each_way_of_holding_a_node_has_its_mark(elements):
    marks = {
        (box.attrib["data-node"], box.attrib["class"]) for box in Drawn(svg(network("axle", elements))).of("support")
    }
    assert ("platform_left", "support driven") in marks and ("body", "support ground") in marks
    marks = [
        (group.attrib["data-node"], group.attrib["class"])
        for group in Drawn(svg(parse_network(LOADED, elements))).of("support")
    ]
    assert sorted(marks) == [("floor", "support ground"), ("floor", "support ground"), ("seat", "support loaded")]


def test_a_mirrored_connection_keeps_the_order_of_its_parts(elements):
    text = """
format: dashpot-network/1
name: mirrored
nodes: {base: driven, top: ground}
branches:
  leg: {between: [top, base], series: {a: {element: spring, stiffness: 1 N/mm}, b: {element: damper, damping: 1 N*s/m}}}
"""
    judge(parse_network(text, elements))


def test_joints_get_dots_where_a_wire_has_to_cross_a_node(elements):
    # five nodes, each connected with each other: this graph cannot be drawn without a crossing
    nodes = ["driven", "free", "free", "free", "ground"]
    pairs = [(low, high) for high in range(5) for low in range(high)]
    text = "format: dashpot-network/1\nname: five\nnodes: {" + ", ".join(f"n{k}: {h}" for k, h in enumerate(nodes))
    text += "}\nbranches:\n" + "".join(
        f"  b{low}{high}: {{between: [n{low}, n{high}], element: spring, stiffness: 1 N/mm}}\n" for low, high in pairs
    )
    crossing = judge(parse_network(text, elements))
    assert [mark for mark in crossing.root if mark.attrib.get("class") == "joint"]
    plain = judge(network("quarter_car", elements))
    assert not [mark for mark in plain.root if mark.attrib.get("class") == "joint"]


def test_names_cannot_break_out_of_the_picture():
    hostile = "</text><script>alert(1)</script>&\"'"
    branch = Branch(hostile, KINDS[0], {}, {})
    text = svg(NetworkSpec(hostile, Group("", "parallel", (branch,)), about=hostile))
    drawn = Drawn(text)
    assert "<script" not in text
    assert drawn.words(hostile.split()[0]) is not None


def test_the_picture_brings_everything_with_it(elements):
    text = svg(network("axle", elements))
    assert "href" not in text and "url(" not in text and "@import" not in text
    assert "prefers-color-scheme: dark" in text
    assert text == svg(network("axle", elements))

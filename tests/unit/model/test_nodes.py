"""Networks with nodes: what their text becomes, who shares numbers with whom, and how they are edited."""

from __future__ import annotations

from dataclasses import replace
from textwrap import dedent

import pytest
from unit.model.specimens import ELEMENTS, numbers, written

from dashpot.model.network import NetworkSpec, Value
from dashpot.model.patch import add_branch, fill_numbers
from dashpot.model.reading import parse_network, read_network
from dashpot.model.topology import topology_of
from dashpot.text.problem import InputError

HEAD = "format: dashpot-network/1\nname: axle\n"
QUARTER = """
gravity: 9.81 m/s^2
nodes:
  platform: driven
  platform_right: driven
  wheel:
    about: of the left side
    mass: {start: 40 kg, bounds: [20 kg, 80 kg]}   # weighed: 47 kg
    added_mass: {setting: added_mass, value: 0 kg}
  wheel_right: {same_as: wheel}
  body: ground
branches:
  tire: {element: elastic, stiffness: {start: 200 N/mm}, between: [platform, wheel], offset: {start: 20 mm}}
  tire_right: {same_as: tire, between: [platform_right, wheel_right]}
  strut:
    between: [wheel, body]
    series:
      damper: {element: viscous, damping: {start: 1500}}
      mount: {parallel: {rubber: {element: elastic, stiffness: 350 N/mm}, loss: {element: viscous, damping: 50}}}
  strut_right: {same_as: strut, between: [wheel_right, body], about: the same part once more}
"""


def axle(text: str = QUARTER) -> NetworkSpec:
    return parse_network(HEAD + text.lstrip("\n"), ELEMENTS, "n.yaml")


def small(nodes: str, branches: str) -> NetworkSpec:
    return axle(f"nodes: {nodes}\nbranches:\n  " + dedent(branches).strip("\n").replace("\n", "\n  ") + "\n")


def problems(nodes: str, branches: str = "it: {element: elastic, stiffness: 5, between: [a, b]}") -> list[str]:
    with pytest.raises(InputError) as caught:
        small(nodes, branches)
    return str(caught.value).splitlines()


def test_nodes_are_held_driven_loaded_or_free():
    spec = small(
        "{a: driven, b: ground, c: loaded, d: free, e: {mass: 3 kg}, f: {hold: loaded, mass: 2 kg}}",
        "it: {element: elastic, stiffness: 5, between: [a, b]}",
    )
    assert {name: joint.hold for name, joint in spec.joints.items()} == {
        "a": "driven",
        "b": "ground",
        "c": "loaded",
        "d": "free",
        "e": "free",
        "f": "loaded",
    }
    assert spec.joints["f"].masses["mass"].number == 2.0 and not spec.joints["d"].masses


def test_gravity_and_masses_are_read_with_their_units():
    spec = axle(QUARTER.replace("9.81 m/s^2", "981 cm/s^2"))
    assert spec.gravity == pytest.approx(9.81)
    mass, added = spec.joints["wheel"].masses.values()
    assert (mass.number, mass.bounds, mass.searched) == (40.0, (20.0, 80.0), True)
    assert (added.number, added.setting, added.searched) == (0.0, "added_mass", False)
    assert small("{a: driven, b: ground}", "it: {element: elastic, stiffness: 5, between: [a, b]}").gravity == 0.0


def test_any_number_may_be_given_by_a_setting_of_the_run():
    stiffness = "{setting: pressure_rate, value: 3 N/mm}"
    spec = small("{a: driven, b: ground}", f"it: {{element: elastic, stiffness: {stiffness}, between: [a, b]}}")
    (slot,) = spec.slots()
    assert (slot.path, slot.value.setting, slot.value.number) == ("it.stiffness", "pressure_rate", 3e3)


def test_every_number_has_one_path_and_twins_have_none():
    assert numbers(axle()) == {
        "tire.stiffness": 200e3,
        "strut.damper.damping": 1500.0,
        "strut.mount.rubber.stiffness": 350e3,
        "strut.mount.loss.damping": 50.0,
        "tire.offset": 0.02,
        "wheel.mass": 40.0,
        "wheel.added_mass": 0.0,
    }
    assert list(axle().curves()) == [
        "tire.stiffness",
        "strut.damper.damping",
        "strut.mount.rubber.stiffness",
        "strut.mount.loss.damping",
    ]


def test_the_graph_has_a_node_between_the_parts_of_a_series():
    topology = topology_of(axle())
    assert topology.unknown == ("wheel", "wheel_right", "strut:1", "strut_right:1")
    assert [(edge.branch.name, edge.lower, edge.upper, edge.offset) for edge in topology.edges] == [
        ("tire", "platform", "wheel", "tire.offset"),
        ("tire_right", "platform_right", "wheel_right", "tire.offset"),
        ("strut.damper", "wheel", "strut:1", ""),
        ("strut.mount.rubber", "strut:1", "body", ""),
        ("strut.mount.loss", "strut:1", "body", ""),
        ("strut_right.damper", "wheel_right", "strut_right:1", ""),
        ("strut_right.mount.rubber", "strut_right:1", "body", ""),
        ("strut_right.mount.loss", "strut_right:1", "body", ""),
    ]


def test_an_offset_belongs_to_all_that_lies_in_parallel_and_once_to_what_lies_in_series():
    spec = small(
        "{a: driven, b: ground}",
        """
        both:
          between: [a, b]
          offset: 3 mm
          parallel: {x: {element: elastic, stiffness: 5}, y: {element: viscous, damping: 5}}
        chain:
          between: [a, b]
          offset: 4 mm
          series: {x: {element: elastic, stiffness: 5}, y: {element: viscous, damping: 5}}
    """,
    )
    assert [edge.offset for edge in topology_of(spec).edges] == ["both.offset", "both.offset", "chain.offset", ""]


def test_a_change_of_a_number_reaches_the_twin():
    spec = axle()
    known = {slot.path: slot.value for slot in spec.slots()}
    changed = spec.with_values({path: replace(known[path], number=known[path].number * 1.5) for path in known})
    branches = {branch.name: branch for branch in changed.leaves()}
    assert branches["tire_right"].curves["stiffness"].values[0].number == 300e3
    assert branches["strut_right.mount.loss"].curves["damping"].values[0].number == 75.0
    assert changed.joints["wheel_right"].masses["mass"].number == 60.0
    assert changed.ends["tire_right"].offset.number == pytest.approx(0.03)


def test_a_change_of_a_curve_reaches_the_twin():
    spec = axle()
    straight = replace(spec.curves()["strut.damper.damping"], values=(Value(7.0, "N*s/m"),))
    changed = spec.with_curve("strut.damper.damping", straight)
    found = [branch.curves["damping"].values[0].number for branch in changed.leaves() if "damper" in branch.name]
    assert found == [7.0, 7.0]


def test_a_twin_may_have_an_offset_of_its_own_and_a_twin_of_a_twin_shares_with_the_first():
    spec = small(
        "{a: driven, b: ground, c: driven}",
        """
        one: {element: elastic, stiffness: 5, between: [a, b], offset: 3 mm}
        two: {same_as: one, between: [c, b], offset: 4 mm}
        three: {same_as: two, between: [c, a]}
    """,
    )
    assert numbers(spec) == {"one.stiffness": 5.0, "one.offset": 0.003, "two.offset": 0.004}
    assert [edge.offset for edge in topology_of(spec).edges] == ["one.offset", "two.offset", "two.offset"]
    assert {branch.numbers for branch in spec.leaves()} == {"one"}


def test_the_copies_of_a_branch_lie_between_the_same_nodes_and_share_their_offset():
    spec = small(
        "{a: driven, b: ground}", "it: {repeat: 2, element: elastic, stiffness: [5, 6], between: [a, b], offset: 3 mm}"
    )
    assert numbers(spec) == {"it_1.stiffness": 5.0, "it_2.stiffness": 6.0, "it_1.offset": 0.003}
    assert [(edge.lower, edge.upper, edge.offset) for edge in topology_of(spec).edges] == [
        ("a", "b", "it_1.offset")
    ] * 2


def test_a_twin_inside_a_group_shares_too():
    spec = small(
        "{a: driven, b: ground}",
        """
        leg:
          between: [a, b]
          parallel: {x: {element: elastic, stiffness: {start: 5}}, y: {same_as: x}}
    """,
    )
    assert numbers(spec) == {"leg.x.stiffness": 5.0}
    assert [(branch.name, branch.shares) for branch in spec.leaves()] == [("leg.x", ""), ("leg.y", "leg.x")]


def test_a_node_that_is_the_same_as_another_is_held_in_the_same_way():
    spec = small(
        "{a: {hold: loaded, mass: 3 kg}, b: ground, c: {same_as: a}, d: {same_as: a, hold: free}}",
        "it: {element: elastic, stiffness: 5, between: [a, b]}",
    )
    assert [spec.joints[name].hold for name in "acd"] == ["loaded", "loaded", "free"]
    assert [spec.joints[name].numbers for name in "acd"] == ["a", "a", "a"]


def test_a_network_of_two_ends_is_a_graph_of_one_driven_and_one_held_node():
    topology = topology_of(parse_network(written("it: {element: elastic, stiffness: 5}"), ELEMENTS))
    assert topology.parallel and topology.unknown == ()
    assert [(edge.lower, edge.upper) for edge in topology.edges] == [("", "ground")]
    assert not topology_of(axle()).parallel


@pytest.mark.parametrize(
    ("nodes", "told"),
    [
        (
            "{a: drivn, b: ground}",
            "n.yaml:3:12: the node 'a': expected driven, loaded, ground, free or '{mass: ...}', got "
            "'drivn'. did you mean 'driven'?",
        ),
        ("{a: driven, b: {mas: 3 kg}}", "n.yaml:3:24: the node 'b' has no key 'mas'. did you mean 'mass'?"),
        ("{a: driven, b: {mass: 3 N}}", "n.yaml:3:30: b.mass: expected a quantity in kg, got 'N'"),
        ("{a: driven, b: {mass: -3 kg}}", "n.yaml:3:30: b.mass: expected 1e-09 to 1e+09 kg, got -3"),
        (
            "{a: driven, b: {mass: {setting: m, value: -3 kg}}}",
            "n.yaml:3:50: b.mass: expected 1e-09 to 1e+09 kg, got -3",
        ),
        ("{a: driven, b: {mass: {setting: m}}}", "n.yaml:3:30: b.mass lacks 'value'. add a line 'value: ...'"),
        (
            "{a: driven, b: {hold: grund}}",
            "n.yaml:3:30: the node 'b', 'hold': expected one of driven, loaded, ground, "
            "free, got 'grund'; did you mean 'ground'?",
        ),
        ("{b: {same_as: a}, a: driven}", "n.yaml:3:22: the node 'b', 'same_as': there is no node 'a' above"),
        (
            "{a: {mass: 3 kg}, b: {same_as: a, mass: 4 kg}}",
            "n.yaml:3:39: the node 'b' has masses of its own and those of 'a'. remove one of them",
        ),
        (
            "{a: driven, b: ground, 'c:1': free}",
            "n.yaml:3:38: expected a name of letters, digits, '_', '-' and '+', got 'c:1'. rename the node",
        ),
        ("{a: driven, b: [1]}", "n.yaml:3:23: expected the node 'b' as 'key: value' lines, got a list of 1"),
    ],
)
def test_a_wrong_node_is_told_once_with_its_place(nodes, told):
    (found,) = problems(nodes)
    assert found.startswith(told)


@pytest.mark.parametrize("nodes", ["[a, b]", "{}", "driven"])
def test_nodes_that_are_no_named_nodes_are_told(nodes):
    assert problems(nodes)[0].startswith(
        "n.yaml:3:8: the network, 'nodes': expected named nodes 'name: driven' or 'name: {mass: 40 kg}', got"
    )


@pytest.mark.parametrize(
    ("branch", "told"),
    [
        ("element: elastic, stiffness: 5", "n.yaml:5:7: 'it' of branches lacks 'between'. add a line 'between: ...'"),
        (
            "element: elastic, stiffness: 5, between: [a]",
            "n.yaml:5:49: 'it' of branches, 'between': expected two different nodes, the lower one first, got [a]",
        ),
        (
            "element: elastic, stiffness: 5, between: [a, a]",
            "expected two different nodes, the lower one first, got [a, a]",
        ),
        ("element: elastic, stiffness: 5, between: a", "'it' of branches, 'between': expected a list [..., ...], got"),
        (
            "element: elastic, stiffness: 5, between: [a, plattform]",
            "there is no node 'plattform'; did you mean 'platform'?",
        ),
        ("element: elastic, stiffness: 5, between: [a, q]", "there is no node 'q'; known nodes: a, platform"),
        (
            "element: elastic, stiffness: 5, between: [a, platform], offset: 3 N",
            "n.yaml:5:72: it.offset: expected a quantity in m, got 'N'",
        ),
        (
            "element: elastic, stiffness: 5, between: [a, platform], offset: 30",
            "it.offset: expected -10 to 10 m, got 30",
        ),
        (
            "between: [a, platform], same_as: other",
            "n.yaml:5:41: 'it' of branches, 'same_as': there is no branch 'other' above",
        ),
        (
            "between: [a, platform], parallel: {x: {element: elastic, stiffness: 5, between: [a, platform]}}",
            "n.yaml:5:79: 'x' of parallel has no key 'between'",
        ),
        (
            "element: elastic, stiffness: {from: quasi_static}, between: [a, platform]",
            "n.yaml:5:37: 'it.stiffness' cannot "
            "come from quasi_static data in a network with nodes: the loop of the whole "
            "is not the curve of a part. write a "
            "table; or fit the part by itself, on runs of its own, and write 'use: fitted.yaml, fixed: true'",
        ),
        (
            "element: elastic, stiffness: {from: quasi_static, deflection: [0, 1], force: "
            "[0, 1]}, between: [a, platform]",
            "'it.stiffness' cannot come from quasi_static data in a network with nodes",
        ),
    ],
)
def test_a_wrong_branch_is_told_once_with_its_place(branch, told):
    (found,) = problems("{a: driven, platform: ground}", f"it: {{{branch}}}")
    assert told in found and found.startswith("n.yaml:5:")


@pytest.mark.parametrize(
    ("branches", "told"),
    [
        (
            "{x: {element: elastic, stiffness: 5, between: [a, b]}, y: {same_as: x, stiffness: 5, between: [a, b]}}",
            "n.yaml:5:74: 'y' of branches has no key 'stiffness'",
        ),
        (
            "{x: {element: elastic, stiffness: 5, between: [a, b]}, y.z: {same_as: x, between: [a, b]}}",
            "expected a name of letters, digits",
        ),
        (
            "{x: {element: elastic, stiffness: 5, between: [a, b]}, x_1: {same_as: x, between: [a, b]}, "
            "x_2: {same_as: x2, between: [a, b]}}",
            "there is no branch 'x2' above; did you mean 'x'?",
        ),
        (
            "{x: {element: elastic, stiffness: 5, between: [a, b], offset: &o {start: 1 mm}}, "
            "y: {element: elastic, stiffness: 5, between: [a, b], offset: *o}}",
            "'y.offset' is an alias of 'x.offset', a parameter to be identified. write it out",
        ),
    ],
)
def test_twins_that_do_not_go_together_are_told(branches, told):
    (found,) = problems("{a: driven, b: ground}", branches)
    assert told in found


def test_a_mass_behind_an_alias_is_told_unless_it_is_fixed():
    it = "it: {element: elastic, stiffness: 5, between: [a, b]}"
    (found,) = problems("{a: driven, b: {mass: &m {start: 3 kg}}, c: {mass: *m}}", it)
    assert "'c.mass' is an alias of 'b.mass', a parameter to be identified" in found
    spec = small("{a: driven, b: {mass: &m 3 kg}, c: {mass: *m}, d: ground}", it)
    assert numbers(spec) == {"it.stiffness": 5.0, "b.mass": 3.0, "c.mass": 3.0}


def test_a_branch_and_a_node_may_share_a_name_but_no_number():
    spec = small("{a: driven, it: {mass: 3 kg}}", "it: {element: elastic, stiffness: 5, between: [a, it]}")
    assert numbers(spec) == {"it.stiffness": 5.0, "it.mass": 3.0}


def test_nodes_and_gravity_go_together():
    it = "it: {element: elastic, stiffness: 5"
    with pytest.raises(InputError) as caught:
        parse_network(f"{HEAD}gravity: 9.81\nbranches:\n  {it}, between: [a, b], offset: 3 mm}}\n", ELEMENTS, "n.yaml")
    assert str(caught.value).splitlines() == [
        "n.yaml:3:10: gravity pulls at the masses of nodes, but the network has no nodes. remove it",
        "n.yaml:5:49: 'it' has 'between', but the network has no nodes. name them at the top: 'nodes: {platform: "
        "driven, body: ground}'",
        "n.yaml:5:65: 'it' has 'offset', but the network has no nodes. name them at the top: 'nodes: {platform: "
        "driven, body: ground}'",
    ]


def test_a_curve_inside_a_series_cannot_come_from_data():
    with pytest.raises(InputError, match="4:.*'it.x.stiffness' cannot come from quasi_static data inside a series"):
        parse_network(
            written(
                "it: {series: {x: {element: elastic, stiffness: {from: quasi_static}}, "
                "y: {element: viscous, damping: 5}}}"
            ),
            ELEMENTS,
            "n.yaml",
        )


TIRE = """
    core:
      element: elastic            # from the slow loop
      stiffness: {from: quasi_static, deflection: [0 mm, 10 mm], force: [0 N, 2 kN]}
    oil: {element: viscous, damping: {value: 90, interval: [80, 100]}}
    twin: {same_as: oil}
"""
USER = """
nodes: {platform: driven, wheel: {mass: {start: 40 kg}}, body: ground}
branches:
  tire: {use: tire.yaml, between: [platform, wheel], offset: 20 mm%s}
  right: {same_as: tire, between: [wheel, body]}
"""


def test_a_fitted_network_is_used_with_its_numbers_fixed(tmp_path):
    (tmp_path / "tire.yaml").write_text(written(TIRE))
    (tmp_path / "n.yaml").write_text(HEAD + USER.lstrip("\n") % ", fixed: true")
    spec = read_network(tmp_path / "n.yaml", ELEMENTS)
    assert [slot.path for slot in spec.slots() if slot.value.searched] == ["wheel.mass"]
    assert spec.curves()["tire.core.stiffness"].form == "table" and not spec.data_curves()
    assert [(branch.name, branch.shares) for branch in spec.leaves()][2:] == [
        ("tire.twin", "tire.oil"),
        ("right.core", "tire.core"),
        ("right.oil", "tire.oil"),
        ("right.twin", "tire.oil"),
    ]
    mass = replace(spec.joints["wheel"].masses["mass"], number=47.5, interval=(47.0, 48.0))
    text = fill_numbers(spec, spec.with_values({"wheel.mass": mass}), {"seed": "1"})
    assert "use: tire.yaml" in text and "mass: {value: 47.5 kg, interval: [47 kg, 48 kg]}" in text
    assert numbers(parse_network(text, ELEMENTS, str(tmp_path / "n.yaml")))["wheel.mass"] == 47.5


def test_a_network_with_curves_from_data_has_to_be_fitted_before_it_is_used_in_an_axle(tmp_path):
    (tmp_path / "tire.yaml").write_text(written("core: {element: elastic, stiffness: {from: quasi_static}}"))
    for fixed, told in (
        (", fixed: true", "has no knots yet. fit this network first and use the file that the fit"),
        ("", "cannot come from quasi_static data in a network with nodes"),
    ):
        (tmp_path / "n.yaml").write_text(HEAD + USER.lstrip("\n") % fixed)
        with pytest.raises(InputError, match=told) as caught:
            read_network(tmp_path / "n.yaml", ELEMENTS)
        assert f"{tmp_path / 'tire.yaml'}:4:" in str(caught.value)


def test_a_used_network_is_not_fixed_by_halves(tmp_path):
    (tmp_path / "tire.yaml").write_text(written("core: {element: elastic, stiffness: 5}"))
    (tmp_path / "n.yaml").write_text(HEAD + USER.lstrip("\n") % ", fixed: false")
    with pytest.raises(InputError, match="expected 'true': without the key its parameters are searched"):
        read_network(tmp_path / "n.yaml", ELEMENTS)


def test_a_network_with_nodes_cannot_be_used(tmp_path):
    (tmp_path / "tire.yaml").write_text(HEAD + QUARTER.lstrip("\n"))
    (tmp_path / "n.yaml").write_text(HEAD + USER.lstrip("\n") % "")
    with pytest.raises(InputError, match="a network that is used has two ends, expected no 'nodes'"):
        read_network(tmp_path / "n.yaml", ELEMENTS)


def moved(spec: NetworkSpec) -> NetworkSpec:
    """The network with larger numbers in all searched places, known within a fifth."""
    found = {slot.path: slot.value for slot in spec.slots() if slot.value.searched}
    return spec.with_values(
        {
            path: replace(value, number=1.25 * value.number, interval=(value.number, 1.5 * value.number))
            for path, value in found.items()
        }
    )


def test_masses_and_offsets_are_filled_in_and_everything_else_stays():
    spec = axle()
    text = fill_numbers(spec, moved(spec), {})
    found = axle(text.removeprefix(HEAD))
    assert numbers(found) == pytest.approx(numbers(moved(spec)), rel=1e-7)
    assert found.joints["wheel"].masses["mass"].interval == (40.0, 60.0)
    assert "mass: {value: 50 kg, interval: [40 kg, 60 kg], bounds: [20 kg, 80 kg]}   # weighed: 47 kg" in text
    assert "offset: {value: 25 mm, interval:" in text and "{setting: added_mass, value: 0 kg}" in text
    changed = [old for old, new in zip(spec.text.splitlines(), text.splitlines(), strict=False) if old != new]
    assert [line.split(":")[0].strip() for line in changed] == ["mass", "tire", "damper"]


def test_a_used_network_between_nodes_is_written_out_where_its_numbers_are_searched(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "stop.yaml").write_text(written("bump: {element: elastic, stiffness: {value: 7}}"))
    (tmp_path / "parts" / "tire.yaml").write_text(
        written("""
        core: {element: elastic, stiffness: {start: 5}}
        twin: {same_as: core}
        stop: {use: stop.yaml, fixed: true}
    """)
    )
    user = (
        USER.replace("tire.yaml", "parts/tire.yaml") % ""
        + "  last: {use: parts/stop.yaml, fixed: true, between: [wheel, body]}\n"
    )
    (tmp_path / "n.yaml").write_text(HEAD + user.lstrip("\n"))
    spec = read_network(tmp_path / "n.yaml", ELEMENTS)
    text = fill_numbers(spec, moved(spec), {})
    found = parse_network(text, ELEMENTS, str(tmp_path / "n.yaml"))
    assert numbers(found) == pytest.approx(numbers(moved(spec)), rel=1e-7)
    assert text.count("use: parts/stop.yaml") == 2 and "parts/tire.yaml" not in text
    assert [branch.name for branch in found.leaves()] == [branch.name for branch in spec.leaves()]
    assert found.ends == moved(spec).ends


def test_a_branch_between_nodes_is_added():
    text = add_branch(
        HEAD + QUARTER.lstrip("\n"), "rub: {element: slider, stiffness: 5, limit: 5, between: [wheel, body]}"
    )
    assert topology_of(parse_network(text, ELEMENTS)).edges[-1].branch.name == "rub"

"""What a text of a network becomes."""

from __future__ import annotations

import json
import re

import pytest
from unit.model.specimens import ELEMENTS, HEAD, Elastic, network, numbers, written

from dashpot import load_registry
from dashpot.model.reading import parse_network, read_network
from dashpot.model.shipped import shipped_networks
from dashpot.text.problem import InputError


def problems(branches: str) -> list[str]:
    with pytest.raises(InputError) as caught:
        network(branches)
    return str(caught.value).splitlines()


def test_a_network_is_read_branch_by_branch():
    spec = parse_network(
        'format: dashpot-network/1\nname: bench\nabout: "What it is."\nsource: a book\nbranches:\n'
        "  rubber: {element: elastic, stiffness: 220 N/mm}\n"
        "  friction: {element: slider, stiffness: 6e4, limit: 15 N}\n",
        ELEMENTS,
    )
    assert (spec.name, spec.about, spec.source) == ("bench", "What it is.", "a book")
    assert [(branch.name, branch.element.word) for branch in spec.leaves()] == [
        ("rubber", "elastic"),
        ("friction", "slider"),
    ]
    assert numbers(spec) == {"rubber.stiffness": 220e3, "friction.stiffness": 6e4, "friction.limit": 15.0}


def test_the_name_of_a_network_can_be_that_of_a_file():
    for name in ("../../evil", "a\u202eb", "x" * 121, "€" * 120):
        with pytest.raises(InputError, match="the network, 'name': .* cannot be a name: leave out"):
            network = f"format: dashpot-network/1\nname: {json.dumps(name)}\nbranches:\n  k: {{element: elastic}}\n"
            parse_network(network, ELEMENTS)
    long = f"{'x' * 121}: {{element: elastic, stiffness: 1}}"
    assert any("expected a name of letters" in told for told in problems(long))


def test_a_network_that_doubles_with_every_file_is_refused_at_once(tmp_path):
    # 21 files, each of which uses the next one twice: two to the power of twenty branches
    elastic = "it: {element: elastic, stiffness: 1}"
    (tmp_path / "n20.yaml").write_text(written(elastic))
    for level in range(20):
        following = f"{{use: n{level + 1}.yaml}}"
        (tmp_path / f"n{level}.yaml").write_text(written(f"a: {following}\nb: {following}"))
    with pytest.raises(InputError, match="expected 1000 branches at most, with those of used networks, got more"):
        read_network(tmp_path / "n0.yaml", ELEMENTS)
    assert len(read_network(tmp_path / "n12.yaml", ELEMENTS).leaves()) == 256


def test_a_mistake_in_a_file_that_is_used_often_is_told_once(tmp_path):
    (tmp_path / "n12.yaml").write_text(written("it: {element: elastic, stifness: 1}"))
    for level in range(12):
        following = f"{{use: n{level + 1}.yaml}}"
        (tmp_path / f"n{level}.yaml").write_text(written(f"a: {following}\nb: {following}"))
    with pytest.raises(InputError) as caught:
        read_network(tmp_path / "n0.yaml", ELEMENTS)
    assert len([problem for problem in caught.value.problems if "stifness" in problem.message]) == 1
    assert len(caught.value.problems) < 40


def test_copies_count_as_branches():
    entry = "{{element: elastic, stiffness: 1, repeat: 100}}"
    many = "\n".join(f"a{number}: {entry}".replace("{{", "{").replace("}}", "}") for number in range(11))
    assert any("expected 1000 branches at most" in told for told in problems(many))


def test_every_shipped_network_is_read_under_its_name():
    elements = load_registry().elements
    assert len(shipped_networks()) >= 9
    for name in shipped_networks():
        spec = read_network(name, elements)
        assert spec.name == name
        assert spec.source and spec.about


def test_a_parameter_that_is_not_mentioned_keeps_its_default():
    assert "it.exponent" not in numbers(network("it: {element: slider, stiffness: 6e4, limit: 15}"))
    assert numbers(network("it: {element: slider, stiffness: 6e4, limit: 15, exponent: 2}"))["it.exponent"] == 2.0


def test_a_number_may_be_fixed_free_or_identified():
    spec = network("""
        fixed: {element: slider, stiffness: 1 N/mm, limit: {start: 15 N, bounds: [1 N, 1 kN], scale: linear}}
        known: {element: slider, stiffness: {value: 2 N/mm, interval: [1.9 N/mm, 2.1 N/mm]}, limit: {start: 3}}
    """)
    values = {slot.path: slot.value for slot in spec.slots()}
    assert (values["fixed.stiffness"].role, values["fixed.stiffness"].searched) == ("fixed", False)
    free = values["fixed.limit"]
    assert (free.role, free.number, free.bounds, free.scale) == ("free", 15.0, (1.0, 1000.0), "linear")
    known = values["known.stiffness"]
    assert (known.role, known.number, known.interval, known.scale) == ("identified", 2000.0, (1900.0, 2100.0), "log")
    assert values["known.limit"].bounds is None and values["known.limit"].sensible == (1e-3, 1e6)


def test_a_known_number_has_an_interval_around_it():
    spec = network("a: {element: slider, stiffness: {known: 2 N/mm, interval: [1.8 N/mm, 2.1 N/mm]}, limit: 3}")
    value = spec.slots()[0].value
    assert (value.number, value.interval, value.known, value.searched) == (2000.0, (1800.0, 2100.0), True, False)


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("{known: 2 N/mm}", "interval"),
        (
            "{known: 2 N/mm, interval: [3 N/mm, 4 N/mm]}",
            "expected a number inside its interval 3000 to 4000 N/m, got 2000",
        ),
        ("{known: 2 N/mm, interval: [-1 N/mm, 4 N/mm]}", "got -1000"),
        ("{known: 2 N/mm, interval: [1 N/mm, 4 N/mm], bounds: [1 N/mm, 2 N/mm]}", "bounds"),
    ],
)
def test_a_known_number_that_cannot_be(written, said):
    with pytest.raises(InputError, match=re.escape(said)):
        network(f"a: {{element: slider, stiffness: {written}, limit: 3}}")


def test_a_curve_may_be_a_slope_a_polynomial_a_table_or_come_from_data():
    spec = network("""
        a: {element: elastic, stiffness: {start: 2 N/mm}}
        b: {element: elastic, stiffness: {polynomial: [180 N/mm, {start: 1 N/mm^2}]}}
        c: {element: elastic, stiffness: {deflection: [0 mm, 10 mm], force: [0 N, 2 kN]}}
        d: {element: elastic, stiffness: {from: quasi_static, knots: 12}}
        e: {element: viscous, damping: {velocity: [-1 m/s, 0 m/s, 1 m/s], force: {start: [-1 kN, 0 N, 400 N]}}}
    """)
    forms = {path: curve.form for path, curve in spec.curves().items()}
    assert list(forms.values()) == ["constant", "polynomial", "table", "data", "table"]
    assert numbers(spec) == {
        "a.stiffness": 2e3,
        "b.stiffness[0]": 180e3,
        "b.stiffness[1]": 1e6,
        "c.stiffness[0]": 0.0,
        "c.stiffness[1]": 2e3,
        "e.damping[0]": -1e3,
        "e.damping[1]": 0.0,
        "e.damping[2]": 400.0,
    }
    assert spec.curves()["c.stiffness"].at == (0.0, 0.01)
    assert [value.role for value in spec.curves()["b.stiffness"].values] == ["fixed", "free"]
    assert {value.role for value in spec.curves()["e.damping"].values} == {"free"}
    assert spec.data_curves()["d.stiffness"].knots == 12


@pytest.mark.parametrize(
    ("refine", "role"), [("", "fixed"), ("refine: false, ", "fixed"), ("refine: true, ", "identified")]
)
def test_a_curve_from_data_with_numbers_is_a_table_that_is_kept_unless_it_is_to_be_refined(refine, role):
    knots = "deflection: [0 mm, 9 mm], force: [0 N, 2 kN]"
    spec = network(f"it: {{element: elastic, stiffness: {{from: quasi_static, {refine}{knots}}}}}")
    (curve,) = spec.data_curves().values()
    assert (curve.form, curve.data, curve.refine) == ("table", "quasi_static", role == "identified")
    assert [value.role for value in curve.values] == [role, role]


def test_a_scale_is_a_table_of_factors_over_deflection():
    (branch,) = network("""
        it:
          element: viscous
          damping: 100 N*s/m
          scale: {deflection: [5 mm, 20 mm], factor: [{start: 1.4, bounds: [0.1, 10]}, 1.0]}
    """).leaves()
    assert branch.scale.at == (0.005, 0.02)
    assert [(value.number, value.role, value.scale) for value in branch.scale.values] == [
        (1.4, "free", "log"),
        (1.0, "fixed", "log"),
    ]


def test_a_repeated_branch_takes_its_numbers_from_lists():
    spec = network("""
        pair:
          repeat: 2
          element: slider
          stiffness: {start: [1 N/mm, 2 N/mm], bounds: [0.1 N/mm, 9 N/mm]}
          limit: [5 N, 6 N]
          exponent: 2
    """)
    assert numbers(spec) == {
        "pair_1.stiffness": 1e3,
        "pair_1.limit": 5.0,
        "pair_1.exponent": 2.0,
        "pair_2.stiffness": 2e3,
        "pair_2.limit": 6.0,
        "pair_2.exponent": 2.0,
    }
    assert {branch.family for branch in spec.leaves()} == {"pair"}


def test_the_copies_of_a_curve_take_their_numbers_from_lists_too():
    spec = network("""
        pair:
          repeat: 2
          element: elastic
          stiffness: {polynomial: [[1 N/mm, 2 N/mm], {start: [3 N/mm^2, 4 N/mm^2]}]}
          scale: {deflection: [0 mm, 1 mm], factor: [{start: [1.1, 1.2]}, 1]}
    """)
    assert numbers(spec) == {
        "pair_1.stiffness[0]": 1e3,
        "pair_1.stiffness[1]": 3e6,
        "pair_1.scale[0]": 1.1,
        "pair_1.scale[1]": 1.0,
        "pair_2.stiffness[0]": 2e3,
        "pair_2.stiffness[1]": 4e6,
        "pair_2.scale[0]": 1.2,
        "pair_2.scale[1]": 1.0,
    }


def test_groups_name_their_branches_by_path_and_may_be_repeated():
    spec = network("""
        leg:
          repeat: 2
          parallel:
            rubber: {element: elastic, stiffness: [1 N/mm, 2 N/mm]}
            inner:
              series:
                oil: {element: viscous, damping: 3 N*s/m}
    """)
    assert [branch.name for branch in spec.leaves()] == [
        "leg_1.rubber",
        "leg_1.inner.oil",
        "leg_2.rubber",
        "leg_2.inner.oil",
    ]
    assert [branch.family for branch in spec.leaves()] == ["leg.rubber", "leg.inner.oil"] * 2
    assert numbers(spec)["leg_2.rubber.stiffness"] == 2e3
    assert [(group.name, group.kind) for group in spec.root.members] == [("leg_1", "parallel"), ("leg_2", "parallel")]


def test_a_network_uses_another_one_beside_it(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "rubber.yaml").write_text(written("core: {element: elastic, stiffness: 3 N/mm}"))
    (tmp_path / "whole.yaml").write_text(
        written("""
        mount: {use: parts/rubber.yaml, about: the rubber}
        oil: {element: viscous, damping: 3 N*s/m}
    """)
    )
    spec = read_network(tmp_path / "whole.yaml", ELEMENTS)
    assert numbers(spec) == {"mount.core.stiffness": 3e3, "oil.damping": 3.0}


def test_a_text_with_a_file_finds_what_lies_beside_it(tmp_path):
    (tmp_path / "rubber.yaml").write_text(written("core: {element: elastic, stiffness: 3 N/mm}"))
    spec = parse_network(written("mount: {use: rubber.yaml}"), ELEMENTS, str(tmp_path / "n.yaml"))
    assert numbers(spec) == {"mount.core.stiffness": 3e3}
    assert spec.file == str(tmp_path / "n.yaml")


def test_the_force_channel_has_delay_gain_and_offset():
    spec = parse_network(
        HEAD + "  it: {element: elastic, stiffness: 1e3}\n"
        "measurement:\n  force:\n    delay: {start: 1 ms}\n    offset: -20 N\n",
        ELEMENTS,
    )
    assert {slot.path: slot.value.number for slot in spec.slots()[1:]} == {
        "measurement.force.delay": 1e-3,
        "measurement.force.offset": -20.0,
    }
    assert spec.measurement["force.delay"].searched


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("hum: {cosine: 3 N}", "'force', 'hum' lacks 'frequency'. add 'frequency: 50 Hz'"),
        ("hum: {}", "lacks 'frequency'"),
        ("hum: 50 Hz", "'hum' as 'key: value' lines, got the text '50 Hz'"),
        ("hum: {frequency: 50 Hz, phase: 3}", "has no key 'phase'"),
        ("hum: {frequency: 0 Hz}", "measurement, force.hum.frequency: expected 0.001 to 100000 Hz, got 0"),
        ("hum: {frequency: 50 Hz, sine: 3 mm}", "measurement, force.hum.sine: expected a quantity in N, got 'mm'"),
        ("lag: -1 ms", "measurement, force.lag: expected 0 to 1000 s, got -0.001"),
        ("lag: {start: 1 ms, bounds: [-1 ms, 2 ms]}", "bounds inside 0 to 1000 s"),
        ("largest: 3 mm", "measurement, force.largest: expected a quantity in N"),
        ("compliance: -1e-8 m/N", "measurement, force.compliance: expected 0 to 1 m/N, got -1e-08"),
        ("compliance: 5 N/mm", "measurement, force.compliance: expected a quantity in m/N"),
        ("complaince: 0 m/N", "has no key 'complaince'. did you mean 'compliance'?"),
    ],
)
def test_what_is_wrong_with_the_force_channel_is_told(entry, message):
    text = HEAD + "  it: {element: elastic, stiffness: 1e3}\nmeasurement:\n  force: {" + entry + "}\n"
    with pytest.raises(InputError) as raised:
        parse_network(text, ELEMENTS, "n.yaml")
    assert message in str(raised.value)
    assert len(raised.value.problems) == 1


def test_all_mistakes_of_a_text_are_told_at_once_with_their_places():
    found = problems("""
        a:
          elemnt: elastic
          stiffness: 3
        b: {element: elastik, stiffness: 3}
        c:
          element: slider
          stifness: {start: 3 N/mm}
          limit: 3 mm
        d: {element: viscous, damping: {start: 1, bouns: [1, 2]}, scale: 0.7}
        e: {series: {x: {element: elastic}}}
        f: 7
    """)
    assert found == [
        "n.yaml:5:5: 'a' of branches lacks 'element'. add a line 'element: ...'",
        "n.yaml:5:5: 'a' of branches has no key 'elemnt'. did you mean 'element'?",
        "n.yaml:7:16: there is no element 'elastik'. did you mean 'elastic'?",
        "n.yaml:9:5: 'c' lacks 'stiffness' (slope at rest, N/m). add 'stiffness: ...'",
        "n.yaml:10:5: 'c' of branches has no key 'stifness'. did you mean 'stiffness'?",
        "n.yaml:11:12: c.limit: expected a quantity in N, got 'mm', which measures length; write it in N or a unit of "
        "the same kind",
        "n.yaml:12:45: d.damping has no key 'bouns'. did you mean 'bounds'?",
        "n.yaml:12:68: d.scale: expected a table over deflection, got the number '0.7'. "
        "write {deflection: [5 mm, 20 mm], factor: [1.2, 1]}",
        "n.yaml:13:19: 'x' lacks 'stiffness' (force over deflection). add 'stiffness: ...'",
        "n.yaml:14:6: expected 'f' of branches as 'key: value' lines, got the number '7'. indent its keys",
    ]


def test_mistakes_at_the_top_are_told_with_those_below():
    with pytest.raises(InputError) as caught:
        parse_network("format: dashpot-network/2\nnam: x\nbranchs: {}\nmeasurement: {forc: {}}\n", ELEMENTS, "n.yaml")
    assert [str(problem).partition(".")[0] + "..." + str(problem)[-28:] for problem in caught.value.problems]
    told = str(caught.value)
    for part in (
        "n.yaml:1:9",
        "expected one of dashpot-network/1",
        "lacks 'name'",
        "did you mean 'name'?",
        "lacks 'branches'",
        "did you mean 'branches'?",
        "did you mean 'force'?",
    ):
        assert part in told


@pytest.mark.parametrize("kind", ["series", "parallel"])
def test_an_empty_group_is_refused(kind):
    (told,) = problems(f"{{leg: {{{kind}: {{}}}}}}")
    assert told.endswith("expected at least one branch, got none. write it, or leave the group out")


def test_an_empty_network_is_told_what_it_lacks():
    assert problems("{}") == [
        "n.yaml:4:3: the network has no branch. add a branch, e.g. 'stiffness: {element: spring, ...}'"
    ]


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        ("stiffness: 0.5 N/m, limit: 3", "1:31: it.stiffness: expected 1 to 1e+09 N/m, got 0.5"),
        ("stiffness: 5, limit: 0", "it.limit: expected 0.001 to 1e+06 N, got 0"),
        (
            "stiffness: [1, 2], limit: 3",
            "it.stiffness: expected one number, got a list of 2; a list is for the copies of a branch with 'repeat'",
        ),
        ("stiffness: {start: 5, bounds: [9, 2]}, limit: 3", "'bounds': expected low < high, got 9 and 2"),
        ("stiffness: {start: 5, bounds: [1, 2, 3]}, limit: 3", "'bounds': expected [low, high], got 3 numbers"),
        ("stiffness: {start: 5, bounds: [0.1, 9]}, limit: 3", "expected bounds inside 1 to 1e+09 N/m, got 0.1 to 9"),
        ("stiffness: {start: 50, bounds: [1, 9]}, limit: 3", "expected a start inside its bounds 1 to 9 N/m, got 50"),
        (
            "stiffness: {start: 5, scale: logg}, limit: 3",
            "expected one of log, linear, got 'logg'; did you mean 'log'?",
        ),
        ("stiffness: {bounds: [1, 9]}, limit: 3", "it.stiffness lacks 'start'"),
        (
            "stiffness: 5, limit: 3, exponent: {start: 0, scale: log}",
            "expected positive numbers for a log scale, got 0 1; write scale: linear",
        ),
        ("stiffness: 5, limit: true", "it.limit: expected a quantity in N, got"),
        ("stiffness: 5, limit: 3, repeat: 0", "expected 1 to 100 copies, got 0"),
        ("stiffness: 5, limit: 3, repeat: 101", "expected 1 to 100 copies, got 101"),
        ("stiffness: [5, 6], limit: 3, repeat: 3", "it_1.stiffness: expected 3 numbers, one for each copy, got 2"),
    ],
)
def test_a_wrong_number_is_told(entry, told):
    (found,) = problems(f"it: {{element: slider, {entry}}}")
    assert told.removeprefix("1:31: ") in found
    assert found.startswith("n.yaml:4:")


@pytest.mark.parametrize(
    ("curve", "told"),
    [
        ("{polynomial: []}", "expected at least one coefficient, got an empty list"),
        ("{polynomial: [3 N/mm, 2 N/mm]}", "it.stiffness, power 2: expected a quantity in N/m^2, got 'N/mm'"),
        ("{deflection: [0, 1]}", "it.stiffness lacks 'force'. give one force for each deflection"),
        ("{deflection: [0, 1], force: 3 N}", "expected a list of numbers, got the text '3 N'"),
        (
            "{deflection: [0, 1], force: [1, 2, 3]}",
            "expected as many force as deflection, at least two of each, got 3 and",
        ),
        ("{deflection: [0], force: [1]}", "expected as many force as deflection, at least two of each, got 1 and 1"),
        ("{deflection: [0, 2, 1], force: [1, 2, 3]}", "expected growing deflection, got 1 m as number 3 after 2"),
        ("{deflection: [0, 1], force: [1 mm, 2 N]}", "it.stiffness: expected a quantity in N, got 'mm'"),
        ("{from: sweep}", "expected one of quasi_static, got 'sweep'"),
        ("{from: quasi_static, knots: 1}", "expected 2 to 200 knots, got 1"),
        ("{from: quasi_static, refine: 3}", "expected true or false"),
        ("{from: quasi_static, knot: 9}", "has no key 'knot'. did you mean 'knots'?"),
    ],
)
def test_a_wrong_curve_is_told(curve, told):
    (found,) = problems(f"it: {{element: elastic, stiffness: {curve}}}")
    assert told in found


def test_a_fixed_slope_of_zero_switches_a_curve_off():
    assert numbers(network("it: {element: viscous, damping: 0}")) == {"it.damping": 0.0}


@pytest.mark.parametrize(
    ("branches", "told"),
    [
        (
            "a.b: {element: elastic, stiffness: 5}",
            "expected a name of letters, digits, '_', '-' and '+' other than "
            "'measurement', got 'a.b'. rename the branch",
        ),
        ("measurement: {element: elastic, stiffness: 5}", "other than 'measurement', got 'measurement'"),
        (
            "{a: {repeat: 2, element: elastic, stiffness: 5}, a_2: {element: elastic, stiffness: 5}}",
            "a second branch is called 'a_2', the first one stands in n.yaml:4:7",
        ),
        (
            "{a: {element: elastic, stiffness: {from: quasi_static}}, b: {element: "
            "elastic, stiffness: {from: quasi_static}}}",
            "'b.stiffness' and 'a.stiffness' both come from quasi_static data: the force would count twice",
        ),
        (
            "a: {element: viscous, damping: {from: quasi_static}}",
            "only a force over deflection can be taken from data, not a force over velocity",
        ),
        (
            "{a: {element: elastic, stiffness: &k {start: 5}}, b: {element: elastic, stiffness: *k}}",
            "'b.stiffness' is an alias of 'a.stiffness', a parameter to be identified",
        ),
        (
            "{a: &it {element: elastic, stiffness: {start: 5}}, b: *it}",
            "'b.stiffness' is an alias of 'a.stiffness', a parameter to be identified",
        ),
        (
            "{a: {repeat: 2, parallel: {b: {repeat: 2, element: elastic, stiffness: 5}}}}",
            "a branch inside a repeated group cannot be repeated again",
        ),
        (
            "{a: {repeat: 2, element: elastic, stiffness: {deflection: [0, 1], force: {start: [1, 2]}}}}",
            "expected a list with an entry for each knot, as the branch is repeated",
        ),
    ],
)
def test_branches_that_do_not_go_together_are_told(branches, told):
    assert any(told in found for found in problems(branches))


def test_a_fixed_number_may_be_an_alias():
    spec = network("{a: {element: elastic, stiffness: &k 5}, b: {element: elastic, stiffness: *k}}")
    assert numbers(spec) == {"a.stiffness": 5.0, "b.stiffness": 5.0}


@pytest.mark.parametrize(
    ("use", "told"),
    [
        (
            "tire_modell_5",
            "'tire_modell_5' cannot be used: there is no such file and no shipped network of that name. "
            "did you mean 'tire_model_5'?",
        ),
        ("missing.yaml", "'missing.yaml' cannot be used: there is no such file"),
        ("../outside.yaml", "'../outside.yaml' cannot be used: expected a file in or below"),
        ("/etc/outside.yaml", "'/etc/outside.yaml' cannot be used: expected a file in or below"),
    ],
)
def test_a_network_that_cannot_be_used_is_told_where_it_is_used(tmp_path, use, told):
    file = tmp_path / "n.yaml"
    file.write_text(written(f"it: {{use: {use}}}"))
    with pytest.raises(InputError) as caught:
        read_network(file, ELEMENTS)
    assert str(caught.value).startswith(f"{file}:4:13: {told}")


def test_the_mistakes_of_a_used_network_are_told_in_its_own_lines(tmp_path):
    (tmp_path / "inner.yaml").write_text(written("core: {element: elastic}"))
    (tmp_path / "n.yaml").write_text(written("it: {use: inner.yaml}"))
    with pytest.raises(InputError) as caught:
        read_network(tmp_path / "n.yaml", ELEMENTS)
    first, second = sorted(str(caught.value).splitlines())
    assert first.startswith(f"{tmp_path / 'inner.yaml'}:4:9: 'core' lacks 'stiffness'")
    assert second.startswith(f"{tmp_path / 'n.yaml'}:4:13: 'inner.yaml' cannot be used: it has mistakes of its own")


def test_a_network_that_uses_itself_is_told_the_way_round(tmp_path):
    for name, other in (("a", "b"), ("b", "c"), ("c", "a")):
        (tmp_path / f"{name}.yaml").write_text(written(f"it: {{use: {other}.yaml}}"))
    with pytest.raises(InputError, match=r"uses itself: a\.yaml -> b\.yaml -> c\.yaml -> a\.yaml"):
        read_network(tmp_path / "a.yaml", ELEMENTS)


def test_a_used_network_describes_the_specimen_only(tmp_path):
    (tmp_path / "inner.yaml").write_text(
        written("core: {element: elastic, stiffness: 5}") + "measurement: {force: {delay: 1 ms}}\n"
    )
    (tmp_path / "n.yaml").write_text(written("it: {use: inner.yaml}"))
    with pytest.raises(InputError, match=r"inner\.yaml:5:30: .* expected no 'measurement'"):
        read_network(tmp_path / "n.yaml", ELEMENTS)


def test_what_is_written_under_identified_is_for_people():
    text = written("it: {element: elastic, stiffness: 5}") + "identified: {data: 1234, note: [anything, at, all]}\n"
    assert parse_network(text, ELEMENTS).leaves()[0].element is Elastic

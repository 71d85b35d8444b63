"""An edited text keeps its comments and layout, and reads back as the network that was meant."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from unit.model.specimens import ELEMENTS, HEAD, network, numbers, written

from dashpot import load_registry
from dashpot.model.network import NetworkSpec, Value
from dashpot.model.patch import (
    add_branch,
    add_measurement,
    add_to_branch,
    fill_numbers,
    make_dependent,
    remove_branch,
    remove_measurement,
    rename,
    replace_branch,
    set_entry,
)
from dashpot.model.reading import parse_network, read_network
from dashpot.model.shipped import shipped_networks
from dashpot.text.name import is_name
from dashpot.text.problem import InputError

BLOCK = written("""
    rubber:                      # the core
      element: elastic
      stiffness: {start: 220 N/mm}   # a guess
      # nothing more is known of the core
    oil:
      element: viscous
      damping:
        start: 3 N*s/m
        bounds: [1 N*s/m, 9 N*s/m]  # from the data sheet
""")
FLOW = (
    HEAD.rstrip() + " {rubber: {element: elastic, stiffness: {start: 220 N/mm}}, oil: {element: viscous, damping: 3}}\n"
)
JSON = (
    '{"format": "dashpot-network/1", "name": "bench", "branches": '
    '{"rubber": {"element": "elastic", "stiffness": {"start": "220 N/mm"}}}}'
)


def read(text: str) -> NetworkSpec:
    return parse_network(text, ELEMENTS, "n.yaml")


def moved(spec: NetworkSpec, seed: int, interval: bool = True) -> NetworkSpec:
    """The network with other numbers in all searched places, known within some percent."""
    rng = np.random.default_rng(seed)
    values = {}
    for slot in spec.slots():
        if slot.value.searched:
            low, high = slot.value.bounds or slot.value.sensible
            number = float(np.clip(slot.value.number * np.exp(rng.uniform(-1.0, 1.0)), low, high))
            known = (number - 0.1 * abs(number), number + 0.1 * abs(number)) if interval else None
            values[slot.path] = replace(slot.value, number=number, interval=known)
    return spec.with_values(values)


def assert_filled(text: str, fitted: NetworkSpec, elements=ELEMENTS) -> NetworkSpec:
    """The text reads back as the fitted network, to the digits that were written."""
    found = parse_network(text, elements, "n.yaml")
    assert numbers(found) == {path: pytest.approx(number, rel=1e-7) for path, number in numbers(fitted).items()}
    expected = {slot.path: slot.value for slot in fitted.slots()}
    for slot in found.slots():
        assert slot.value.searched == expected[slot.path].searched
        if slot.value.searched and "[" not in slot.path:
            assert slot.value.interval == pytest.approx(expected[slot.path].interval, rel=1e-3)
            assert slot.value.bounds == expected[slot.path].bounds
    return found


def comments(text: str) -> list[str]:
    return [line.partition("#")[2] for line in text.splitlines() if "#" in line]


@pytest.mark.parametrize("text", [BLOCK, FLOW, JSON], ids=["block", "flow", "json"])
def test_filled_in_numbers_read_back_in_every_style(text):
    fitted = moved(read(text), 1)
    filled = fill_numbers(read(text), fitted, {"data": "abc", "rmse": "3.1 N"})
    found = assert_filled(filled, fitted)
    assert found.name == "bench"
    assert comments(filled)[: len(comments(text))] == comments(text)
    assert read(filled).document.root.entries["identified"].plain() == {"data": "abc", "rmse": "3.1 N"}


def test_filling_in_touches_the_numbers_only():
    spec = read(BLOCK)
    filled = fill_numbers(spec, moved(spec, 2, interval=False), {})
    before, after = BLOCK.splitlines(), filled.splitlines()
    changed = [k for k, (old, new) in enumerate(zip(before, after, strict=False)) if old != new]
    assert [before[k].split()[0] for k in changed] == ["stiffness:", "start:"]
    assert after[changed[0]].endswith("   # a guess")


def test_an_identified_network_can_be_identified_again():
    spec = read(BLOCK)
    once = fill_numbers(spec, moved(spec, 3), {"data": "first"})
    again = moved(read(once), 4)
    twice = fill_numbers(read(once), again, {"data": "second", "seed": "7"})
    assert_filled(twice, again)
    assert twice.count("identified:") == 1 and "first" not in twice
    assert comments(twice) == comments(once)


def test_the_record_may_stand_in_the_middle():
    text = (
        HEAD.replace("branches:\n", "identified: {data: old}\nbranches:\n")
        + "  it: {element: elastic, stiffness: {start: 5}}\n"
    )
    filled = fill_numbers(read(text), moved(read(text), 5), {"data": "new"})
    assert read(filled).document.root.entries["identified"].plain() == {"data": "new"}


@pytest.mark.parametrize("word", ["a: b", "12e4", "# no comment", "it's", "[1, 2", "", "ünder", "true", "a, b", "- x"])
def test_any_text_can_be_recorded_and_be_a_name(word):
    spec = read(BLOCK)
    filled = fill_numbers(spec, spec, {"predecessor": word})
    assert str(read(filled).document.root.entries["identified"].entries["predecessor"].written) == word
    if is_name(word):
        assert read(rename(BLOCK, word, [])).name == word


def test_copies_and_knots_get_a_number_each():
    spec = network("""
        pair:
          repeat: 2
          element: slider
          stiffness: {start: 1 N/mm}
          limit: {start: [5 N, 6 N]}
        bent: {element: elastic, stiffness: {polynomial: [{start: 180 N/mm}, {start: 1 N/mm^2}, 0]}}
        oil:
          element: viscous
          damping: {velocity: [-1 m/s, 0 m/s, 2 m/s], force: {start: [-1 kN, 0 N, 400 N]}}
          scale: {deflection: [5 mm, 20 mm], factor: [{start: 1.4, bounds: [0.1, 10]}, 1.0]}
        both:
          repeat: 2
          element: elastic
          stiffness: {polynomial: [{start: 7 N/mm}, 2 N/mm^2]}
          scale: {deflection: [5 mm, 20 mm], factor: [{start: 1.3}, 1.0]}
    """)
    fitted = moved(spec, 6)
    text = fill_numbers(spec, fitted, {})
    assert_filled(text, fitted)
    assert "stiffness: {value: [" in text


def test_the_force_channel_is_filled_in_too():
    text = BLOCK + "measurement:\n  force:\n    delay: {start: 1 ms, bounds: [-5 ms, 5 ms]}  # of the filter\n"
    fitted = moved(read(text), 7)
    filled = fill_numbers(read(text), fitted, {})
    assert_filled(filled, fitted)
    assert "# of the filter" in filled


def test_a_curve_from_data_becomes_a_table_that_still_says_so():
    spec = network("it: {element: elastic, stiffness: {from: quasi_static}}  # from the loop")
    ((path, curve),) = spec.data_curves().items()
    values = tuple(Value(force, "N", "identified", scale="linear") for force in (0.0, 900.0, 2100.0))
    fitted = spec.with_curve(path, replace(curve, form="table", values=values, at=(0.0, 0.005, 0.01)))
    text = fill_numbers(spec, fitted, {})
    (found,) = read(text).data_curves().values()
    assert (found.form, found.at) == ("table", (0.0, 0.005, 0.01))
    assert [value.number for value in found.values] == [0.0, 900.0, 2100.0]
    assert "# from the loop" in text
    again = fill_numbers(read(text), read(text), {})
    assert again == text
    moved_along = fill_numbers(spec, fitted.with_curve(path, replace(fitted.curves()[path], refine=True)), {})
    (found,) = read(moved_along).data_curves().values()
    assert found.refine and {value.role for value in found.values} == {"identified"}


@pytest.mark.parametrize("name", shipped_networks())
def test_every_shipped_network_can_be_filled_in(name):
    elements = load_registry().elements
    spec = read_network(name, elements)
    values = tuple(Value(force, "N", "identified", scale="linear") for force in (0.0, 900.0, 2100.0))
    taken = spec
    for path, curve in spec.data_curves().items():
        table = replace(curve, form="table", values=values, at=(0.0, 0.005, 0.01), refine=True)
        taken = taken.with_curve(path, table)
    fitted = moved(taken, 8)
    text = fill_numbers(spec, fitted, {"data": "abc"})
    assert_filled(text, fitted, elements)
    assert comments(text)[: len(comments(spec.document.text))] == comments(spec.document.text)


def test_a_used_network_with_searched_numbers_is_written_out(tmp_path):
    (tmp_path / "inner.yaml").write_text(
        written("""
        core:            # of rubber
          element: elastic
          stiffness: {start: 3 N/mm}
        pair: {repeat: 2, element: viscous, damping: {start: 2}}
    """)
    )
    (tmp_path / "n.yaml").write_text(
        written("""
        mount:           # in the middle
          use: inner.yaml
          about: the mount
        oil: {element: viscous, damping: {start: 9}}
        group: {parallel: {other: {use: inner.yaml}}}
    """)
    )
    spec = read_network(tmp_path / "n.yaml", ELEMENTS)
    fitted = moved(spec, 9)
    text = fill_numbers(spec, fitted, {})
    assert_filled(text, fitted)
    assert "use:" not in text
    assert "# of rubber" in text and "# in the middle" in text


def test_a_used_network_with_fixed_numbers_stays_where_it_is(tmp_path):
    (tmp_path / "inner.yaml").write_text(written("core: {element: elastic, stiffness: 3 N/mm}"))
    (tmp_path / "n.yaml").write_text(
        written("{mount: {use: inner.yaml}, oil: {element: viscous, damping: {start: 9}}}")
    )
    spec = read_network(tmp_path / "n.yaml", ELEMENTS)
    text = fill_numbers(spec, moved(spec, 10), {})
    assert "use: inner.yaml" in text


def test_a_network_without_a_text_cannot_be_filled_in():
    with pytest.raises(ValueError, match="expected a network that was read from a text, got 'bench', which was built"):
        fill_numbers(replace(read(BLOCK), document=None), read(BLOCK), {})


@given(seed=st.integers(0, 2**32 - 1))
def test_whatever_the_numbers_they_read_back(seed):
    spec = read(BLOCK)
    fitted = moved(spec, seed)
    assert_filled(fill_numbers(spec, fitted, {}), fitted)


def test_numbers_at_their_bounds_and_narrow_intervals_read_back():
    text = written("it: {element: viscous, damping: {start: 5, bounds: [1.23456789123, 9.87654321987]}}")
    spec = read(text)
    (slot,) = spec.slots()
    for number in slot.value.bounds:
        for width in (0.0, 1e-12, 1e-7, 1e-3):
            known = replace(slot.value, number=number, interval=(number - width, number + width))
            found = read(fill_numbers(spec, spec.with_values({slot.path: known}), {})).slots()[0].value
            assert found.number == pytest.approx(number, rel=1e-7)
            assert found.interval == pytest.approx(known.interval, abs=max(width, 1e-4))


NEW = "friction:\n  element: slider          # a suspect\n  stiffness: {start: 60 N/mm}\n  limit: {start: 15 N}"


@pytest.mark.parametrize("text", [BLOCK, FLOW, JSON], ids=["block", "flow", "json"])
def test_a_branch_is_added_behind_the_others(text):
    extended = add_branch(text, NEW)
    before, after = read(text), read(extended)
    assert [branch.name for branch in after.leaves()] == [*(branch.name for branch in before.leaves()), "friction"]
    assert numbers(after) == numbers(before) | {"friction.stiffness": 6e4, "friction.limit": 15.0}
    assert comments(extended)[: len(comments(text))] == comments(text)


def test_a_branch_goes_before_what_follows_the_branches():
    text = BLOCK + "measurement: {force: {delay: 1 ms}}\n# the end\n"
    extended = add_branch(add_branch(text, NEW), NEW.replace("friction", "more", 1))
    assert [branch.name for branch in read(extended).leaves()] == ["rubber", "oil", "friction", "more"]
    assert extended.endswith("measurement: {force: {delay: 1 ms}}\n# the end\n")


def test_a_comment_below_the_last_branch_stays_with_it():
    text = written("it: {element: elastic, stiffness: 5}\n")[:-1] + "  # a remark\n    # about it\n"
    assert "# about it\n  friction:" in add_branch(text, NEW)


def test_a_text_may_end_without_a_line_feed():
    assert [branch.name for branch in read(add_branch(BLOCK.rstrip("\n"), NEW)).leaves()] == [
        "rubber",
        "oil",
        "friction",
    ]


def test_a_second_branch_of_a_name_is_refused():
    with pytest.raises(ValueError, match="'oil' stands there already, in line 4 and below"):
        add_branch(BLOCK, "oil: {element: viscous, damping: 3}")


def test_the_first_branch_may_be_added_to_none():
    text = add_branch(HEAD.rstrip() + "\nmeasurement: {force: {gain: 1.1}}\n", NEW)
    assert numbers(read(text)) == {"friction.stiffness": 6e4, "friction.limit": 15.0, "measurement.force.gain": 1.1}


@pytest.mark.parametrize("text", [BLOCK, FLOW, JSON], ids=["block", "flow", "json"])
def test_a_branch_that_was_added_can_be_removed(text):
    between = add_branch(add_branch(text, NEW), NEW.replace("friction", "last", 1))
    assert comments(remove_branch(remove_branch(between, "friction"), "last")) == comments(text)
    assert read(remove_branch(between, "friction")) == read(add_branch(text, NEW.replace("friction", "last", 1)))
    without_first = read(remove_branch(between, "rubber"))
    assert numbers(without_first) == {
        path: number for path, number in numbers(read(between)).items() if not path.startswith("rubber")
    }


def test_comments_of_a_removed_branch_go_and_others_stay():
    assert comments(remove_branch(BLOCK, "rubber")) == [" from the data sheet"]
    assert remove_branch(BLOCK, "oil") == BLOCK.partition("  oil:")[0]


def test_a_branch_inside_groups_is_removed():
    text = written(
        "leg: {parallel: {a: {series: {oil: {element: viscous, damping: 3}, k: {element: elastic, stiffness: 5}}}}}"
    )
    assert numbers(read(remove_branch(text, "leg.a.oil"))) == {"leg.a.k.stiffness": 5.0}
    with pytest.raises(InputError, match="the network has no branch 'leg.b'"):
        remove_branch(text, "leg.b")


REPEATED = [
    "damping: {start: [1, 2, 3], bounds: [0.1, 9]}",
    "damping: [1, 2, 3]",
    "damping: {value: [1, 2, 3], interval: [[0.5, 2], [1.5, 3], [2, 4]]}",
    "damping: {fixed: [1, 2, 3], over: {setting: current, at: 1, slope: {start: [4, 5, 6]}}}",
    "damping: {start: 2, over: {setting: current, at: [0, 1], factor: [1, {start: [4, 5, 6]}]}}",
    "damping: 7, scale: {deflection: [0, 1 mm], factor: [1, {start: [4, 5, 6], bounds: [0.1, 9]}]}",
]


@pytest.mark.parametrize("law", REPEATED)
@pytest.mark.parametrize("flow", [True, False], ids=["flow", "block"])
@pytest.mark.parametrize("gone", [("oil_1",), ("oil_2",), ("oil_3", "oil_1"), ("oil_1", "oil_2", "oil_3")])
def test_copies_of_a_repeated_branch_are_removed(law, flow, gone):
    """What is left has the numbers and the names that it had."""
    entry = f"oil: {{repeat: 3, element: viscous, {law}}}\nrubber: {{element: elastic, stiffness: 5}}"
    if not flow:
        entry = entry.replace("{repeat: 3, element: viscous, ", "\n  repeat: 3\n  element: viscous\n  ", 1)
        entry = entry.replace("}\nrubber", "\nrubber", 1).replace(", scale: ", "\n  scale: ", 1)
    text, found = written(entry), read(written(entry))
    for branch in gone:
        text = remove_branch(text, branch)
    stays = {slot.path: slot.value for slot in found.slots() if slot.path.partition(".")[0] not in gone}
    assert {slot.path: slot.value for slot in read(text).slots()} == stays
    assert [leaf.characteristics() for leaf in read(text).leaves()] == [
        leaf.characteristics() for leaf in found.leaves() if leaf.name not in gone
    ]


@pytest.mark.parametrize("text", [BLOCK, FLOW, JSON], ids=["block", "flow", "json"])
def test_an_entry_is_set_whether_it_was_there_or_not(text):
    set_once = set_entry(text, "rubber", "stiffness", "{start: 7 N/mm}")
    assert numbers(read(set_once)) == numbers(read(text)) | {"rubber.stiffness": 7e3}
    twice = set_entry(set_once, "rubber", "about", "of the leg")
    assert numbers(read(twice)) == numbers(read(set_once)) and "of the leg" in twice


@pytest.mark.parametrize(
    "lines",
    ["scale: {deflection: [0 mm, 5 mm], factor: [1.2, 1]}", "scale:\n  deflection: [0 mm, 5 mm]\n  factor: [1.2, 1]"],
)
@pytest.mark.parametrize("text", [BLOCK, FLOW], ids=["block", "flow"])
@pytest.mark.parametrize("branch", ["rubber", "oil"])
def test_an_entry_is_added_to_a_branch(text, branch, lines):
    after = read(add_to_branch(text, branch, lines))
    scales = {leaf.name: leaf.scale for leaf in after.leaves()}
    assert [value.number for value in scales.pop(branch).values] == [1.2, 1.0]
    assert set(scales.values()) == {None}


def test_an_entry_is_added_to_a_branch_inside_groups():
    text = written("leg: {parallel: {inner: {series: {oil: {element: viscous, damping: 3}}}}}")
    after = read(add_to_branch(text, "leg.inner.oil", "about: of the leg"))
    assert after.document.text.count("about: of the leg") == 1
    assert numbers(after) == {"leg.inner.oil.damping": 3.0}


def test_an_entry_for_a_branch_that_is_not_there_is_refused():
    with pytest.raises(InputError, match="the network has no branch 'oill'. did you mean 'oil'?"):
        add_to_branch(BLOCK, "oill", "about: it")
    with pytest.raises(InputError, match="the network has no branch 'oil.inner'"):
        add_to_branch(BLOCK, "oil.inner", "about: it")
    with pytest.raises(ValueError, match="'damping' stands there already"):
        add_to_branch(BLOCK, "oil", "damping: 4")


def test_an_alias_is_not_edited_behind_its_back():
    text = written("{a: &it {element: elastic, stiffness: 5}, b: *it}")
    with pytest.raises(InputError, match="write it out"):
        add_to_branch(text, "b", "about: it")


@pytest.mark.parametrize(
    "before",
    [
        "",
        "measurement: {force: {gain: 1.1}}\n",
        "measurement:\n  force:\n    gain: 1.1   # checked\n",
        "measurement: {force: {gain: 1.1, delay: 3 ms}}\n",
        "measurement:\n  force:\n    delay: 7 ms  # guessed\n    gain: 1.1\n",
        "measurement: {force: {}}\n",
        "measurement: {}\n",
    ],
)
def test_the_force_channel_gets_an_entry(before):
    text = add_measurement(BLOCK + before, "delay", "{start: 2 ms, bounds: [-5 ms, 5 ms]}")
    found = {slot.path: slot.value.number for slot in read(text).slots() if slot.path.startswith("measurement")}
    expected = {"measurement.force.delay": 2e-3} | ({"measurement.force.gain": 1.1} if "gain" in before else {})
    assert found == expected
    assert comments(text) == comments(BLOCK + before)
    assert ("gain: 1.1   # checked" in text) == ("# checked" in before)


@pytest.mark.parametrize(
    "before", ["", "measurement:\n  force:\n    gain: 1.1   # checked\n", "measurement: {force: {}}\n"]
)
@pytest.mark.parametrize(
    ("key", "entry", "expected"),
    [
        ("lag", "{start: 2 ms}", {"lag": 2e-3}),
        ("largest", "1.5 kN", {"largest": 1500.0}),
        ("compliance", "{start: 1e-8 m/N, bounds: [0 m/N, 1e-6 m/N]}", {"compliance": 1e-8}),
        (
            "hum",
            "{frequency: 50 Hz, cosine: {start: 1 N}, sine: {start: -2 N}}",
            {"hum.frequency": 50.0, "hum.cosine": 1.0, "hum.sine": -2.0},
        ),
    ],
)
def test_the_force_channel_gets_any_entry_and_another_one_in_its_place(before, key, entry, expected):
    text = add_measurement(BLOCK + before, key, entry)
    gain = {"gain": 1.1} if "gain" in before else {}
    paths = {f"measurement.force.{name}": number for name, number in (gain | expected).items()}
    for again in (text, add_measurement(text, key, entry)):
        found = {slot.path: slot.value.number for slot in read(again).slots() if slot.path.startswith("measurement")}
        assert found == paths
    assert comments(text) == comments(BLOCK + before)


@pytest.mark.parametrize(
    ("before", "left"),
    [
        ("", {}),
        ("measurement: {}\n", {}),
        ("measurement: {force: {gain: 1.1}}\n", {"gain": 1.1}),
        ("measurement: {force: {lag: 2 ms, gain: 1.1}}\n", {"gain": 1.1}),
        ("measurement:\n  force:\n    gain: 1.1   # checked\n    lag: {start: 2 ms}\n", {"gain": 1.1}),
        ("measurement: {force: {lag: 2 ms}}\n", {}),
        ("measurement:\n  force:\n    lag: {start: 2 ms}\n", {}),
    ],
)
def test_an_entry_of_the_force_channel_goes_where_there_is_one(before, left):
    text = remove_measurement(BLOCK + before, "lag")
    found = {slot.path: slot.value.number for slot in read(text).slots() if slot.path.startswith("measurement")}
    assert found == {f"measurement.force.{name}": number for name, number in left.items()}
    assert comments(text) == comments(BLOCK + before)
    again = add_measurement(text, "delay", "{start: 1 ms}")
    assert "measurement.force.delay" in numbers(read(again))


def test_a_json_text_gets_its_force_channel_too():
    assert "measurement.force.gain" in numbers(read(add_measurement(JSON, "gain", "{start: 1.0}")))


def test_a_renamed_network_says_so_at_its_head():
    text = rename(BLOCK, "bench+friction", ["bench, extended.", ""])
    assert text.startswith("# bench, extended.\n#\nformat:")
    assert read(text).name == "bench+friction"
    assert numbers(read(text)) == numbers(read(BLOCK))


def test_what_can_not_be_read_cannot_be_edited():
    with pytest.raises(InputError, match="expected a mapping, got a list of 0"):
        add_branch("branches: []\n", NEW)


OVER = "setting: pressure, at: 2 bar, slope: {start: 1 N/mm/bar}"


@pytest.mark.parametrize("text", [BLOCK, FLOW, JSON])
def test_a_number_is_made_to_depend_on_a_setting(text):
    spec = read(make_dependent(text, "rubber", "stiffness", OVER))
    found = {slot.path: slot.value for slot in spec.slots()}
    assert found["rubber.stiffness"].number == 220e3
    assert found["rubber.stiffness"].over.word == "pressure"
    assert found["rubber.stiffness.slope"].number == pytest.approx(0.01)
    with pytest.raises(InputError, match="without 'over'"):
        make_dependent(make_dependent(text, "rubber", "stiffness", OVER), "rubber", "stiffness", OVER)


def test_a_plain_number_that_depends_on_a_setting_stays_fixed():
    spec = read(make_dependent(FLOW, "oil", "damping", "channel: current, at: 0 A, rate: {start: 1 /A}"))
    found = {slot.path: slot.value for slot in spec.slots()}
    assert not found["oil.damping"].searched
    assert found["oil.damping.rate"].searched
    with pytest.raises(InputError, match="no branch 'air'"):
        make_dependent(FLOW, "air", "damping", OVER)
    with pytest.raises(InputError, match="has no 'stiffness'"):
        make_dependent(FLOW, "oil", "stiffness", OVER)


@pytest.mark.parametrize("text", [BLOCK, FLOW])
def test_a_branch_is_replaced_under_its_name(text):
    spec = read(replace_branch(text, "oil", "{element: elastic, stiffness: 5 N/mm}"))
    assert {slot.path: slot.value.number for slot in spec.slots()} == {"rubber.stiffness": 220e3, "oil.stiffness": 5e3}
    assert ("# a guess" in replace_branch(text, "oil", "{element: elastic, stiffness: 5}")) == (text is BLOCK)

"""The range in which numbers were identified, in files and in words."""

from __future__ import annotations

import pytest

from dashpot import load_registry
from dashpot.model.identified import outside, widened
from dashpot.model.patch import fill_numbers
from dashpot.model.reading import parse_network
from dashpot.text.problem import InputError

HEAD = """
format: dashpot-network/1
name: mount
branches: {rubber: {element: spring, stiffness: {value: 5 N/mm}}}
"""
SEEN = {
    "displacement": (-1e-3, 19e-3),
    "speed": (0.0, 0.25),
    "amplitude": (5e-4, 4e-3),
    "preload": (0.0, 15e-3),
    "frequency": (0.1, 25.0),
}


def read(text: str):
    return parse_network(text, load_registry().elements, "mount.yaml")


@pytest.mark.parametrize("seen", [SEEN, {f"{name}@wheel left": ends for name, ends in SEEN.items()}])
def test_a_range_reads_back(seen):
    filled = fill_numbers(read(HEAD), read(HEAD), {"data": "abc"}, seen)
    found = read(filled).identified
    assert found.record == {"data": "abc"}
    assert found.range == {name: pytest.approx(ends, rel=1e-5) for name, ends in seen.items()}
    again = fill_numbers(read(filled), read(filled), {"data": "def"}, {"speed": (0.0, 1.0)})
    assert read(again).identified.range == {"speed": (0.0, 1.0)}


@pytest.mark.parametrize("record", ["{data: abc, seed: 1}", "{}", "by hand", "[1, 2]", ""])
def test_a_file_without_a_range_reads_as_before(record):
    assert read(HEAD + f"identified: {record}\n").identified.range == {}


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("speed: [0 m/s]", "expected [least, largest]"),
        ("speed: [2 m/s, 1 m/s]", "expected [least, largest]"),
        ("speed: [0 mm, 1 mm]", "expected a quantity in m/s, got 'mm'"),
        ("sped: [0 m/s, 1 m/s]", "the range of identification has no key 'sped'"),
    ],
)
def test_a_mistake_in_a_range_is_told(entry, message):
    with pytest.raises(InputError) as told:
        read(HEAD + f"identified:\n  range: {{{entry}}}\n")
    assert message in str(told.value)
    assert str(told.value).startswith("mount.yaml:6:")


def test_inside_is_told_nothing_and_outside_each_quantity():
    assert outside(SEEN, SEEN) == []
    faster = {**SEEN, "speed": (0.0, 0.5), "frequency": (0.1, 60.0)}
    assert outside(faster, SEEN) == [
        "speed 0 mm/s to 500 mm/s, identified in 0 mm/s to 250 mm/s",
        "frequency 0.1 Hz to 60 Hz, identified in 0.1 Hz to 25 Hz",
    ]
    assert [words.split()[0] for words in outside({"amplitude": (1e-4, 1e-4)}, SEEN)] == ["amplitude"]


def test_places_have_room_for_a_share_of_the_whole_way():
    assert widened(SEEN)["preload"] == pytest.approx((-0.4e-3, 15.4e-3))
    assert widened(SEEN)["speed"][1] == pytest.approx(0.255)


def test_places_beside_zero_are_zero_and_one_place_is_told_once():
    seen = {"displacement": (-0.83e-6, 31.0016e-3), "preload": (2.5e-3, 2.5e-3)}
    filled = fill_numbers(read(HEAD), read(HEAD), {}, seen)
    assert "displacement: [0 mm, 31 mm]" in filled and "preload: [2.5 mm, 2.5 mm]" in filled
    assert read(filled).identified.told() == "displacement 0 mm to 31 mm, preload 2.5 mm"


def test_a_preload_about_zero_is_zero_beside_the_way_of_its_node():
    seen = {"displacement@a": (-1e-3, 1e-3), "preload@a": (-0.2467e-6, 0.2467e-6), "displacement": (-1e-6, 1e-6)}
    filled = fill_numbers(read(HEAD), read(HEAD), {}, seen | {"preload": (-0.2467e-6, 0.5e-6)})
    assert "preload@a: [0 mm, 0 mm]" in filled and "displacement: [-1 um, 1 um]" in filled
    assert "preload: [-0.247 um, 0.5 um]" in filled

"""``dashpot check`` on networks of the built-in elements."""

from __future__ import annotations

import json

import pytest

BAD = """format: dashpot-network/1
name: bad
branches:
  a: {elemnt: spring, stiffness: 3}
  b: {element: maxwel, stiffness: 3}
  c: {element: maxwell, stiffness: 3 mm, relaxation_time: 3 ms}
"""
SERIES = """format: dashpot-network/1
name: chain
branches:
  a: {series: {b: {element: spring, stiffness: 3}, c: {element: damper, damping: 3}}}
"""


@pytest.fixture
def file(tmp_path):
    def write(name, text):
        (tmp_path / name).write_text(text)
        return str(tmp_path / name)

    return write


def test_every_mistake_of_every_file_is_told_with_its_place(call, file):
    bad, series = file("bad.yaml", BAD), file("series.yaml", SERIES)
    code, out, err = call("check", bad, "kelvin_voigt", series)
    assert code == 1
    assert out.strip() == "kelvin_voigt: good"
    places = [line.removeprefix(f"{bad}:").split(": ")[0] for line in err.splitlines() if line.startswith(bad)]
    assert places == ["4:6", "4:7", "5:16", "6:36"]
    assert "did you mean 'element'?" in err and "did you mean 'maxwell'?" in err
    assert f"{series}:4:6: the branch 'a' is a series connection: its inner node cannot be solved yet" in err
    assert "Traceback" not in err


def test_what_is_found_can_be_read_by_a_program(call, file):
    code, out, _ = call("check", file("bad.yaml", BAD), "gehmann", "--json")
    found = json.loads(out)["specs"]
    assert code == 1
    assert [len(entry["problems"]) for entry in found] == [4, 0]


def test_every_shipped_network_is_good(call):
    from dashpot.model.shipped import shipped_networks

    code, out, _ = call("check", *shipped_networks())
    assert code == 0
    assert out.splitlines() == [f"{name}: good" for name in shipped_networks()]

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
TWINS = """format: dashpot-network/1
name: twins
branches:
  a: {element: damper, damping: {start: 3}}
  b: {element: damper, damping: {start: 4}}
"""
LOOSE = """format: dashpot-network/1
name: loose
nodes: {a: driven, b: ground, c: {mass: 3 kg}}
branches:
  x: {element: spring, stiffness: 3, between: [a, b]}
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
    assert out.splitlines() == ["kelvin_voigt: good", f"{series}: good"]
    places = [line.removeprefix(f"{bad}:").split(": ")[0] for line in err.splitlines() if line.startswith(bad)]
    assert places == ["4:6", "4:7", "5:16", "6:36"]
    assert "did you mean 'element'?" in err and "did you mean 'maxwell'?" in err
    assert "Traceback" not in err


def test_a_weakness_is_a_warning_and_no_mistake(call, file):
    twins = file("twins.yaml", TWINS)
    code, out, err = call("check", twins)
    assert (code, out.strip()) == (0, f"{twins}: good, with 1 warning")
    assert err.startswith(f"{twins}:5:33: warning: 'a.damping' and 'b.damping' cannot be distinguished")
    code, out, _ = call("check", twins, "--json")
    (problem,) = json.loads(out)["specs"][0]["problems"]
    assert code == 0 and problem["severity"] == "warning"


def test_a_loose_node_is_a_mistake(call, file):
    loose = file("loose.yaml", LOOSE)
    code, out, err = call("check", loose)
    assert (code, out) == (1, "")
    assert f"{loose}:3:34: nothing connects the node 'c'" in err


def test_two_networks_are_compared_by_structure(call):
    code, out, _ = call("check", "axle_model_3", "--against", "axle_model_3_top_mount")
    assert code == 0
    assert out.splitlines()[1:3] == [
        "axle_model_3 against axle_model_3_top_mount: the structures differ",
        "  'axle_model_3' has one damper more between wheel_left and body",
    ]
    assert "'axle_model_3_top_mount' has one node more, rod_left, which is free with mass" in out
    assert "'axle_model_3_top_mount' has one spring more between rod_left and body" in out


def test_networks_of_one_structure_are_compared_by_their_numbers(call, file):
    other = file("other.yaml", SERIES.replace("damping: 3}", "damping: 4}"))
    series = file("series.yaml", SERIES)
    code, out, _ = call("check", series, "--against", other, "--json")
    (found,) = json.loads(out)["against"]
    assert code == 0 and found["same_structure"]
    assert found["numbers"] == ["a.c.damping: 3 N*s/m in the first, 4 N*s/m in the second"]
    assert (
        call("check", series, "--against", series)[1]
        .splitlines()[1]
        .endswith("the same structure and the same parameters")
    )


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

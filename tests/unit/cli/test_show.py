"""``dashpot show``: a network as it is declared."""

from __future__ import annotations

import json

NETWORK = """\
format: dashpot-network/1
name: mount
about: a rubber mount
source: drawing 7
branches:
  rubber: {element: spring, stiffness: {start: 220 N/mm, bounds: [20 N/mm, 2 kN/mm]}}
  relaxation: {element: maxwell, stiffness: 60 N/mm, relaxation_time: {start: 160 ms}}
"""


def test_it_shows_what_is_declared(call, tmp_path):
    file = tmp_path / "mount.yaml"
    file.write_text(NETWORK)
    code, out, _ = call("show", file)
    assert code == 0
    lines = [line.split() for line in out.splitlines()]
    assert {"a rubber mount", "Source: drawing 7", f"File: {file}"} <= set(out.splitlines())
    [rubber] = [line for line in lines if line[:1] == ["rubber.stiffness"]]
    assert rubber[-5:] == ["220.0", "N/mm", "20.0", "2000", "free"]
    [fixed] = [line for line in lines if line[:1] == ["relaxation.stiffness"]]
    assert fixed[-5:] == ["60.00", "N/mm", "\N{EN DASH}", "\N{EN DASH}", "fixed"]
    assert "force over deflection" in " ".join(rubber) and "T \N{ALMOST EQUAL TO} 160 ms" in out


def test_what_turns_the_direction_of_writing_is_written_out(call, tmp_path):
    (tmp_path / "mount.yaml").write_text(NETWORK.replace("drawing 7", "drawing \u202e7"), encoding="utf-8")
    code, out, _ = call("show", tmp_path / "mount.yaml")
    assert code == 0 and r"Source: drawing \u202e7" in out.splitlines() and "\u202e" not in out


def test_numbers_for_programs_are_si(call, tmp_path):
    (tmp_path / "mount.yaml").write_text(NETWORK)
    content = json.loads(call("show", tmp_path / "mount.yaml", "--json")[1])
    rubber = content["parameters"][0]
    assert (rubber["path"], rubber["value"], rubber["unit"], rubber["bounds"]) == (
        "rubber.stiffness",
        220e3,
        "N/m",
        [20e3, 2e6],
    )


def test_models_are_the_networks_that_are_listed(call):
    assert call("list", "models") == call("list", "networks")

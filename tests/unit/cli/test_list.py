"""Each thing is listed with where it comes from; faulty plugins are named."""

from __future__ import annotations

import json

import pytest

pytestmark = pytest.mark.usefixtures("registry")


def test_a_thing_is_listed_with_its_distribution_plugin_and_purpose(call):
    code, out, _ = call("list", "optimizers")
    assert code == 0
    assert out == "swarm  dashpot 9.9, elements  A method with an option.\n"


def test_the_json_list_has_the_same_and_nothing_else_on_standard_output(call):
    code, out, error = call("list", "optimizers", "--json")
    origin = {"plugin": "elements", "distribution": "dashpot", "version": "9.9"}
    entry = {"word": "swarm", "origin": origin, "about": "A method with an option."}
    assert json.loads(out) == {"format": "dashpot-list/1", "optimizers": [entry]}
    assert "strange" in error


def test_a_faulty_plugin_is_shown_with_all_that_is_wrong(call):
    _, out, _ = call("list", "plugins")
    assert out.splitlines() == [
        "elements  dashpot 9.9, elements         swarm",
        "strange   dashpot-strange 0.3, strange  set aside: cannot be loaded: ImportError: no; set aside: gave 7",
    ]


def test_every_verb_warns_of_faulty_plugins_in_one_line(call):
    _, _, error = call("list", "elements")
    assert error == (
        "warning: set aside, at least in part: plugin strange (dashpot-strange 0.3). `dashpot list plugins` says why\n"
    )


@pytest.mark.parametrize("kind", ["elements", "causes", "formats", "specimens", "exports"])
def test_an_empty_list_says_that_no_plugin_gives_any(call, kind):
    assert call("list", kind)[1] == f"There are no {kind}: no plugin gives any.\n"


def test_a_network_that_the_plugins_at_hand_cannot_build_is_listed_with_the_reason(call):
    _, out, _ = call("list", "networks")
    line = next(line for line in out.splitlines() if line.startswith("kelvin_voigt"))
    assert "cannot be used: " in line and "there is no element 'spring'" in line


def test_networks_are_listed_family_by_family(call):
    _, out, _ = call("list", "networks")
    families = [line.split()[1] for line in out.splitlines()]
    assert families == sorted(families) and set(families) == {"axles", "mounts", "suspension", "tires"}
    listed = json.loads(call("list", "networks", "--json")[1])["networks"]
    assert set(listed[0]) == {"word", "family", "origin", "about"}


def test_a_bench_that_the_plugins_at_hand_cannot_build_is_listed_with_the_reason(call):
    _, out, _ = call("list", "rigs")
    line = next(line for line in out.splitlines() if line.startswith("tire_bench"))
    assert "cannot be used: " in line and "triangle" in line


def test_without_a_kind_everything_is_listed_under_headings(call):
    lines = call("list")[1].splitlines()
    kinds = (
        "elements",
        "networks",
        "optimizers",
        "causes",
        "formats",
        "specimens",
        "rigs",
        "studies",
        "exports",
        "plugins",
    )
    assert [line for line in lines if line in kinds] == list(kinds)

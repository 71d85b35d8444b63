"""``--json`` gives one object, alone on standard output, whose `format` says what it is."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[3] / "docs" / "reference" / "command-line.md").read_text(encoding="utf-8")
FORMATS = dict(re.findall(r"^\| `(\w+)` \| `(dashpot-[\w-]+/1)` \|", PAGE, flags=re.MULTILINE))

KEYS = {
    "list elements": {"elements"},
    "check gehmann": {"specs"},
    "check gehmann --against gehmann": {"specs", "against"},
    "show gehmann": {"network", "about", "source", "file", "parameters", "curves"},
    "draw gehmann": {"network", "file", "drawing"},
    "doctor": {"healthy", "findings"},
    "simulate n.yaml --rig triangle": {
        "network",
        "runs",
        "output",
        "numerical_error",
        "numerical_error_peak",
        "outside_of_identification",
        "metrics",
        "limited",
    },
}


@pytest.mark.parametrize("line, keys", KEYS.items(), ids=KEYS)
def test_the_result_is_one_object_with_a_format(call, tmp_path, monkeypatch, line, keys):
    monkeypatch.chdir(tmp_path)
    Path("n.yaml").write_text(
        "format: dashpot-network/1\nname: n\nbranches: {k: {element: spring, stiffness: 1 N/mm}}\n"
    )
    output = ["-o", "out"] if line.startswith("simulate") else []
    code, out, _ = call(*line.split(), "--json", *output)
    content = json.loads(out)
    assert code == 0
    assert content.keys() == {"format", *keys}
    assert content["format"] == FORMATS[line.split()[0]]


@pytest.mark.parametrize(
    "line, code, word",
    [
        ("fit nope.yaml data -o out --json", 1, "there is no such file"),
        ("fit spring --json", 2, "Missing argument 'DATASET'"),
        ("nope --json", 2, "No such verb 'nope'"),
    ],
)
def test_an_error_is_one_object_too(call, line, code, word):
    found, out, error = call(*line.split())
    content = json.loads(out)
    assert (found, content["exit_code"], content["format"]) == (code, code, "dashpot-error/1")
    [problem] = content["problems"]
    assert word in problem["message"] and word in error


def test_a_failed_check_is_one_object(call):
    code, out, error = call("check", "spring", "nope.yaml", "--json")
    assert code == 1 and "nope.yaml: there is no such file" in error
    assert [bool(spec["problems"]) for spec in json.loads(out)["specs"]] == [False, True]


def test_every_verb_with_json_has_a_documented_format():
    from dashpot.cli.shell import VERBS, dashpot

    verbs = {name: dashpot.get_command(None, name) for name in VERBS}
    telling = {name for name, verb in verbs.items() if any("--json" in option.opts for option in verb.params)}
    assert telling == FORMATS.keys()

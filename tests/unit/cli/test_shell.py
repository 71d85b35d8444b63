"""The command finds its verbs, and helps with words that it does not know."""

from __future__ import annotations

import re
import shlex

import click
import pytest

from dashpot import __version__
from dashpot.cli.shell import VERBS, dashpot


def test_help_names_every_verb(call):
    code, out, _ = call("--help")
    assert code == 0
    assert all(f"\n  {verb} " in out for verb in VERBS)
    assert "..." not in out.partition("Commands:")[2]  # no summary is cut


@pytest.mark.parametrize("verb", VERBS)
def test_the_help_of_a_verb_has_an_example(call, verb):
    code, out, _ = call(verb, "--help")
    assert code == 0
    assert re.search(rf"Example:\n    dashpot {verb}\b", out)


@pytest.mark.parametrize("verb", VERBS)
def test_the_examples_in_the_help_are_right(call, verb):
    lines = re.findall(r"^    (dashpot .+)$", call(verb, "--help")[1].partition("Example:")[2], re.MULTILINE)
    assert lines
    for line in lines:
        name, *arguments = shlex.split(line)[1:]
        command = dashpot.get_command(click.Context(dashpot), name)
        assert command is not None
        command.make_context(name, arguments)


def test_the_version_is_told(call):
    assert call("--version") == (0, f"dashpot, version {__version__}\n", "")


@pytest.mark.parametrize(
    "arguments, hint",
    [
        (["diagnoze"], "No such verb 'diagnoze', did you mean 'diagnose'?"),
        (["zzz"], f"No such verb 'zzz', there are: {', '.join(VERBS)}"),
        (["compare", "--ouput", "x"], "Did you mean '--output'?"),
        (["list", "elments"], "No list of 'elments', did you mean 'elements'?"),
        (["list", "zzz"], "No list of 'zzz', there are: elements, "),
        (["demo", "--seed", "-1"], "-1 is not in the range x>=0"),
        (["compare", "spring"], "Missing argument 'DATASET'"),
        (["fit", "spring"], "Missing argument 'DATASET'"),
    ],
)
def test_misuse_is_answered_with_the_nearest_known_word(call, arguments, hint):
    code, out, error = call(*arguments)
    assert (code, out) == (2, "")
    assert hint in error

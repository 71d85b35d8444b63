"""The command finds its verbs, and helps with words that it does not know."""

from __future__ import annotations

import pytest

from dashpot import __version__
from dashpot.cli.shell import VERBS


def test_help_names_every_verb(call):
    code, out, _ = call("--help")
    assert code == 0
    assert all(f"\n  {verb} " in out for verb in VERBS)


@pytest.mark.parametrize("verb", VERBS)
def test_the_help_of_a_verb_has_an_example(call, verb):
    code, out, _ = call(verb, "--help")
    assert code == 0
    assert f"Example:\n    dashpot {verb} " in out


def test_the_version_is_told(call):
    assert call("--version") == (0, f"dashpot, version {__version__}\n", "")


@pytest.mark.parametrize(
    "arguments, hint",
    [
        (["diagnoze"], "No such verb 'diagnoze', did you mean 'diagnose'?"),
        (["zzz"], "No such verb 'zzz', there are: demo, list, check, draw, simulate, fit, compare, diagnose"),
        (["compare", "--ouput", "x"], "Did you mean '--output'?"),
        (["list", "elments"], "No list of 'elments', did you mean 'elements'?"),
        (["list", "zzz"], "No list of 'zzz', there are: elements, "),
        (["demo", "--seed", "-1"], "-1 is not in the range x>=0"),
        (["compare", "spring"], "Missing option '--data'"),
        (["fit", "spring"], "Missing argument 'DATASET'"),
    ],
)
def test_misuse_is_answered_with_the_nearest_known_word(call, arguments, hint):
    code, out, error = call(*arguments)
    assert (code, out) == (2, "")
    assert hint in error

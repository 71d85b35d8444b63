"""What is said of structures that cannot be written, and of settings that cannot be followed."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

from unit.diagnose.rig import dataset

from dashpot.diagnose.diagnose import settings_in_words
from dashpot.diagnose.trials import refusals


def term(word):
    return SimpleNamespace(word=word)


def test_a_term_that_joins_alone_is_told_with_the_reason():
    known, new = term("friction"), term("delay")
    said = refusals([known], [known, new], "the force has a delay already")
    assert said == ["'delay' could not be written into the network: the force has a delay already"]


def test_of_a_term_in_the_place_of_another_nothing_is_said():
    """Without the valve the dependence on current, which changes its numbers, finds no branch: no fault of friction."""
    valve, current, friction = map(term, ("valve", "setting_dependence", "friction"))
    assert refusals([valve, current], [current, friction], "the network has no branch 'valve'") == []


def test_a_setting_in_words_is_told_where_runs_differ_in_it():
    """Numbers in their place may be followed; what is the same in all runs, or another word in each, says nothing."""
    made = dataset()
    words = [{"valve": ("soft", "hard")[k % 2], "oil": "new", "day": f"day {k}"} for k in range(len(made.runs))]
    runs = [replace(run, notes=note) for run, note in zip(made.runs, words, strict=True)]
    (said,) = settings_in_words(replace(made, runs=tuple(runs)))
    assert "'valve'" in said and "soft, hard" in said

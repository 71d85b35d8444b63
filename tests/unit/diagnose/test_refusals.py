"""What is said of settings that cannot be followed."""

from __future__ import annotations

from dataclasses import replace

from unit.diagnose.rig import dataset

from dashpot.diagnose.diagnose import settings_in_words


def test_a_setting_in_words_is_told_where_runs_differ_in_it():
    """Numbers in their place may be followed; what is the same in all runs, or another word in each, says nothing."""
    made = dataset()
    words = [{"valve": ("soft", "hard")[k % 2], "oil": "new", "day": f"day {k}"} for k in range(len(made.runs))]
    runs = [replace(run, notes=note) for run, note in zip(made.runs, words, strict=True)]
    (said,) = settings_in_words(replace(made, runs=tuple(runs)))
    assert "'valve'" in said and "soft, hard" in said

"""What is said of settings that cannot be followed, and of few runs."""

from __future__ import annotations

from dataclasses import replace

from unit.diagnose.rig import dataset

from dashpot.diagnose.diagnose import of_few_groups, settings_in_words


def test_a_setting_in_words_is_told_where_runs_differ_in_it():
    """Numbers in their place may be followed; what is the same in all runs, or another word in each, says nothing."""
    made = dataset()
    words = [{"valve": ("soft", "hard")[k % 2], "oil": "new", "day": f"day {k}"} for k in range(len(made.runs))]
    runs = [replace(run, notes=note) for run, note in zip(made.runs, words, strict=True)]
    (said,) = settings_in_words(replace(made, runs=tuple(runs)))
    assert "'valve'" in said and "soft, hard" in said


def test_few_independent_runs_are_told_and_that_three_name_nothing_beside_what_is_unexplained():
    """Three agree by chance in one of eight cases, more than the one of ten that may be wrong; four in one of 16."""
    assert of_few_groups(6) == []
    (unknown,) = of_few_groups(4)
    assert "With 4 independent training runs" in unknown
    assert of_few_groups(3)[1].startswith("So few agree by chance in one of 8 cases")
    assert "With 1 independent training run parts" in of_few_groups(1)[0] and len(of_few_groups(1)) == 2

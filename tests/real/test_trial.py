"""A trial with fewer runs learns from fewer runs; its kept outcome is that of the present engine, or is run again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from real import sets
from real.test_judge import made
from real.trial import Trial, engine_digest, is_current

import dashpot
from dashpot.fit.holdout import split_runs

RUNS, SAMPLES = 12, 200


@pytest.fixture
def measured(tmp_path, monkeypatch):
    """A set of a dozen sines in files of its own."""
    time = np.arange(SAMPLES) / 100.0
    (tmp_path / "sines").mkdir()
    for k in range(RUNS):
        x = (1.0 + k % 3) * np.sin(2.0 * np.pi * time)
        table = np.stack([time, x, 3.0 * x], axis=1)
        np.savetxt(tmp_path / "sines" / f"{k}.csv", table, delimiter=",", header="t,x,f", comments="")
    monkeypatch.setattr(sets, "SHARED", tmp_path)
    channels = sets.columns(("x", "mm"), ("f", "N"), time={"column": "t", "unit": "s"})
    entries = [{"name": f"r{k}", "file": f"{k}.csv"} for k in range(RUNS)]
    return sets.MeasuredSet("sines", "sines", "Sines", "", {"kind": "harmonic", "channels": channels}, lambda: entries)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_fifth_of_the_training_runs_is_removed_and_no_held_out_one(measured, tmp_path, seed):
    whole = dashpot.load_dataset(measured.write(tmp_path / "whole"), allow_outside=True)
    train = split_runs(whole, seed).train
    removed = Trial(measured, "kelvin_voigt", seed, True).removed()
    assert len(train) == 9 and len(set(removed)) == 2
    assert set(removed) < set(train)
    assert removed == Trial(measured, "kelvin_voigt", seed, True).removed()
    kept = dashpot.load_dataset(measured.write(tmp_path / "fewer", removed), allow_outside=True)
    assert {run.name for run in kept.runs} == {run.name for run in whole.runs} - set(removed)


def test_of_few_training_runs_one_is_removed(measured):
    few = replace(measured, runs=lambda: list(measured.runs())[:3])
    assert len(Trial(few, "kelvin_voigt", 0, True).removed()) == 1


def test_an_outcome_with_fewer_runs_that_does_not_tell_which_is_not_current():
    engine = engine_digest()
    assert is_current(engine, made()) and not is_current("", made())
    fewer = replace(made(), fewer=True)
    assert not is_current(engine, fewer) and is_current(engine, replace(fewer, removed=["a"]))

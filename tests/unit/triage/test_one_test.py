"""A test that comes again with its force to the last digit and other noise on its motion is one test."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.holdout import split_runs
from dashpot.triage.examine import examine

STEP = 2e-3
TIME = STEP * np.arange(3000)
SCATTER = 2e-6


def driven(name, seed, sensor, softer=0.0, **more):
    """A rig that prescribes the force by a seed: the motion of 200 N/mm and 1 N s/mm, and the scatter of its sensor."""
    spectrum = np.fft.rfft(np.random.default_rng(seed).standard_normal(TIME.size))
    frequency = np.fft.rfftfreq(TIME.size, STEP)
    spectrum[frequency > 12.0] = 0.0
    force = np.fft.irfft(spectrum, TIME.size)
    force *= 300.0 / np.std(force)
    way = np.fft.irfft(np.fft.rfft(force) / ((1.0 - softer) * 2e5 + 2j * np.pi * frequency * 1e3), TIME.size)
    way += SCATTER * np.random.default_rng(100 + sensor).standard_normal(TIME.size)
    force = force + 2.0 * np.random.default_rng(50 + seed).standard_normal(TIME.size)
    return Run(name, "random", TIME, {"displacement": way, "force": force}, group=name, **more)


def examined(*again):
    """Five forces, and some of them again."""
    return examine(Dataset("driven", (*(driven(f"r{seed}", seed, seed) for seed in range(5)), *again)))


def said(triage):
    return [remark for remark in triage.remarks if "one test" in remark]


def groups(triage):
    return {run.name: run.group for run in triage.dataset.runs}


def test_runs_of_other_forces_are_other_tests():
    assert said(examined()) == []


def test_a_force_that_comes_again_is_told_and_held_out_with_its_first_run():
    found = examined(driven("again", 1, 7), driven("once more", 1, 8, repeats="again"))
    assert found.faults == () and len(found.dataset.runs) == 7
    assert {groups(found)[name] for name in ("r1", "again", "once more")} == {"r1"}
    (remark,) = said(found)
    assert "'again' with 'r1'" in remark and "declare 'repeats', or remove a copy" in remark
    for seed in range(20):
        held_out = set(split_runs(found.dataset, seed).held_out)
        assert len(held_out & {"r1", "again", "once more"}) in (0, 3)


@pytest.mark.parametrize("softer", [0.02, 0.3])
def test_another_answer_to_the_same_force_is_another_test(softer):
    """The specimen is another one, or warmer."""
    found = examined(driven("again", 1, 7, softer))
    assert said(found) == [] and groups(found)["again"] == "again"


def test_computed_runs_differ_by_no_noise():
    first = driven("r1", 1, 1)
    assert said(examined(replace(first, name="again", group="again"))) == []


def test_an_accepted_run_is_used_as_it_is():
    found = examined(driven("again", 1, 7, accept=("triage",)))
    assert said(found) == [] and groups(found)["again"] == "again"


def test_a_dataset_that_holds_out_one_of_them_decides():
    found = examined(driven("again", 1, 7, held_out=True))
    assert groups(found)["again"] == "again" and split_runs(found.dataset).held_out == ("again",)
    (remark,) = said(found)
    assert "hold out both" in remark


def test_declared_repeats_are_not_told():
    assert said(examined(replace(driven("again", 1, 7), repeats="r1", group="r1"))) == []

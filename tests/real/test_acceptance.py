"""Diagnoses of measured sets keep to what their files say, accuse no rig, admit what they miss, and say it again.

Needs the sets; where they are not, all is skipped. ``REAL_RESULTS`` names a folder in which trials are kept.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from real import judge
from real.catalogue import SETS
from real.run import outcome, trials

import dashpot
from dashpot.fit.holdout import split_runs

pytestmark = pytest.mark.real

LEAST = 0.8
LEAST_NEAR = 0.45  # by the error alone; 0.8 is wanted
PRESENT = [
    pytest.param(name, marks=pytest.mark.skipif(not one.present, reason=f"{one.folder} is not here"))
    for name, one in SETS.items()
]


@pytest.fixture(scope="session")
def keep(tmp_path_factory):
    return Path(os.environ.get("REAL_RESULTS") or tmp_path_factory.mktemp("real")).resolve()


@pytest.fixture(scope="session")
def outcomes(keep):
    """All repetitions of a set by its name, each run once."""
    known = {}

    def of(name):
        if name not in known:
            known[name] = [outcome(trial, keep) for trial in trials(SETS[name])]
        return known[name]

    return of


@pytest.fixture(scope="session")
def all_outcomes(outcomes):
    found = [one for name, each in SETS.items() if each.present for one in outcomes(name)]
    if not found:
        pytest.skip("no measured set is here")
    return found


@pytest.mark.parametrize("name", PRESENT)
def test_every_seed_holds_out_other_runs(name, tmp_path):
    whole = dashpot.load_dataset(SETS[name].write(tmp_path), allow_outside=True)
    held_out = {split_runs(whole, seed).held_out for seed in SETS[name].seeds}
    assert len(held_out) == len(SETS[name].seeds)


@pytest.mark.parametrize("name", PRESENT)
def test_every_diagnosis_ends(name, outcomes):
    assert {one.failed for one in outcomes(name)} == {None}


@pytest.mark.parametrize("name", PRESENT)
def test_what_is_told_is_what_is_written(name, outcomes):
    for one in outcomes(name):
        assert one.told and judge.unlike(one) == {}, (one.base, one.seed, one.fewer)


@pytest.mark.parametrize("name", PRESENT)
def test_no_rig_is_accused_of_what_its_owners_do_not_know(name, outcomes):
    for one in outcomes(name):
        assert judge.accused(one, SETS[name].known_faults) == [], (one.base, one.seed, one.fewer)


def test_files_come_near_the_explainable_error_or_say_that_they_do_not(all_outcomes):
    good = [judge.near_or_admitted(one) for one in all_outcomes]
    near, admitted = (sum(map(of, all_outcomes)) for of in (judge.near, judge.admitted))
    assert sum(good) >= LEAST * len(good), f"of {len(good)} {near} near by the error alone, {admitted} admitted"


def test_files_come_near_the_explainable_error_by_the_error_alone(all_outcomes):
    near = [judge.near(one) for one in all_outcomes]
    assert sum(near) >= LEAST_NEAR * len(near), f"{sum(near)} of {len(near)}"


def test_names_come_again(all_outcomes):
    counts, named = judge.same_names(all_outcomes), judge.same_names(judge.naming(all_outcomes))
    assert judge.share(counts) >= LEAST, f"{counts}; where something is named {judge.share(named):.0%}"


def test_both_bases_come_to_the_same_names(all_outcomes):
    counts = judge.same_beyond_bases(all_outcomes)
    assert judge.share(counts) >= LEAST, counts

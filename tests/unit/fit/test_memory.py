"""Runs go through a fit one by one: the same numbers whatever stays prepared, and memory for a few of them only."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import kelvin_voigt, ready, run

from dashpot.fit import shelf
from dashpot.fit.linear import linearise
from dashpot.fit.shelf import Shelf
from dashpot.fit.uncertainty import assess_uncertainty

BRANCHES = """
    carcass: {element: spring, stiffness: {start: 200 N/mm}}
    rubber: {repeat: 4, element: maxwell, stiffness: {start: 8 N/mm}, relaxation_time: {start: 30 ms}}
    filler: {repeat: 4, element: prandtl, stiffness: {start: 9 N/mm}, limit: {start: 6 N}}
"""


def posed(count, jobs=1):
    rng = np.random.default_rng(seed_of("test_memory"))
    runs = [run(f"r{k}", 1e-3, rng.uniform(1.0, 20.0), kelvin_voigt, first=0) for k in range(count)]
    _, objective, coordinates = ready(BRANCHES, runs, jobs=jobs)
    return objective, coordinates


@pytest.fixture
def no_room(monkeypatch):
    monkeypatch.setattr(shelf, "ROOM", 0.0)


def test_what_is_prepared_anew_each_time_gives_the_same_numbers(no_room, monkeypatch):
    objective, coordinates = posed(3)
    anew = linearise(objective, coordinates, coordinates.start).gram, objective.losses(objective.network.start)
    monkeypatch.setattr(shelf, "ROOM", 1e9)
    objective, coordinates = posed(3)
    kept = linearise(objective, coordinates, coordinates.start).gram, objective.losses(objective.network.start)
    assert np.array_equal(anew[0], kept[0]) and np.array_equal(anew[1], kept[1])


def test_threads_do_not_change_a_bit():
    (one, coordinates), (two, _) = posed(5), posed(5, jobs=2)
    grams = [linearise(each, coordinates, coordinates.start).gram for each in (one, two)]
    assert np.array_equal(*grams)
    widths = [assess_uncertainty(each, coordinates, coordinates.start).widths for each in (one, two)]
    assert np.array_equal(*widths)


def peak(count, jobs):
    """Most bytes at once, of a linear step and of the standard errors."""
    objective, coordinates = posed(count, jobs)
    assess_uncertainty(objective, coordinates, coordinates.start)
    tracemalloc.start()
    linearise(objective, coordinates, coordinates.start)
    assess_uncertainty(objective, coordinates, coordinates.start)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return most


@pytest.mark.parametrize("jobs", [1, 2])
def test_memory_does_not_grow_with_the_number_of_runs(no_room, jobs):
    one_at_a_time = peak(12, 1)
    # each thread has one run in its hands, and one more is being added up, whatever threads do when
    assert peak(48, jobs) < (jobs + 1) * one_at_a_time


class Bytes(bytes):
    """So many bytes."""

    @property
    def nbytes(self):
        return len(self)


def test_the_first_are_kept_until_the_room_is_full(monkeypatch):
    monkeypatch.setattr(shelf, "ROOM", 25.0)
    made = []
    answers = Shelf()
    for size in (10, 20, 15, 10, 20, 15):
        assert len(answers("a", size, lambda size=size: made.append(size) or Bytes(size))) == size
    assert made == [10, 20, 15, 20]


def test_room_is_made_by_what_was_asked_for_longest_ago(monkeypatch):
    monkeypatch.setattr(shelf, "ROOM", 25.0)
    made = []
    answers = Shelf()
    for kind in "abacbab":
        answers(kind, 0, lambda kind=kind: made.append(kind) or Bytes(10))
    assert "".join(made) == "abcba"

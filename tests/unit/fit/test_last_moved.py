"""Rows of a Jacobian that are asked for again are not simulated again, and are the same to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.fit import last_moved
from dashpot.fit.last_moved import LastMoved

VALUES, MOVES = np.array([1.0, 2.0]), np.eye(2)


class Counted:
    """Rows of two runs that tell how often they were made."""

    def __init__(self):
        self.times = 0

    def __call__(self):
        self.times += 1
        return [(number, number + self.times * np.arange(12.0).reshape(3, 4)) for number in (4, 7)]


@pytest.fixture
def made():
    return Counted()


def asked(kept, values, moves, made):
    return [(number, rows.copy()) for number, rows in kept("team", values, moves, made)]


def test_the_same_rows_are_made_once_whatever_becomes_of_those_handed_out(made):
    kept = LastMoved(1)
    first = asked(kept, VALUES, MOVES, made)
    for _, rows in kept("team", VALUES, MOVES, made):
        rows *= 0.0
    again = asked(kept, VALUES, MOVES, made)
    assert made.times == 1
    for (number, rows), (other, others) in zip(first, again, strict=True):
        assert number == other and np.array_equal(rows, others)


def test_kept_rows_answer_for_the_first_of_their_moves(made):
    kept = LastMoved(1)
    whole = asked(kept, VALUES, MOVES, made)
    part = asked(kept, VALUES, MOVES[:1], made)
    assert made.times == 1
    for (_, rows), (_, others) in zip(whole, part, strict=True):
        assert np.array_equal(rows[:2], others)
    asked(LastMoved(1), VALUES, MOVES[:1], made)
    assert made.times == 2


@pytest.mark.parametrize("values, moves", [(VALUES + 1.0, MOVES), (VALUES, 2.0 * MOVES), (VALUES, np.eye(3, 2))])
def test_at_another_place_or_with_other_moves_they_are_made_anew(made, values, moves):
    kept = LastMoved(1)
    asked(kept, VALUES, MOVES, made)
    asked(kept, values, moves, made)
    assert made.times == 2


def test_what_takes_more_than_its_share_of_the_room_is_not_kept(made, monkeypatch):
    monkeypatch.setattr(last_moved, "ROOM", 2 * 12 * 8.0)
    roomy, narrow = LastMoved(1), LastMoved(2)
    for kept in (roomy, roomy, narrow, narrow):
        asked(kept, VALUES, MOVES, made)
    assert made.times == 1 + 2

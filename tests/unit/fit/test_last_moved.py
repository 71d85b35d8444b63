"""Rows of a Jacobian that are asked for again are not simulated again, and are the same to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.fit import last_moved
from dashpot.fit.last_moved import LastMoved

VALUES, MOVES = np.array([1.0, 2.0]), np.eye(2)


class Counted:
    """Rows of two runs, their residual and what each move adds, that tell how often they were made, and for what."""

    def __init__(self):
        self.times, self.moves = 0, []

    def __call__(self, moves):
        self.times += 1
        self.moves.append(len(moves))
        added = [np.full(4, self.times + move @ np.array([10.0, 100.0])) for move in moves]
        return [(number, number + np.array([np.zeros(4), *added])) for number in (4, 7)]


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


@pytest.mark.parametrize("values, moves", [(VALUES + 1.0, MOVES), (VALUES, 2.0 * MOVES), (VALUES, MOVES[::-1])])
def test_at_another_place_or_with_other_moves_they_are_made_anew(made, values, moves):
    kept = LastMoved(1)
    asked(kept, VALUES, MOVES, made)
    asked(kept, values, moves, made)
    assert made.times == 2


def test_of_more_moves_at_the_same_place_only_those_that_are_new_are_made(made):
    kept = LastMoved(1)
    first = asked(kept, VALUES, MOVES, made)
    more = np.vstack([MOVES, 3.0 * MOVES])
    whole = asked(kept, VALUES, more, made)
    other = asked(kept, VALUES, np.vstack([MOVES[:1], 5.0 * MOVES[:1]]), made)
    assert made.moves == [2, 2, 1]
    for (_, rows), (_, all_rows), (_, others) in zip(first, whole, other, strict=True):
        assert all_rows.shape == (5, 4) and np.array_equal(all_rows[:3], rows)
        assert all_rows[3:, 0] == pytest.approx(all_rows[0, 0] + 2.0 + np.array([30.0, 300.0]))
        assert np.array_equal(others[:2], rows[:2]) and others[2, 0] == pytest.approx(rows[0, 0] + 3.0 + 50.0)


def test_more_than_there_is_room_for_leaves_what_is_kept(made, monkeypatch):
    monkeypatch.setattr(last_moved, "ROOM", 2 * 12 * 8.0)
    kept = LastMoved(1)
    first = asked(kept, VALUES, MOVES, made)
    for _ in range(2):
        asked(kept, VALUES, np.vstack([MOVES, 3.0 * MOVES]), made)
    again = asked(kept, VALUES, MOVES, made)
    assert made.moves == [2, 2, 2] and np.array_equal(again[0][1], first[0][1])


def test_what_takes_more_than_its_share_of_the_room_is_not_kept(made, monkeypatch):
    monkeypatch.setattr(last_moved, "ROOM", 2 * 12 * 8.0)
    roomy, narrow = LastMoved(1), LastMoved(2)
    for kept in (roomy, roomy, narrow, narrow):
        asked(kept, VALUES, MOVES, made)
    assert made.times == 1 + 2

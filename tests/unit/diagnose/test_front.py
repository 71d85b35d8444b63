"""What is refitted beside structures of which terms are gone."""

from itertools import combinations
from types import SimpleNamespace

import numpy as np
import pytest
from unit.diagnose.synthetic import candidates_of

from dashpot.diagnose import front
from dashpot.diagnose.columns import Layout
from dashpot.diagnose.front import FORM_ERROR, Front, front_of


def test_what_is_known_beside_structures_keeps_to_its_room_and_comes_out_the_same(monkeypatch):
    rows = np.random.default_rng(1).standard_normal((3, 40, 200))
    grams = rows @ rows.transpose(0, 2, 1)
    owners = np.array([0, 0, 1, 2, 3, 3])

    def made():
        return Front(grams, grams.sum(axis=0), np.zeros((0, 40)), np.full(6, 100.0), owners, 3)

    room = 5 * made().beside(frozenset({0})).nbytes
    monkeypatch.setattr(front, "ROOM", room)
    asked, much = [frozenset(gone) for k in range(4) for gone in combinations(range(4), k)], made()
    for gone in [*asked, *asked[::-1]]:
        assert np.array_equal(whole(much.beside(gone)), whole(made().beside(gone)))
        assert sum(one.nbytes for one in much._known.values()) <= room
    assert list(much._known)[-5:] == asked[4::-1]  # what was asked for last
    assert len(much._known) < len(asked)


def whole(beside):
    """The whole Gram matrix of scaled columns."""
    every = np.arange(beside.front.scale.size)
    found = beside.gram.block(every, every)
    assert np.diag(found) == pytest.approx(beside.gram.diagonal)
    return found


def grams_of(rows):
    """The Gram matrices of groups, and their sum."""
    grams = [each @ each.T for each in rows]
    return grams, sum(grams)


def test_a_form_may_err_by_a_share_of_what_the_term_adds_to_the_base():
    """As much as before where the force of the term, and of its other forms, holds any amount of the base as well."""
    base, term, forms = 2, 3, slice(4, 6)  # the residual stands between base and term
    rows = np.random.default_rng(2).standard_normal((4, 6, 50))
    also = rows + np.einsum("cb,gbn->gcn", np.array([[0, 0]] * 3 + [[30, -20], [5, 0], [0, 40]]), rows[:, :base])
    candidates = candidates_of(["word"], 2)
    model = SimpleNamespace(terms=[SimpleNamespace(name=candidates[0].name, changes={""})])
    made, same = (
        front_of(*grams_of(each), np.zeros(0), base, Layout(0, 1, 2), model, candidates) for each in (rows, also)
    )
    assert same.precision == pytest.approx(made.precision, rel=1e-9)
    also[:, forms.start] = 7.0 * rows[:, 0]  # the base alone: rounding is no form
    alone = front_of(*grams_of(also), np.zeros(0), base, Layout(0, 1, 2), model, candidates)
    assert alone.precision == pytest.approx(made.precision[1:] / 2.0, rel=1e-9)
    flat = np.concatenate(rows, axis=1)
    left = flat - flat @ np.linalg.pinv(flat[:base]) @ flat[:base]
    squares = np.sum(left**2, axis=1)
    assert made.precision == pytest.approx(2.0 * squares[forms] / (FORM_ERROR**2 * squares[term]), rel=1e-9)


def test_a_column_that_the_base_makes_up_for_is_none_beside_anything():
    """What rounding leaves of it may be of any size beside what is left of others."""
    rng = np.random.default_rng(3)
    base, terms, bank = 2, 1, 4
    rows = rng.standard_normal((4, base + 1 + terms + bank, 50))
    made_up = base + 1 + terms + np.arange(2)
    rows[:, made_up] = 1e6 * np.einsum("cb,gbn->gcn", rng.standard_normal((2, base)), rows[:, :base])
    candidates = candidates_of(["word"], bank)
    model = SimpleNamespace(terms=[SimpleNamespace(name=candidates[0].name, changes={""})])
    found = front_of(*grams_of(rows), np.zeros(0), base, Layout(0, terms, bank), model, candidates)
    alone = front_of(
        *grams_of(np.delete(rows, made_up, axis=1)),
        np.zeros(0),
        base,
        Layout(0, terms, bank - 2),
        model,
        candidates_of(["word"], bank - 2),
    )
    for gone in (frozenset(), frozenset({0})):
        beside, expected = found.beside(gone), alone.beside(gone)
        gram, others = whole(beside), np.delete(np.arange(found.scale.size), made_up - base)
        assert gram[np.ix_(others, others)] == pytest.approx(whole(expected), rel=1e-6)
        assert not gram[made_up - base].any()

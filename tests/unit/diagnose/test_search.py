"""The search on looks whose structure is planted."""

from dataclasses import replace

import numpy as np
import pytest
from unit.diagnose.synthetic import candidates_of, look_of, random_rows

from dashpot.diagnose.score import Scores, Structure
from dashpot.diagnose.search import additions, search

WORDS = tuple("abcdefghij")
PLACES = 5


def found(rows, words=WORDS, **suspect):
    """Words and places of the best structure."""
    look = look_of(rows, candidates_of(words, PLACES, **suspect))
    best = search(Scores(look))[0]
    return {(look.candidates[k].cause.word, place) for k, places in best.added for place in places}


@pytest.mark.parametrize("seed", range(5))
def test_what_is_planted_is_found(seed):
    rows = random_rows(len(WORDS) * PLACES, {7: 0.6, 33: 0.4}, seed)
    assert found(rows) == {("b", 2), ("g", 3)}


@pytest.mark.parametrize("seed", range(3))
def test_two_places_of_one_form_are_found_together(seed):
    rows = random_rows(len(WORDS) * PLACES, {11: 0.6, 14: 0.5}, seed)
    assert found(rows, most=2) == {("c", 1), ("c", 4)}


def test_columns_that_act_together_are_fitted_together():
    rows = random_rows(len(WORDS) * PLACES, {10: 0.3, 11: 0.3, 12: 0.3, 13: 0.3, 14: 0.3})
    assert {word for word, _ in found(rows, joint=True)} == {"c"}


def test_the_order_of_the_plugins_does_not_matter():
    rows = random_rows(len(WORDS) * PLACES, {7: 0.6, 33: 0.4})
    order = np.random.default_rng(1).permutation(len(WORDS))
    columns = np.concatenate([[0], *(1 + PLACES * k + np.arange(PLACES) for k in order)])
    shuffled = {group: each[columns] for group, each in rows.items()}
    assert found(shuffled, [WORDS[k] for k in order]) == found(rows)


def test_noise_names_nothing():
    """One in a hundred data sets may raise a false alarm: of 40, more than three with P = 8e-4."""
    alarms = sum(bool(found(random_rows(len(WORDS) * PLACES, {}, 100 + seed))) for seed in range(40))
    assert alarms <= 3


def test_a_fault_of_the_rig_has_to_explain_more_than_a_law():
    """An effect that just passes as a law of the specimen is not enough to blame the rig."""
    sizes = [size for size in np.linspace(0.05, 0.3, 26) if found(random_rows(50, {7: size})) == {("b", 2)}]
    blamed = [
        size
        for size in np.linspace(0.05, 0.3, 26)
        if found(random_rows(50, {7: size}), kind="measurement") == {("b", 2)}
    ]
    assert sizes and blamed and min(blamed) > min(sizes)


def test_the_wrong_sign_is_never_found():
    rows = random_rows(len(WORDS) * PLACES, {7: -0.6})
    assert found(rows, sign=1) == set()
    assert found(rows, sign=0) == {("b", 2)}


def test_the_present_structure_is_among_those_that_were_scored():
    look = look_of(random_rows(10, {}), candidates_of(WORDS[:2], PLACES))
    assert Structure() in search(Scores(look))


def test_candidates_that_are_left_out_do_not_join():
    """Other causes in the place of one: the same look without the candidates of that cause."""
    look = look_of(random_rows(10, {2: 0.5, 7: 0.5}), candidates_of(WORDS[:2], PLACES))
    others = Scores(replace(look, candidates=look.candidates[1:]))
    names = {others.look.candidates[k].cause.word for one in search(others) for k, _ in one.added}
    assert names == {"b"}


@pytest.mark.parametrize(("dependent", "together"), [(("oil.damping",) * PLACES, False), ((), True)])
def test_a_number_follows_one_thing_only(dependent, together):
    """What two forms would make of one number: whichever is taken, nothing that was scored has the other one."""
    look = look_of(
        random_rows(2 * PLACES, {2: 0.6, 7: 0.5}), candidates_of(WORDS[:2], PLACES, dependent=dependent, most=2)
    )
    ranked = search(Scores(look))
    assert any(len(one.added) == 2 for one in ranked) == together
    assert len(ranked[0].added) == 1 + together


def test_forms_that_are_the_same_to_first_order_are_proposed_once():
    """A line and an exponential: the first one, so that there is room for what is another law."""
    rows = random_rows(3 * PLACES, {2: 0.6, 12: 0.3})
    for each in rows.values():
        each[1 + PLACES : 1 + 2 * PLACES] = each[1 : 1 + PLACES]
    line, exponential, other = candidates_of(WORDS[:3], PLACES)
    same = (line, replace(exponential, cause=line.cause), other)
    proposed = additions(Scores(look_of(rows, same)), Structure())
    assert [one.candidate for one in proposed] == [0, 2]
    assert [one.candidate for one in additions(Scores(look_of(rows, (line, exponential, other))), Structure())][:2] == [
        0,
        1,
    ]

"""The score of a structure against refits of the linear model by plain least squares."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import norm
from unit.diagnose.synthetic import GROUPS, candidates_of, look_of, random_rows

from dashpot.diagnose.odds import FALSE_ALARMS, RIG_ODDS, Odds
from dashpot.diagnose.score import Added, Scores, Structure, nats

WORDS = ("one", "two", "three")


def scores_of(strengths, places=2, seed=0, **suspect):
    rows = random_rows(places * len(WORDS), strengths, seed)
    return Scores(look_of(rows, candidates_of(WORDS, places, **suspect))), rows


def joined(*places):
    """A structure of columns of the first, second, ... candidate."""
    return Structure(added=frozenset(Added(k, at) for k, at in enumerate(places) if at))


@pytest.mark.parametrize("places", [((0,), ()), ((0, 1), (1,)), ((), (0, 1))])
def test_each_group_is_predicted_by_a_fit_to_the_others(places):
    """All groups once more, weighing a sixth together, tie down what the others do not tell."""
    scores, rows = scores_of({0: 0.5, 3: -0.7}, sign=0)
    found = scores.predicted(joined(*places))
    at = [1 + 2 * k + place for k, mine in enumerate(places) for place in mine]
    tie = 1.0 / GROUPS
    for number, group in enumerate(rows):
        weights = {name: np.sqrt(tie + (name != group)) for name in rows}
        design = np.concatenate([weights[name] * each[at].T for name, each in rows.items()])
        target = np.concatenate([weights[name] * each[0] for name, each in rows.items()])
        strengths = np.linalg.lstsq(design, target, rcond=None)[0]
        left = rows[group][0] - strengths @ rows[group][at]
        assert found[0][number] == pytest.approx(np.mean(left**2), rel=1e-4)
    assert found[1] == 0.0


def test_strengths_are_those_of_least_squares_in_the_units_of_the_columns():
    scores, rows = scores_of({0: 0.5, 3: -0.7})
    scaled = {name: each * np.array([1, 1e3, 1, 1, 1e-3, 1, 1])[:, None] for name, each in rows.items()}
    scores = Scores(look_of(scaled, candidates_of(WORDS, 2)))
    everything = np.concatenate(list(scaled.values()), axis=1)
    expected = np.linalg.lstsq(everything[[1, 4]].T, everything[0], rcond=None)[0]
    assert scores.strengths(joined((0,), (1,))) == pytest.approx(expected, rel=1e-4)


def test_the_score_is_the_log_likelihood_and_the_prior():
    scores, _ = scores_of({0: 0.5})
    structure = joined((0,))
    squares = scores.predicted(structure)[0]
    likelihood = 0.5 * GROUPS * 200 * np.log(np.mean(squares))
    # its form has a strength and one number more
    prior = np.log(6 / FALSE_ALARMS) + np.log(10.0)
    assert scores.score(structure) == pytest.approx(likelihood + prior)


def test_groups_count_by_their_samples_under_one_variance():
    """The likelihood of normal residuals at its maximum, by the residuals themselves."""
    rng = np.random.default_rng(0)
    left = [rng.normal(scale=scale, size=size) for scale, size in ((1.0, 10), (3.0, 200), (0.2, 50))]
    squares, samples = np.array([np.mean(each**2) for each in left]), np.array([each.size for each in left])
    whole = np.concatenate(left)
    density = norm.logpdf(whole, scale=np.sqrt(np.mean(whole**2))).sum()
    assert nats(squares, samples) == pytest.approx(-density - 0.5 * whole.size * (1.0 + np.log(2.0 * np.pi)))
    both = nats(squares, np.array([samples, 2.0 * samples]))
    assert both == pytest.approx([nats(squares, samples), 2.0 * nats(squares, samples)])


def test_a_strength_of_the_wrong_sign_is_not_admitted():
    scores, _ = scores_of({0: 0.5, 3: -0.7}, sign=1)
    assert scores.admitted(joined((0,))) and np.isfinite(scores.score(joined((0,))))
    assert not scores.admitted(joined((), (1,))) and scores.score(joined((), (1,))) == np.inf
    free, _ = scores_of({0: 0.5, 3: -0.7}, sign=0)
    assert free.admitted(joined((), (1,)))


def test_what_only_one_group_has_does_not_predict():
    """Two strengths of opposite sense in two groups: on all of them together they explain nothing elsewhere."""
    rows = random_rows(6, {})
    for group, size in (("g0", 1.0), ("g1", -1.0)):
        rows[group][0] += size * rows[group][1]
    scores = Scores(look_of(rows, candidates_of(WORDS, 2, sign=0)))
    assert scores.score(joined((0,))) > scores.score(Structure())


def test_the_rig_has_to_be_a_hundred_times_as_likely_as_a_law():
    assert Odds(50).price("specimen") == pytest.approx(np.log(50 / 0.01))
    assert Odds(50).price("measurement") - Odds(50).price("specimen") == pytest.approx(-np.log(RIG_ODDS))
    assert Odds(0).price("specimen") == pytest.approx(np.log(100.0))


def test_a_law_with_a_number_more_has_to_be_ten_times_as_likely():
    assert Odds(50).price("specimen", 3) - Odds(50).price("specimen", 1) == pytest.approx(2.0 * np.log(10.0))
    assert Odds(50).price("specimen", 0) == Odds(50).price("specimen")


def test_where_something_is_missing_for_certain_the_first_cause_is_told_from_the_others_only():
    """Nothing is hidden in none of such datasets: that one in a hundred would name a cause by chance says nothing."""
    usual, certain = Odds(50), Odds(50, missing=True)
    assert certain.of_any(0) == usual.of_any(0) == usual.of_any(2) == 0.0
    assert certain.price("specimen") + certain.of_any(1) == pytest.approx(np.log(50))
    assert 2.0 * certain.price("specimen") + certain.of_any(2) == pytest.approx(np.log(50) + np.log(50 / 0.01))


def test_a_structure_costs_less_only_by_its_first_cause():
    look = look_of(random_rows(20, {}), candidates_of("ab", 10))
    alone = Structure(added=frozenset({Added(0, (1,))}))
    both = Structure(added=frozenset({Added(0, (1,)), Added(1, (2,))}))
    usual, certain = Scores(look), Scores(replace(look, odds=replace(look.odds, missing=True)))
    for structure in (alone, both):
        assert usual.price(structure) - certain.price(structure) == pytest.approx(-np.log(FALSE_ALARMS))

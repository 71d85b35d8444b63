"""The linear step to a structure, against bounded least squares of all columns by a library."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import lsq_linear
from unit.diagnose.synthetic import GROUPS, LENGTH, candidates_of, look_of, random_rows

from dashpot.diagnose.columns import Layout
from dashpot.diagnose.front import front_of
from dashpot.diagnose.linear_step import Added, LinearStep, Structure

WORDS = ("one", "two", "three")


@pytest.fixture
def positive():
    """Rows (residual, a term's number, six candidates) of six groups, and three numbers of the base before them.

    All numbers are positive; the residual wants most of them to lose more than all of themselves.
    """
    rng = np.random.default_rng(3)
    groups = [rng.standard_normal((11, LENGTH)) for _ in range(GROUPS)]
    mixed = 0.4 * rng.standard_normal((11, 11)) + np.eye(11)
    groups = [mixed @ each for each in groups]
    for each in groups:
        each[3] = -3.0 * each[0] + 0.5 * each[1] - 2.0 * each[2] - 2.5 * each[4] + 1.5 * each[5] + each[3]
    return groups


def bounded_look(groups):
    """The look at these rows, the base where it is best."""
    whole = np.concatenate(groups, axis=1)
    best = np.linalg.lstsq(whole[:3].T, whole[3], rcond=None)[0]
    for each in groups:
        each[3] -= best @ each[:3]
    model = SimpleNamespace(
        terms=(),
        coordinates=SimpleNamespace(paths=("own", "a", "b", "c")),
        strengths=np.ones(4, bool),
        owned=(),
        point=np.zeros(4),
    )
    layout, candidates = Layout(1, 0, 6), candidates_of(WORDS, 2, sign=0)
    grams = np.array([each @ each.T for each in groups])
    front = front_of(grams, np.zeros(0), 3, layout, model, candidates, np.arange(3))
    plain = look_of(random_rows(6, {}), candidates)
    samples, numbers = np.full(GROUPS, float(LENGTH)), {"own": np.array([0]), "base": np.array([1, 2, 3])}
    return replace(plain, model=model, layout=layout, front=front, samples=samples, positive=np.arange(3), **numbers)


@pytest.mark.parametrize("places", [((0,), ()), ((0, 1), (1,)), ((1,), (0,), (0, 1))])
def test_a_positive_number_loses_no_more_than_all_of_itself(positive, places):
    """What a bounded least-squares fit of all columns says, with the standard deviation of a number known before."""
    step = LinearStep(bounded_look(positive))
    structure = Structure(added=frozenset(Added(k, at) for k, at in enumerate(places) if at))
    whole = np.concatenate(positive, axis=1)
    at = [5 + 2 * k + place for k, mine in enumerate(places) for place in mine]
    columns = whole[[0, 1, 2, 4, *at]].T
    known = np.zeros((1, columns.shape[1]))
    known[0, 3] = 1.0
    lowest = [-1.0] * 4 + [-np.inf] * len(at)
    expected = lsq_linear(np.vstack([columns, known]), np.append(whole[3], 0.0), (lowest, np.inf), tol=1e-14).x
    free = np.linalg.lstsq(columns, whole[3], rcond=None)[0]
    assert (free[:4] < -1.0).any() and (expected[:4] < -0.999).any()
    assert step.moves(structure)[[1, 2, 3, 0]] == pytest.approx(expected[:4], abs=2e-4)
    assert step.strengths(structure)[1:] == pytest.approx(expected[4:], abs=2e-4)
    left = whole[3] - expected @ columns.T
    fit = step.fit(structure)
    groups = step.look.front.groups(fit.rest[:, None] * step.scale[0] / step.scale[:, None])
    assert groups.sum() == pytest.approx(left @ left, rel=1e-4)

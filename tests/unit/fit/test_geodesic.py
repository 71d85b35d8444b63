"""Bent steps follow a bent valley farther than straight ones."""

from __future__ import annotations

import numpy as np
import pytest
from unit.fit.bench import ready, runs
from unit.fit.test_refine import BentValley

from dashpot.fit.geodesic import bent_steps
from dashpot.fit.linear import linearise
from dashpot.fit.refine import Outcome, refine

CIRCLE = """
    a: {element: spring, stiffness: {start: 999.8, bounds: [1, 1e6]}}
    b: {element: damper, damping: {start: 20, bounds: [1, 1e6]}}
"""


class Misfit(BentValley):
    """A misfit beside it that no number changes, so that the loss hardly falls along the valley."""

    def residual(self, values):
        around = super().residual(values)
        return np.vstack([around, np.full((1, around.shape[1]), 0.3)])


def test_a_bent_step_stays_in_the_valley_where_a_straight_one_leaves_it():
    _, _, coordinates = ready(CIRCLE, runs())
    valley, point = BentValley(), np.log([999.0, 44.7])
    linear = linearise(valley, coordinates, point)
    damping = 1e-2
    straight = point + np.array([[0.0, 0.5]])
    bent = bent_steps(valley, linear, coordinates, point, straight, [damping])
    before, after = (valley.losses(coordinates.to_values(np.vstack([point, end]))) for end in (straight, bent))
    away, less = (abs(valley.residual(coordinates.to_values(end))[0, 0]) for end in (straight, bent))
    assert less < 0.5 * away
    assert after[1] < before[1]


def test_a_number_at_its_bound_stays_there():
    _, _, coordinates = ready(CIRCLE, runs())
    point = np.log([999.0, 44.7])
    linear = linearise(BentValley(), coordinates, point)
    straight = np.array([[coordinates.low[0], point[1]]])
    bent = bent_steps(BentValley(), linear, coordinates, point, straight, [0.0])
    assert bent[0, 0] == coordinates.low[0]


def test_a_walk_that_hardly_falls_comes_to_the_end_of_the_valley():
    _, _, coordinates = ready(CIRCLE, runs())
    found = refine(Misfit(), coordinates, coordinates.start, steps=250)
    a, b = np.exp(found.point)
    assert found.outcome is Outcome.CONVERGED
    assert np.arctan2(b, a) > 1.4  # with straight steps alone 400 of them lead to 1.25


@pytest.mark.parametrize("budget", range(60, 400, 40))
def test_budgets_hold_where_steps_are_bent(budget):
    _, _, coordinates = ready(CIRCLE, runs())
    found = refine(Misfit(), coordinates, coordinates.start, steps=120, budget=budget)
    assert found.outcome is Outcome.BUDGET_SPENT
    assert found.evaluations <= budget

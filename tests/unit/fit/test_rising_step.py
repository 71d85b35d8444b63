"""Steps that keep the order of knots; truth: a general solver of quadratic programmes that shares nothing with them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize
from seeds import seed_of

from dashpot.fit.bounded_step import least_within
from dashpot.fit.rising_step import rising_step

FAR = 10.0
KNOTS = [0, 1, 2, 3, 4]


def problem(rng):
    """A quadratic with eight numbers, of which the first five are knots in order, and the sizes of their steps."""
    rows = rng.standard_normal((20, 8))
    at = rng.standard_normal(8)
    at[KNOTS] = np.sort(at[KNOTS])
    return rows.T @ rows, 30.0 * rng.standard_normal(8), at, rng.uniform(0.2, 3.0, 8)


def in_order(matrix, right, at, size):
    """The least value that a sequential quadratic programme finds with the order as linear constraints."""
    falls = np.zeros((4, 8))
    falls[range(4), range(1, 5)], falls[range(4), range(4)] = size[1:5], -size[:4]
    order = {"type": "ineq", "fun": lambda s: falls @ s + np.diff(at[KNOTS]), "jac": lambda s: falls}
    found = minimize(
        lambda s: 0.5 * s @ matrix @ s - right @ s,
        np.zeros(8),
        jac=lambda s: matrix @ s - right,
        method="SLSQP",
        constraints=[order],
        options={"ftol": 1e-12, "maxiter": 500},
    )
    return found.fun


@pytest.mark.parametrize("number", range(20))
def test_the_step_is_the_best_one_that_keeps_the_order(number):
    matrix, right, at, size = problem(np.random.default_rng([seed_of("rising step"), number]))
    low, high = (np.sign(side) * np.inf * np.ones(8) for side in (-1.0, 1.0))
    step = rising_step(least_within, matrix, right, (low, high), (at, size), [KNOTS])
    assert (np.diff((at + step * size)[KNOTS]) > -1e-9).all()
    value = 0.5 * step @ matrix @ step - right @ step
    assert value == pytest.approx(in_order(matrix, right, at, size), abs=1e-6 * abs(value))
    free = np.linalg.solve(matrix, right)
    if (np.diff((at + free * size)[KNOTS]) > 0.0).all():
        assert step == pytest.approx(free, rel=1e-9)


def test_some_of_these_steps_would_not_keep_it():
    seed, lost = seed_of("rising step"), 0
    for number in range(20):
        matrix, right, at, size = problem(np.random.default_rng([seed, number]))
        lost += bool((np.diff((at + np.linalg.solve(matrix, right) * size)[KNOTS]) < 0.0).any())
    assert lost > 10


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_the_limit_of_the_nearer_end_is_kept(side):
    at, size = np.array([1.0, 2.0, 3.0]) - (0.5 if side < 0.0 else 3.5), np.ones(3)
    # all are drawn past zero, beyond which they must not go; the middle one past its neighbour
    low, high = (np.zeros(3) - at, np.full(3, 50.0)) if side < 0.0 else (np.full(3, -50.0), np.zeros(3) - at)
    pull = side * np.array([9.0, 30.0, 9.0])
    step = rising_step(least_within, np.eye(3), pull, (low, high), (at, size), [[0, 1, 2]])
    assert at + step == pytest.approx(np.zeros(3), abs=1e-9)

"""The least of a quadratic model within limits."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from scipy.optimize import lsq_linear
from seeds import seed_of

from dashpot.fit import bounded_step
from dashpot.fit.bounded_step import least_within


def least_by_trying(matrix, right, low, high):
    """The least cost over all ways to hold numbers at a limit, the others at their stationary point."""
    costs = []
    for held in product((None, 0, 1), repeat=right.size):
        free = np.array([side is None for side in held])
        step = np.array([0.0 if side is None else (low, high)[side][k] for k, side in enumerate(held)])
        rest = right[free] - matrix[np.ix_(free, ~free)] @ step[~free]
        step[free] = np.linalg.solve(matrix[np.ix_(free, free)], rest)
        if np.all((step >= low - 1e-9) & (step <= high + 1e-9)):
            costs.append(0.5 * step @ matrix @ step - right @ step)
    return min(costs)


def test_a_step_within_limits_is_the_best_one():
    rng = np.random.default_rng(seed_of("steps within limits"))
    for _ in range(60):
        rows = rng.normal(size=(6, 4)) * 10.0 ** rng.uniform(-1.5, 0.0, 4)
        matrix, right = rows.T @ rows, rows.T @ rng.normal(size=6)
        low, high = -rng.uniform(0.0, 1.0, 4), rng.uniform(0.0, 1.0, 4)
        step = least_within(matrix, right, low, high)
        assert np.all((step >= low) & (step <= high))
        cost = 0.5 * step @ matrix @ step - right @ step
        assert cost == pytest.approx(least_by_trying(matrix, right, low, high), rel=1e-8, abs=1e-12)


def test_a_direction_without_influence_is_not_walked():
    rows = np.array([[1.0, 1.0]])
    step = least_within(rows.T @ rows, np.array([1.0, 1.0]), np.full(2, -np.inf), np.full(2, np.inf))
    assert step == pytest.approx([0.5, 0.5], rel=1e-9)


@pytest.mark.parametrize("size", [1, 8, 42])
def test_many_numbers_at_limits_are_those_of_the_library(monkeypatch, size):
    rng = np.random.default_rng(seed_of(f"steps of {size} numbers"))
    monkeypatch.setattr(bounded_step, "_by_library", None)
    for _ in range(30):
        rows = rng.normal(size=(2 * size, size)) @ np.diag(10.0 ** rng.uniform(-2.0, 0.0, size))
        aim = rng.normal(size=2 * size)
        low, high = -rng.exponential(size=size), rng.exponential(size=size)
        low[rng.random(size) < 0.2], high[rng.random(size) < 0.2] = -np.inf, 0.0
        step = least_within(rows.T @ rows, rows.T @ aim, low, high)
        assert np.all((step >= low) & (step <= high))
        best = lsq_linear(rows, aim, (low, np.maximum(high, np.nextafter(low, np.inf))), "bvls").x
        assert np.linalg.norm(rows @ (step - best)) <= 1e-8 * np.linalg.norm(aim)


def test_a_step_along_what_is_not_felt_is_left_to_the_library():
    rows = np.array([[1.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    aim = np.array([2.0, 3.0])
    step = least_within(rows.T @ rows, rows.T @ aim, np.full(3, -1.0), np.full(3, 0.5))
    assert step == pytest.approx([0.5, 0.5, 0.5])

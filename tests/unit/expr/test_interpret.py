"""Interpreting a graph is running the same numpy code."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.expr.interpret import Recipe, interpret
from dashpot.expr.node import constant, symbol, table

X, Y = symbol("x"), symbol("y")


def law(x, y):
    side = np.where(x < y, -1.0, 1.0)
    return side * np.tanh(x / y) + np.minimum(np.exp(-np.abs(x)), np.sqrt(y)) ** 2.0 - np.clip(x, -0.1, 0.2)


def test_the_traced_law_gives_bitwise_what_the_law_gives():
    rng = np.random.default_rng(seed_of("test_interpret"))
    x, y = rng.standard_normal(100), rng.uniform(0.1, 2.0, 100)
    assert np.array_equal(interpret([law(X, Y)], {"x": x, "y": y})[0], law(x, y))


def test_arrays_broadcast():
    (found,) = interpret([X + Y], {"x": np.arange(3.0)[:, None], "y": np.arange(4.0)})
    assert found.shape == (3, 4)


def test_all_roots_are_answered_in_order():
    assert interpret([X, constant(2.0), X * Y], {"x": 3.0, "y": 5.0}) == [3.0, 2.0, 15.0]


def test_a_table_is_looked_up():
    assert interpret([table("curve", 2.0 * X)], {"x": 3.0}, {"curve": lambda x, order: 10.0 * x + order}) == [60.0]


def test_a_recipe_forgets_what_it_was_used_for():
    recipe = Recipe([law(X, Y), table("curve", X)])
    first = recipe({"x": 0.3, "y": 2.0}, {"curve": lambda x, order: x})
    assert recipe({"x": 0.1, "y": 3.0}, {"curve": lambda x, order: -x}) == [law(0.1, 3.0), -0.1]
    assert recipe({"x": 0.3, "y": 2.0}, {"curve": lambda x, order: x}) == first == [law(0.3, 2.0), 0.3]


@pytest.mark.parametrize(("root", "missing"), [(X + Y, "y"), (table("curve", X), "curve")])
def test_a_value_that_is_missing_is_named(root, missing):
    with pytest.raises(KeyError, match=missing):
        interpret([root], {"x": 1.0})


def test_no_warning_disturbs_who_computes_with_infinity():
    with np.errstate(all="raise"):
        assert np.isinf(interpret([1.0 / X], {"x": np.float64(0.0)})[0])

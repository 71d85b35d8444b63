"""Tangents are the slopes of what they were derived from."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import wrightomega

from dashpot.expr.derive import derive
from dashpot.expr.interpret import interpret
from dashpot.expr.node import constant, symbol, table

X, Y = symbol("x"), symbol("y")

SMOOTH = {
    "sum": X + Y * X - 3.0,
    "product": X * X * Y,
    "quotient": Y / (2.0 + X * X),
    "power": (2.0 + X * X) ** Y,
    "constant base": constant(2.0) ** X,
    "exp": np.exp(-X * Y),
    "expm1": np.expm1(X / 3.0),
    "log": np.log(3.0 + X * X) + np.log1p(X * X),
    "sqrt": np.sqrt(4.0 + X * Y),
    "tanh": np.tanh(X * Y),
    "waves": np.sin(X) * np.cos(X * Y),
    "omega": wrightomega(X * Y - 1.0),
    "chosen": np.where(Y > 0.0, np.exp(X), X**3.0),
    "with conditions on x": np.where(X < 100.0, X * X, X) * np.where((X > -100.0) & (X < 99.0), 2.0, 3.0),
    "stepwise": np.sign(X + 50.0) * X,
}


def value(node, x, y=0.7):
    return interpret([node], {"x": np.float64(x), "y": np.float64(y)})[0]


@pytest.mark.parametrize("name", SMOOTH)
@given(x=st.floats(-1.5, 1.5), y=st.floats(0.1, 2.0))
def test_a_tangent_is_the_slope(name, x, y):
    node, step = SMOOTH[name], 1e-3
    near = [value(node, x + shift * step, y) for shift in (-2, -1, 1, 2)]
    slope = (near[0] - 8.0 * near[1] + 8.0 * near[2] - near[3]) / (12.0 * step)
    assert value(derive(node, "x"), x, y) == pytest.approx(slope, rel=1e-7, abs=1e-9)


@pytest.mark.parametrize(
    ("node", "expected"),
    [
        (np.abs(X), 1.0),
        (np.abs(-X), 1.0),
        (np.abs(3.0 * X), 3.0),
        (np.maximum(X, 0.0), 1.0),
        (np.minimum(X, 0.0), 0.0),
        (np.maximum(X, 2.0 * X), 2.0),
        (np.minimum(-X, 0.5 * X), -1.0),
        (np.minimum(X, 0.0) + np.maximum(X, 0.0), 1.0),
        (np.where(X < 0.0, -1.0, 1.0) * np.abs(X), 1.0),
        (np.clip(X, -1.0, 1.0), 1.0),
    ],
)
def test_at_a_kink_the_tangent_is_the_slope_to_the_right(node, expected):
    assert value(derive(node, "x"), 0.0) == expected


@pytest.mark.parametrize("node", [np.abs(X), np.maximum(X, 1.0), np.minimum(X, -1.0), np.clip(X, -1.0, 1.0)])
@pytest.mark.parametrize("x", [-3.0, -0.4, 0.6, 2.5])
def test_beside_a_kink_the_tangent_is_the_slope(node, x):
    slope = (value(node, x + 1e-4) - value(node, x - 1e-4)) / 2e-4
    assert value(derive(node, "x"), x) == pytest.approx(slope, abs=1e-9)


def test_a_table_is_derived_to_its_slope():
    once = derive(table("curve", X * X), "x")
    twice = derive(once, "x")
    curves = {"curve": lambda x, order: (x**3, 3.0 * x**2, 6.0 * x)[order]}
    found = interpret([once, twice], {"x": 2.0}, curves)
    assert found == pytest.approx([6.0 * 2.0**5, 30.0 * 2.0**4])


def test_what_does_not_depend_on_a_symbol_has_the_tangent_zero():
    assert derive(np.exp(Y) / Y, "x") is constant(0.0)
    assert derive(X < Y, "x") is constant(0.0)
    assert derive(np.sign(X), "x") is constant(0.0)
    assert derive(constant(3.0), "x") is constant(0.0)


def test_a_partial_derivative_that_is_not_needed_is_not_formed():
    # the derivative after the exponent would be the logarithm of -2
    assert value(derive(constant(-2.0) * X**3.0, "x"), 2.0) == -24.0

"""Facts of the graph: what numpy calls become, what is folded and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import wrightomega

from dashpot.expr.node import TraceError, as_node, constant, is_logical, symbol, symbols_of, table, walk

X, Y = symbol("x"), symbol("y")


def test_equal_expressions_are_one_node():
    assert np.exp(X + 2.0 * Y) is np.exp(X + 2.0 * Y)
    assert symbol("x") is X
    assert table("curve", X) is table("curve", X)
    assert table("curve", X) is not table("curve", X, 1)


def test_numbers_that_only_look_equal_are_different_nodes():
    assert constant(0.0) is not constant(-0.0)
    assert constant(1.0) is not constant(True)
    assert constant(1) is constant(1.0)
    assert constant(np.float64(2.0)) is constant(2.0)


@pytest.mark.parametrize(
    ("made", "operation"),
    [
        (X + Y, "add"),
        (X - Y, "subtract"),
        (X * Y, "multiply"),
        (X / Y, "divide"),
        (X**Y, "power"),
        (-X, "negative"),
        (abs(X), "absolute"),
        (np.abs(X), "absolute"),
        (np.fabs(X), "absolute"),
        (X < Y, "less"),
        (X >= Y, "greater_equal"),
        (X == Y, "equal"),
        (X != Y, "not_equal"),
        ((X < Y) & (Y < 1.0), "logical_and"),
        (~(X < Y), "logical_not"),
        ((X < Y) | (Y < 1.0), "logical_or"),
        (np.where(X < Y, X, Y), "where"),
        (np.sqrt(X), "sqrt"),
        (np.log1p(X), "log1p"),
        (np.clip(X, 0.0, 1.0), "minimum"),
        (wrightomega(X), "wrightomega"),
        (2.0 - X, "subtract"),
        (np.sign(X), "sign"),
        (np.float64(2.0) / X, "divide"),
        (np.array(2.0) * X, "multiply"),
    ],
)
def test_a_numpy_call_on_a_node_is_recorded(made, operation):
    assert made.operation == operation


def test_operations_on_numbers_are_done_at_once():
    assert (constant(2.0) + 3.0).payload == 5.0
    assert np.exp(constant(0.0)).payload == 1.0
    assert (constant(2.0) < 3.0).payload is True
    assert (constant(1.0) / 0.0).payload == math.inf


def test_what_changes_nothing_is_left_out():
    assert X + 0.0 is X and 0.0 + X is X and X - 0.0 is X
    assert X * 1.0 is X and 1.0 * X is X and X / 1.0 is X and X**1.0 is X
    assert X**2.0 is X * X
    assert np.where(constant(True), X, Y) is X and np.where(constant(False), X, Y) is Y
    assert np.where(X < Y, X, X) is X


def test_zero_times_something_stays_because_the_something_may_be_nan():
    assert (0.0 * X).operation == "multiply"
    assert (X - X).operation == "subtract"


@pytest.mark.parametrize(
    ("law", "advice"),
    [
        (lambda: 1.0 if X > 0.0 else 0.0, r"use np\.where"),
        (lambda: math.exp(X), "use numpy functions"),
        (lambda: np.cumsum(X), r"numpy\.cumsum; traced are where, clip"),
        (lambda: np.arctan(X), r"numpy\.arctan; usable are absolute, add"),
        (lambda: np.add(X, Y, out=X), r"write a = a \+ b"),
        (lambda: np.add.reduce(X), r"numpy\.add with its arguments only"),
        (lambda: np.log(constant(-1.0)), "constant NaN"),
        (lambda: as_node("a text"), "could not convert"),
    ],
)
def test_what_cannot_be_traced_is_refused_with_what_to_do(law, advice):
    with pytest.raises((TraceError, ValueError), match=advice):
        law()


def test_changing_a_node_in_place_is_refused():
    value = X
    with pytest.raises(TraceError, match=r"write a = a \+ b"):
        value += Y


def test_a_walk_meets_arguments_before_what_they_are_used_for():
    root = np.exp(X * Y) + X / (1.0 + X * Y)
    seen: set[int] = set()
    for node in walk([root, X]):
        assert all(argument.serial in seen for argument in node.arguments)
        assert node.serial not in seen
        seen.add(node.serial)
    assert root.serial in seen


def test_the_order_of_a_walk_follows_from_the_form_of_the_graph_alone():
    def shape(first, second):
        a, b = symbol(first), symbol(second)
        nodes = walk([np.exp(a) * (b + np.exp(a)), b / a])
        names = {first: "a", second: "b"}
        return [
            names.get(node.payload, node.operation) if node.operation == "symbol" else node.operation for node in nodes
        ]

    expected = shape("order_1", "order_2")
    # now the parts exist already, made in another order
    _ = symbol("order_4") / symbol("order_3"), np.exp(symbol("order_3"))
    assert shape("order_3", "order_4") == expected


def test_a_long_chain_does_not_exhaust_the_stack():
    node = X
    for number in range(5000):
        node = node * Y + float(number)
    assert len(walk([node])) > 9000


def test_the_symbols_of_a_node():
    assert symbols_of(np.where(X < 1.0, table("curve", Y), 2.0)) == {"x", "y"}
    assert symbols_of(constant(1.0)) == set()


def test_what_is_true_or_false():
    assert is_logical(X < Y) and is_logical(~(X < Y)) and is_logical(constant(True))
    assert is_logical(np.where(X < Y, X < 1.0, Y < 1.0))
    assert not is_logical(X) and not is_logical(np.where(X < Y, X, Y)) and not is_logical(constant(1.0))


def test_a_node_reads_like_its_formula():
    assert repr(np.exp(X) + 1.0) == "add(exp(x), 1.0)"

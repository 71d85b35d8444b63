"""Elimination written as a graph gives what a dense solver gives."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.expr.interpret import interpret
from dashpot.expr.node import constant, symbol, walk
from dashpot.kernel.compiler.elimination import SMALLEST, solve_symmetric


def sparse_positive(rng: np.random.Generator, count: int) -> np.ndarray:
    """The stiffness of a random network of springs, each node held a little."""
    matrix = np.diag(rng.uniform(0.1, 2.0, count))
    for one, other in rng.integers(0, count, (2 * count, 2)):
        if one != other:
            stiffness = rng.uniform(0.1, 10.0)
            matrix[[one, other], [one, other]] += stiffness
            matrix[[one, other], [other, one]] -= stiffness
    return matrix


def solved(matrix: np.ndarray, right: np.ndarray, known: np.ndarray | None = None) -> np.ndarray:
    """The solution found by elimination over the graph, the zeros of ``known`` left out."""
    pattern = matrix if known is None else known
    rows = {
        f"n{i}": {f"n{j}": symbol(f"m{i}.{j}") for j in range(len(right)) if i == j or pattern[i, j] != 0.0}
        for i in range(len(right))
    }
    found = solve_symmetric(rows, {f"n{i}": symbol(f"r{i}") for i in range(len(right))})
    numbers = {f"m{i}.{j}": matrix[i, j] for i in range(len(right)) for j in range(len(right))}
    numbers |= {f"r{i}": number for i, number in enumerate(right)}
    assert list(found) == list(rows)
    return np.array(interpret(list(found.values()), numbers))


@pytest.mark.parametrize("count", [1, 2, 3, 5, 9])
def test_a_random_network_of_springs_is_solved_as_by_a_dense_solver(count):
    seed = seed_of("test_elimination")
    print(f"seed {seed}")
    rng = np.random.default_rng(seed)
    for _ in range(5):
        matrix, right = sparse_positive(rng, count), rng.standard_normal(count)
        assert solved(matrix, right) == pytest.approx(np.linalg.solve(matrix, right), rel=1e-9, abs=1e-11)


def test_a_chain_gets_no_entries_that_were_not_there():
    chain = {f"n{i}": {f"n{j}": symbol(f"m{i}.{j}") for j in (i - 1, i, i + 1) if 0 <= j < 40} for i in range(40)}
    found = solve_symmetric(chain, {name: constant(1.0) for name in chain})
    # the work grows in proportion to the length: an order of elimination that filled in would take 40^3/3 products
    assert len(walk(list(found.values()))) < 40 * 20


def test_a_node_that_nothing_holds_gets_the_smallest_pivot_and_no_infinity():
    found = solved(np.array([[0.0]]), np.array([3e-9]), known=np.ones((1, 1)))
    assert found == pytest.approx([3e-9 / SMALLEST])

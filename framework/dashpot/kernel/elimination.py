"""Solving a small symmetric system of equations as a graph: the order of elimination is fixed before anything runs."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from dashpot.expr.node import Node, constant, maximum

# a pivot below this share of its row's own stiffness is noise of the subtraction, or a joint that nothing holds
FLOOR, SMALLEST = 1e-12, 1e-9
ZERO = constant(0.0)

Matrix = Mapping[str, Mapping[str, Node]]


def solve_symmetric(matrix: Matrix, right: Mapping[str, Node]) -> dict[str, Node]:
    """The unknowns by name of ``matrix x = right``, a sparse symmetric and positive matrix without its zeros.

    The unknown with the fewest neighbours goes first. No pivot gets smaller than a floor, so that a joint that only
    slides does not blow up.
    """
    rows = {name: dict(row) for name, row in matrix.items()}
    sides = dict(right)
    floors = {name: FLOOR * np.absolute(row[name]) + SMALLEST for name, row in matrix.items()}
    steps: list[tuple[str, Node, dict[str, Node]]] = []
    while rows:
        name = min(rows, key=lambda candidate: len(rows[candidate]))
        row = rows.pop(name)
        pivot = 1.0 / maximum(row.pop(name), floors[name])
        for other, entry in row.items():
            factor = entry * pivot
            sides[other] = sides[other] - factor * sides[name]
            del rows[other][name]
            for third, along in row.items():
                rows[other][third] = rows[other].get(third, ZERO) - factor * along
        steps.append((name, pivot, row))
    found: dict[str, Node] = {}
    for name, pivot, row in reversed(steps):
        total = sides[name]
        for other, entry in row.items():
            total = total - entry * found[other]
        found[name] = total * pivot
    return {name: found[name] for name in matrix}

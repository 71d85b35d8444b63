"""Solving a small symmetric system of equations as a graph: the order of elimination is fixed before anything runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from dashpot.expr.node import Node, constant, maximum

# a pivot below this share of its row's own stiffness is noise of the subtraction, or a joint that nothing holds
FLOOR, SMALLEST = 1e-12, 1e-3
ZERO = constant(0.0)

Matrix = Mapping[str, Mapping[str, Node]]


@dataclass(frozen=True)
class Mount:
    """What an unknown is fixed to: it adds 1 / compliance to the matrix and gap / compliance to the right side.

    A compliance of 0 holds the unknown at the gap.
    """

    compliance: Node
    gap: Node


def solve_symmetric(
    matrix: Matrix,
    right: Mapping[str, Node],
    mounts: Mapping[str, Mount] = MappingProxyType({}),
    farthest: Node | None = None,
) -> dict[str, Node]:
    """The unknowns by name of ``matrix x = right``, a sparse symmetric and positive matrix without its zeros.

    The unknown with the fewest neighbours goes first. No pivot gets smaller than a floor, so that a joint that only
    slides does not blow up. With a ``farthest`` way each pivot is at least so large that its unknown alone goes no
    farther: the matrix stays symmetric and positive, whatever is added to its diagonal.
    """
    rows = {name: dict(row) for name, row in matrix.items()}
    sides = dict(right)
    floors = {name: FLOOR * np.absolute(row[name]) + SMALLEST for name, row in matrix.items()}
    steps: list[tuple[str, Node, Node, dict[str, Node]]] = []
    while rows:
        name = min(rows, key=lambda candidate: len(rows[candidate]))
        row = rows.pop(name)
        floor = floors[name] if farthest is None else maximum(floors[name], np.absolute(sides[name]) / farthest)
        pivot, alone = _pivot(row.pop(name), floor, sides[name], mounts.get(name))
        for other, entry in row.items():
            factor = entry * pivot
            sides[other] = sides[other] - entry * alone
            del rows[other][name]
            for third, along in row.items():
                rows[other][third] = rows[other].get(third, ZERO) - factor * along
        steps.append((name, pivot, alone, row))
    found: dict[str, Node] = {}
    for name, pivot, alone, row in reversed(steps):
        found[name] = alone - pivot * sum((entry * found[other] for other, entry in row.items()), ZERO)
    return {name: found[name] for name in matrix}


def _pivot(own: Node, floor: Node, side: Node, mount: Mount | None) -> tuple[Node, Node]:
    """The reciprocal of a pivot, and the unknown if all others were zero."""
    if mount is None:
        pivot = 1.0 / maximum(own, floor)
        return pivot, side * pivot
    stiff = 1.0 / maximum(1.0 + mount.compliance * own, FLOOR)
    return mount.compliance * stiff, (mount.compliance * side + mount.gap) * stiff

"""Which directions of the parameters data decide, and which look decided by the inexactness of a Jacobian alone.

A Jacobian is made of differences over short steps. It errs by the bend of the residual within a step and by what the
solver leaves over, divided by the step. Columns that are parallel in truth then differ a little, and where the
residual is zero, as of data without noise, that little would tell the parameters exactly. How much a Jacobian errs
shows where it is made once more with steps half as long.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates
from dashpot.fit.linear import Linear

Array = NDArray[np.float64]

SHORTER = 0.5  # the bend makes half of its error there, so that twice the difference is the error
CHANCE = 2.0  # what the solver leaves over differs from step to step by chance
SURE = (CHANCE / SHORTER) ** 2  # times the squared difference is what a squared change has to exceed
SHARE = 1e-6  # of the square of a direction, from which a parameter has a part in it


def doubt_of(linear: Linear, coordinates: Coordinates, point: Array) -> Array:
    """The products (p, p) of how the changes with natural steps differ from those over steps half as long.

    Where those cannot be had the changes are in doubt as a whole.
    """
    size, factors = linear.size, linear.factors[: linear.size, None]
    shorter = SHORTER * np.diag(coordinates.unit / linear.factors[:size])
    values = coordinates.to_values(np.concatenate([point[None], point + shorter]))
    moves = np.concatenate([linear.moves[:size], values[1:] - values[0]])

    def products(_: int, rows: Array) -> Array:
        changes, again = rows[1 : 1 + size], rows[1 + size :] / SHORTER
        solved = np.isfinite(again).all(axis=1, keepdims=True)
        changes[linear.unsolved[:size]] = 0.0
        differences = factors * np.where(solved, changes - again, changes)
        differences[linear.unsolved[:size]] = 0.0
        return differences @ differences.T

    return sum(linear.objective.linearise(linear.values, moves, products), np.zeros((size, size)))


def decide(values: Array, vectors: Array, doubt: Array, least: float) -> tuple[NDArray[np.bool_], Array]:
    """Which of the eigenvectors (p, k) of J J' with these eigenvalues (k,) are decided, and the others (p, m).

    Those have to be more than a share, ``least``, of the largest one and more than the ``doubt`` (p, p) explains. What
    is not decided has its small parts set to zero: an eigenvector in doubt turns towards the decided ones by the root
    of the doubt over their eigenvalues.
    """
    doubts = np.einsum("ik,ij,jk->k", vectors, doubt, vectors)
    decided = values > np.maximum(least * values.max(initial=0.0), SURE * doubts)
    others, squares = vectors[:, ~decided], vectors[:, ~decided] ** 2
    turned = np.maximum(SHARE, doubts[~decided] / np.min(values[decided], initial=np.inf))
    # a direction is one of its largest parts, whatever the doubt
    least_part = np.minimum(turned, 0.5 * squares.max(axis=0, initial=0.0))
    return decided, np.where(squares > least_part, others, 0.0)

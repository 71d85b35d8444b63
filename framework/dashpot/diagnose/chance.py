"""How much of a structure of unknown cause some law takes up by chance.

A structure of unknown cause is thought to point anywhere among the directions in which the laws of all causes differ.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.score import Scores, Structure
from dashpot.diagnose.search import LEFT, projected

Array = NDArray[np.float64]


def independent_directions(scores: Scores) -> float:
    """In how many directions the forces of the candidates differ, what is in the model projected out.

    The forms of one cause at one place count as one.
    """
    gram = projected(scores, Structure()).gram
    alive = np.diag(gram) > LEFT
    return participation_ratio(gram[np.ix_(alive, alive)], _weights(scores)[alive])


def participation_ratio(gram: Array, weights: Array) -> float:
    """That of the eigenvalues of a Gram matrix (c, c) of columns of length one, with ``weights`` (c,).

    It is one for columns that are all alike, and their number for columns that have nothing in common.
    """
    squares = gram**2 / np.outer(np.diag(gram), np.diag(gram))
    return float(weights.sum() ** 2 / (weights @ squares @ weights)) if weights.size else 1.0


def _weights(scores: Scores) -> Array:
    """One over the number of columns that each column's cause has at its place."""
    look = scores.look
    columns = {one.name: 0 for one in look.candidates}
    for one in look.candidates:
        columns[one.name] += one.columns.stop - one.columns.start
    found = np.zeros(look.layout.size - look.layout.first_candidate)
    for one in look.candidates:
        found[one.columns] = 1.0 / columns[one.name]
    return found


def share_by_chance(share: float, directions: float) -> float:
    """How likely one of so many directions takes up such a ``share`` of the square of a vector that points anywhere.

    The squares of its components share its square as a Dirichlet distribution with parameters 1/2 does, each one as a
    beta distribution; two of them cannot both be larger than half, and below that this is an upper bound.
    """
    from scipy.special import betaincc

    if directions <= 1.0:
        return 1.0
    return float(min(1.0, directions * betaincc(0.5, 0.5 * (directions - 1.0), share)))

"""The noise of runs on which there are many suspects for few samples: only those that show take part.

Were hundreds of columns fitted to some thousand samples, what they take out of the noise would be missing in it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.noise import NoiseModel
from dashpot.assess.projection import Normal, Projected, normal_equations, project_out
from dashpot.assess.screen import Columns

Array = NDArray[np.float64]

MOST = 60
KEPT = 1e-4  # of the square of a column must be left by those chosen before


def selected_residual(columns: Columns, noise: NoiseModel) -> dict[str, Array]:
    """What is left of each run after tangents, sensor errors and the suspects that are significant together."""
    normal = normal_equations(columns.residual, columns.kinds, noise, columns.jobs)
    fixed = columns.tangents.size + columns.nuisance.size
    chosen = np.concatenate([np.arange(fixed), fixed + select(project_out(normal, fixed))])
    strengths = np.zeros(fixed + columns.bank.size)
    strengths[chosen] = _solve(normal, chosen)
    return columns.less(strengths)


def select(projected: Projected) -> NDArray[np.intp]:
    """Columns one after the other, each the best beside those before, while chance would not make one as good.

    The largest of m squares of standard normal numbers is about 2 log m.
    """
    scale = np.sqrt(np.maximum(projected.original, 1e-300))
    scores, spread = projected.scores / scale, projected.spread / np.outer(scale, scale)
    price = 2.0 * np.log(max(scores.size, 2))
    chosen: list[int] = []
    while len(chosen) < min(MOST, scores.size):
        left = np.diag(spread)
        gains = np.where(left > KEPT, scores**2 / np.maximum(left, KEPT), 0.0)
        best = int(np.argmax(gains))
        if gains[best] <= price:
            break
        chosen.append(best)
        way = spread[:, best] / np.sqrt(left[best])
        scores = scores - way * (scores[best] / np.sqrt(left[best]))
        spread = spread - np.outer(way, way)
    return np.array(chosen, dtype=np.intp)


def _solve(normal: Normal, chosen: NDArray[np.intp]) -> Array:
    gram, right = normal.gram[np.ix_(chosen, chosen)], normal.right[chosen]
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    return np.linalg.lstsq(gram / np.outer(scale, scale), right / scale, rcond=1e-12)[0] / scale

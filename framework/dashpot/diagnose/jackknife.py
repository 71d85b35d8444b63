"""How well the runs tell strengths: pieces of whole cycles are left out in turn.

Source: J. W. Tukey: Bias and confidence in not quite large samples. Ann. Math. Stat. 29, 1958.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

PIECES = 12  # of a run
CONFIDENCE = 0.95


def standard_errors(values: Array, shapes: Array, edges: Sequence[int]) -> Array:
    """The standard errors (k,) of the strengths of shapes (k, n) in values (n,), pieces between ``edges`` left out.

    What follows from one sample to the next within a piece makes them larger; infinite where there is one piece only.
    """
    parts = [slice(*ends) for ends in pairwise(edges)]
    grams = np.array([shapes[:, part] @ shapes[:, part].T for part in parts])
    rights = np.array([shapes[:, part] @ values[part] for part in parts])
    if len(parts) < 2:
        return np.full(len(shapes), np.inf)
    without = zip(grams.sum(axis=0) - grams, rights.sum(axis=0) - rights, strict=True)
    found = np.array([np.linalg.lstsq(gram, right, rcond=1e-10)[0] for gram, right in without])
    away = found - found.mean(axis=0)
    return np.asarray(np.sqrt((len(parts) - 1) / len(parts) * np.sum(away**2, axis=0)))


def interval_of(value: float, error: float, pieces: int) -> tuple[float, float]:
    """The 95 % interval of a value with a standard error from so many ``pieces`` (Student's t)."""
    from scipy.stats import t

    half = float(t.ppf(0.5 + 0.5 * CONFIDENCE, pieces - 1)) * error
    return value - half, value + half

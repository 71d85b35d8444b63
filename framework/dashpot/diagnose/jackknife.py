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


def half_widths(values: Array, shapes: Array, edges: Sequence[int]) -> Array:
    """Half of the 95 % intervals (k,) of the strengths of shapes (k, n) in values (n,), cut into pieces at ``edges``.

    What follows from one sample to the next within a piece makes them wider; infinite where there is one piece only.
    """
    from scipy.stats import t

    parts = [slice(*ends) for ends in pairwise(edges)]
    grams = np.array([shapes[:, part] @ shapes[:, part].T for part in parts])
    rights = np.array([shapes[:, part] @ values[part] for part in parts])
    if len(parts) < 2:
        return np.full(len(shapes), np.inf)
    without = zip(grams.sum(axis=0) - grams, rights.sum(axis=0) - rights, strict=True)
    found = np.array([np.linalg.lstsq(gram, right, rcond=1e-10)[0] for gram, right in without])
    away = found - found.mean(axis=0)
    errors = np.sqrt((len(parts) - 1) / len(parts) * np.sum(away**2, axis=0))
    return np.asarray(t.ppf(0.5 + 0.5 * CONFIDENCE, len(parts) - 1) * errors)

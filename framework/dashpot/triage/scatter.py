"""The scatter of a run where few cycles tell it, with what the scatter of the other runs says of it.

Source: Smyth, "Linear models and empirical Bayes methods for assessing differential expression in microarray
experiments", Statistical Applications in Genetics and Molecular Biology 3 (2004): the moderated t.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ROUNDING = float(np.finfo(float).eps) ** 2


def moderated(variances: Array, freedoms: Array) -> tuple[Array, Array]:
    """Variances (n,) and degrees of freedom (n,) of runs, each with what is known of all of them.

    The more alike the variances of the runs are, the more they count beside its own: where they differ by no more than
    chance, all have one. A run without freedom has that of the others alone; freedom 0: nothing is known.
    """
    own = freedoms > 0.0
    together = float(np.sum(freedoms))
    if not together > 0.0:
        return np.zeros_like(variances), np.zeros_like(freedoms)
    usual, weight = _usual(variances[own], freedoms[own], together)
    total = freedoms + weight
    mixed = (weight * usual + freedoms * variances) / np.where(total > 0.0, total, 1.0)
    return mixed, np.minimum(total, together)


def _usual(variances: Array, freedoms: Array, together: float) -> tuple[float, float]:
    """The variance that runs usually have, and how many degrees of freedom this is worth for each of them."""
    from scipy.special import digamma, polygamma

    if variances.size < 2:
        return 0.0, 0.0
    logs = np.log(np.maximum(variances, _ROUNDING)) - digamma(freedoms / 2.0) + np.log(freedoms / 2.0)
    beyond = float(np.var(logs, ddof=1) - np.mean(polygamma(1, freedoms / 2.0)))
    if beyond <= float(polygamma(1, together / 2.0)):
        return float(variances @ freedoms) / together, together
    half = _inverse_trigamma(beyond)
    return float(np.exp(np.mean(logs) + digamma(half) - np.log(half))), 2.0 * half


def _inverse_trigamma(value: float) -> float:
    """The argument at which the trigamma function has a value > 0.

    By Newton's method on one over the function, which is convex, from a place beyond it: every step goes the same way.
    """
    from scipy.special import polygamma

    argument = 0.5 + 1.0 / value
    for _ in range(50):
        found = float(polygamma(1, argument))
        step = found * (1.0 - found / value) / float(polygamma(2, argument))
        argument += step
        if abs(step) < 1e-10 * argument:
            break
    return argument

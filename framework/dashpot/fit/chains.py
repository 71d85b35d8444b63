"""Whether chains of draws have come to rest, and what they are worth.

All of it is computed of normal scores: the draws of a number are replaced by the quantiles of the normal distribution
at their ranks, so that a long tail, or a logarithm, makes no difference.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

WINDOW = 5.0  # autocorrelation times over which the autocorrelation is summed


@dataclass(frozen=True, eq=False)
class Rest:
    """Of each of n numbers: R-hat, effective number of draws, autocorrelation time in steps, each (n,)."""

    r_hat: Array
    effective: Array
    time: Array


def at_rest(draws: Array) -> Rest:
    """The state of chains (steps, walkers, n) of four steps or more.

    R-hat compares the variance between the halves of all walkers with that within them, of draws and of their distances
    from the median; the larger one counts. A number that does not move has NaN.

    Sources: Vehtari, Gelman, Simpson, Carpenter and Buerkner, Bayesian Analysis 16 (2021) 667, for R-hat; Goodman and
    Weare, Commun. Appl. Math. Comput. Sci. 5 (2010) 65, for the autocorrelation of an ensemble; Sokal, Monte Carlo
    methods in statistical mechanics (1996), for the window.
    """
    scores, folded = normal_scores(draws), normal_scores(np.abs(draws - np.median(draws, axis=(0, 1))))
    time = autocorrelation_time(scores)
    return Rest(np.maximum(split_r_hat(scores), split_r_hat(folded)), draws.shape[0] * draws.shape[1] / time, time)


def normal_scores(draws: Array) -> Array:
    """The quantiles of the normal distribution at the ranks of draws (steps, walkers, n) among all of a number."""
    from scipy.special import ndtri
    from scipy.stats import rankdata

    flat = draws.reshape(-1, draws.shape[2])
    return np.asarray(ndtri((rankdata(flat, axis=0) - 0.375) / (len(flat) + 0.25))).reshape(draws.shape)


def split_r_hat(draws: Array) -> Array:
    """R-hat (n,) of chains (steps, walkers, n), each of them cut into halves."""
    half = len(draws) // 2
    chains = np.concatenate([draws[:half], draws[-half:]], axis=1)
    within = chains.var(axis=0, ddof=1).mean(axis=0)
    between = chains.mean(axis=0).var(axis=0, ddof=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.sqrt((half - 1.0) / half + between / within))


def autocorrelation_time(draws: Array) -> Array:
    """The integrated autocorrelation time (n,) in steps of chains (steps, walkers, n), no less than one step."""
    steps = len(draws)
    spectrum = np.fft.rfft(draws - draws.mean(axis=(0, 1)), n=2 * steps, axis=0)
    correlation = np.fft.irfft(np.mean(np.abs(spectrum) ** 2, axis=1), axis=0)[:steps]
    with np.errstate(invalid="ignore"):
        times = 2.0 * np.cumsum(correlation / correlation[0], axis=0) - 1.0
    enough = np.arange(steps)[:, None] >= WINDOW * times
    last = np.where(enough.any(axis=0), np.argmax(enough, axis=0), steps - 1)
    return np.maximum(times[last, np.arange(times.shape[1])], 1.0)

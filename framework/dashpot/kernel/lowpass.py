"""A low-pass of first order, lag * dy/dt + y = u, solved exactly along the cubic spline through the samples of u."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from dashpot.kernel.spline import slopes

Array = NDArray[np.float64]

# below this share of a step the powers of the place in it are averaged by their series, which needs so many terms
SHORT, TERMS = 1.0, 20


def smoothed(values: Array, lags: Array, dt: float) -> Array:
    """Signals (lanes, n) behind a low-pass with the time constants ``lags`` (lanes,) or (1,), in s as ``dt``.

    Before the first sample the signal was constant. A signal that is not finite gives NaN, one without a lag itself.
    """
    if not np.any(lags):
        return values
    lags = np.broadcast_to(lags, len(values))
    found = np.where((lags == 0.0)[:, None], values, np.nan)
    late = np.flatnonzero((lags > 0.0) & np.isfinite(values).all(axis=1))
    if late.size:
        for number, slope in zip(late, slopes(values[late]), strict=True):
            found[number] = _followed(values[number], slope, dt / lags[number])
    return found


def _followed(values: Array, slope: Array, steps: float) -> Array:
    """One signal with its slopes per sample; ``steps`` is the length of a step in time constants."""
    from scipy.signal import lfilter

    fading = math.exp(-steps)
    zero, one, two, three = weights(steps)
    # Hermite's cubic: its value and slope at both ends of a step
    push = (
        (zero - 3.0 * two + 2.0 * three) * values[:-1]
        + (3.0 * two - 2.0 * three) * values[1:]
        + (one - 2.0 * two + three) * slope[:-1]
        + (three - two) * slope[1:]
    )
    return np.concatenate([values[:1], lfilter([1.0], [1.0, -fading], push, zi=[fading * values[0]])[0]])


def weights(steps: float) -> tuple[float, float, float, float]:
    """What 1, p, p^2 and p^3 (p: the place in a step, 0 to 1) leave at its end: the integral of r exp(-r (1 - p)) p^k.

    ``steps`` is r, the length of the step over the time constant.
    """
    if steps < SHORT:
        # the integral of (1 - p)^n p^k is n! k! / (n + k + 1)!
        short = [
            sum((-1) ** n * steps ** (n + 1) * math.factorial(k) / math.factorial(n + k + 1) for n in range(TERMS))
            for k in range(4)
        ]
        return short[0], short[1], short[2], short[3]
    zero = -math.expm1(-steps)
    one = 1.0 - zero / steps
    two = 1.0 - 2.0 * one / steps
    return zero, one, two, 1.0 - 3.0 * two / steps

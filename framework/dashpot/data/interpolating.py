"""The rates of a clean path: of the spline through all samples, of the degree that suits its spectrum.

The derivative of a spline of odd degree d errs at the frequency f, in periods a sample, by (1 + q) q^d, q = f/(1 - f):
that of the quintic by 4.6 % at a third of the sampling rate, that of degree 11 by 0.07 %. Where a path has corners, so
that its spectrum does not end before the Nyquist frequency, a higher degree only rings for longer. Source: Unser, IEEE
Signal Processing Magazine 16(6) (1999) 22.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

QUINTIC, HIGH = 5, 11  # degrees
FEWEST = 128  # samples that have a spectrum; a path of fewer is short
GOING_ON = 40  # samples by which a path is lengthened: what is wrong behind them has faded to less than a millionth
OUTERMOST = 5  # samples at an end that is not lengthened: there the quintic is better than a spline of high degree
FARTHEST = 2.0  # times the largest distance of these samples from their mean
LOOKING_BACK, ORDER = 200, 16  # samples from which it is lengthened, and how many of them tell the next one
DISTINCT = 1e-6  # of the largest singular value: what is less is rounding, or noise that a clean path may have
PIECE, MARGIN = 100_000, 100  # samples
ALIASES = 2.0 * np.pi * np.arange(-8, 9)[:, None]
FREQUENCIES = np.linspace(0.0, 0.5, 4097)  # periods a sample, at which responses are known


def interpolated_rates(dt: float, x: Array, degree: int) -> tuple[Array, Array]:
    """Velocity and acceleration (n,) of the spline through samples (n,) every ``dt``."""
    if degree == QUINTIC and x.size >= FEWEST:
        return _rates(dt, x, degree)
    # the ends of a spline are off by as much as the velocity where the motion is fast, and are much of a short path
    before, behind = going_on(x[::-1])[::-1], going_on(x)
    longer = _rates(dt, np.concatenate([before, x, behind]), degree)
    velocity, acceleration = (rate[before.size : before.size + x.size] for rate in longer)
    ends = ((before, slice(OUTERMOST), x[:MARGIN]), (behind, slice(-OUTERMOST, None), x[-MARGIN:]))
    for lengthened, end, near in ends if degree > QUINTIC else ():
        if not lengthened.size:
            velocity[end], acceleration[end] = (rate[end] for rate in _rates(dt, near, QUINTIC))
    return velocity, acceleration


def going_on(x: Array) -> Array:
    """A path (n,) for some samples behind its end, by linear prediction; none where it would go far beyond its reach.

    Each sample is a sum of those before it, by least squares: exact for a sum of half as many sines. What grows, as a
    fading shock does backwards, grows faster than a spline forgets it. Source: Makhoul, Proceedings of the IEEE 63
    (1975) 561, the covariance method.
    """
    last = x[-LOOKING_BACK:]
    mean, order = last.mean(), min(ORDER, last.size // 3)
    path = np.append(last - mean, np.zeros(GOING_ON))
    if last.size <= ORDER:
        return path[:0]
    before = np.lib.stride_tricks.sliding_window_view(path[: last.size], order)
    weights = np.linalg.lstsq(before[:-1], path[order : last.size], rcond=DISTINCT)[0]
    farthest = FARTHEST * np.max(np.abs(path))
    for place in range(last.size, path.size):
        path[place] = weights @ path[place - order : place]
        if abs(path[place]) > farthest:
            return path[:0]
    return path[last.size :] + mean


@cache
def response_of_spline(degree: int) -> Array:
    """The velocity (f,) per unit of displacement that a spline gives at ``FREQUENCIES``."""
    angle = 2.0 * np.pi * FREQUENCIES[1:]
    seen = 1.0 + ALIASES / angle
    found: Array = angle * np.sum(seen**-degree, axis=0) / np.sum(seen ** -(degree + 1), axis=0)
    return np.append(0.0, found)


def _rates(dt: float, x: Array, degree: int) -> tuple[Array, Array]:
    # piece by piece; what lies further away than the margin of a piece has faded to less than the last digit, by 0.43
    # each sample for the quintic, by 0.66 for the spline of high degree
    from scipy.interpolate import make_interp_spline

    velocity, acceleration = np.empty((2, x.size))
    for first in range(0, x.size, PIECE):
        begin, end = max(first - MARGIN, 0), min(first + PIECE + MARGIN, x.size)
        time = dt * np.arange(end - begin)
        spline = make_interp_spline(time, x[begin:end], k=degree if end - begin > degree else 1)
        own = slice(first, first + PIECE)
        velocity[own], acceleration[own] = (spline(time[first - begin :][:PIECE], order) for order in (1, 2))
    return velocity, acceleration

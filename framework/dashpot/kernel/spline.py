"""The cubic spline through evenly spaced samples, by its slopes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FEWEST = 5  # samples of a spline without a knot beside either end
POLE = np.sqrt(3.0) - 2.0  # of the recursive filter that inverts 1, 4, 1
REACH = 60  # samples after which a power of the pole is below all digits of a number


def slopes(forces: Array) -> Array:
    """The slopes (lanes, n) per sample of the cubic splines through forces without a knot beside either end.

    Between the ends s[k - 1] + 4 s[k] + s[k + 1] = 3 (f[k + 1] - f[k - 1]). One solution is a recursive filter, once
    forward and once back (Unser 1999); what the equations at the ends want beside it fades as powers of the pole.
    """
    from scipy.interpolate import CubicSpline
    from scipy.signal import lfilter

    count = forces.shape[1]
    if count < FEWEST:
        return CubicSpline(np.arange(count), forces, axis=1)(np.arange(count), 1)
    rise = np.diff(forces, axis=1)
    right = np.zeros_like(forces)
    right[:, 1:-1] = 3.0 * (rise[:, 1:] + rise[:, :-1])
    forward = lfilter([-POLE], [1.0, -POLE], right[:, :-1], axis=1)
    found = np.zeros_like(forces)
    found[:, -2::-1] = lfilter([1.0], [1.0, -POLE], forward[:, ::-1], axis=1)
    # s[0] + 2 s[1] at the beginning, 2 s[n - 2] + s[n - 1] at the end
    wanted = 2.5 * rise[:, [0, -1]] + 0.5 * rise[:, [1, -2]] - found[:, [0, -1]] - 2.0 * found[:, [1, -2]]
    near, far = 1.0 + 2.0 * POLE, POLE ** (count - 1) + 2.0 * POLE ** (count - 2)
    fading = np.linalg.solve([[near, far], [far, near]], wanted.T)[..., None] * POLE ** np.arange(min(count, REACH))
    found[:, :REACH] += fading[0]
    found[:, : -REACH - 1 : -1] += fading[1]
    return found

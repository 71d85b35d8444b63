"""Curves of a network as numbers: cubic coefficients of tables for every lane, and eager evaluation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.model.network import Characteristic

Array = NDArray[np.float64]


def segment_of(curve: Characteristic, argument: Array) -> tuple[NDArray[np.int64], Array]:
    """Which segment of a table an argument lies in, and how far from the knot that the segment starts from.

    Segment 0 lies below the first knot and is measured from it, segment n above the last of n knots.
    """
    at = np.asarray(curve.at)
    segment = np.searchsorted(at, argument, side="right").astype(np.int64)
    return segment, argument - at[np.maximum(segment - 1, 0)]


def cubic_coefficients(curve: Characteristic, values: Array) -> Array:
    """Coefficients (segments, 4, lanes) of the monotone cubic through ``values`` (knots, lanes), constant term first.

    Outside the knots a characteristic goes on linearly and a factor (unit 1) stays as it is.
    """
    from scipy.interpolate import PchipInterpolator

    at = np.asarray(curve.at)
    cubic = PchipInterpolator(at, values, axis=0)
    inside = cubic.c[::-1].transpose(1, 0, 2)
    slopes = cubic(at[[0, -1]], 1) * (0.0 if curve.curve.value[1] == "1" else 1.0)
    ends = np.zeros((2, 4, values.shape[1]))
    ends[:, 0], ends[:, 1] = values[[0, -1]], slopes
    return np.concatenate([ends[:1], inside, ends[1:]])


def evaluate_table(curve: Characteristic, values: Array, argument: Array, order: int = 0) -> Array:
    """The table with ``values`` (knots,) or (knots, lanes) at ``argument`` (n,); the answer is (n,) or (lanes, n)."""
    values = np.asarray(values, dtype=float)
    segment, u = segment_of(curve, np.asarray(argument, dtype=float))
    c0, c1, c2, c3 = np.moveaxis(cubic_coefficients(curve, values.reshape(len(curve.at), -1))[segment], 1, 0)
    u = u[:, None]
    powers = {
        0: lambda: c0 + u * (c1 + u * (c2 + u * c3)),
        1: lambda: c1 + u * (2.0 * c2 + 3.0 * u * c3),
        2: lambda: 2.0 * c2 + 6.0 * u * c3,
    }
    found = powers[order]().T
    return found[0] if values.ndim == 1 else found

"""Tabulated curves as numbers: the coefficients of their cubics for every lane, and their evaluation in numpy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.model.network import Characteristic

Array = NDArray[np.float64]


def segment_of(curve: Characteristic, argument: Any) -> tuple[NDArray[np.int64], Array]:
    """Which segment of a table an argument lies in, and how far from the knot that the segment starts from.

    Segment 0 lies below the first knot and is measured from it, segment n above the last of n knots.
    """
    at = np.asarray(curve.at)
    segment = np.searchsorted(at, argument, side="right").astype(np.int64)
    return segment, argument - at[np.maximum(segment - 1, 0)]


def cubic_coefficients(curve: Characteristic, values: Array) -> Array:
    """Coefficients (segments, 4, lanes) of the monotone cubic through ``values`` (knots, lanes), constant term first.

    Outside the knots a characteristic goes on linearly and a factor (unit 1) stays as it is. A lane with a value that
    is not finite has NaN throughout.
    """
    from scipy.interpolate import PchipInterpolator

    at = np.asarray(curve.at)
    sound = np.isfinite(values).all(axis=0)
    cubic = PchipInterpolator(at, np.where(sound, values, 0.0), axis=0)
    inside = cubic.c[::-1].transpose(1, 0, 2)
    slopes = cubic(at[[0, -1]], 1) * (0.0 if curve.curve.value[1] == "1" else 1.0)
    ends = np.zeros((2, 4, values.shape[1]))
    ends[:, 0], ends[:, 1] = values[[0, -1]], slopes
    return np.where(sound, np.concatenate([ends[:1], inside, ends[1:]]), np.nan)


@dataclass(frozen=True, eq=False)
class TableLaw:
    """A table as numpy sees it; ``coefficients`` (segments, 4, lanes) as ``cubic_coefficients`` makes them."""

    curve: Characteristic
    coefficients: Array

    def __call__(self, argument: Any, order: int = 0) -> Array:
        """The value (or first or second derivative) in every lane (lanes,), at one argument or at one for each lane."""
        segment, u = segment_of(self.curve, argument)
        c0, c1, c2, c3 = self.coefficients[segment, :, np.arange(self.coefficients.shape[2])].T
        if order == 0:
            return c0 + u * (c1 + u * (c2 + u * c3))
        return c1 + u * (2.0 * c2 + 3.0 * u * c3) if order == 1 else 2.0 * c2 + 6.0 * u * c3

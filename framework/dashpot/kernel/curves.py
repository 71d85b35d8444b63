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
    at, sound = np.asarray(curve.at)[:, None], np.isfinite(values).all(axis=0)
    heights, width = np.where(sound, values, 0.0), np.diff(at, axis=0)
    rise = np.diff(heights, axis=0) / width
    slope = monotone_slopes(width, rise)
    bend = (3.0 * rise - 2.0 * slope[:-1] - slope[1:]) / width
    twist = (slope[:-1] + slope[1:] - 2.0 * rise) / width**2
    inside = np.stack([heights[:-1], slope[:-1], bend, twist], axis=1)
    ends = np.zeros((2, 4, values.shape[1]))
    ends[:, 0], ends[:, 1] = heights[[0, -1]], slope[[0, -1]] * (0.0 if curve.curve.value[1] == "1" else 1.0)
    return np.where(sound, np.concatenate([ends[:1], inside, ends[1:]]), np.nan)


def monotone_slopes(width: Array, rise: Array) -> Array:
    """Slopes (knots, lanes) at the knots of the monotone cubic of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5
    (1984) 300), from the ``width`` (segments, 1) and the mean slope ``rise`` (segments, lanes) of each segment.
    """
    if len(rise) == 1:
        return np.repeat(rise, 2, axis=0)
    left, right = 2.0 * width[1:] + width[:-1], width[1:] + 2.0 * width[:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = (left + right) / (left / rise[:-1] + right / rise[1:])
    inner = np.where(rise[:-1] * rise[1:] > 0.0, mean, 0.0)
    first, last = _end_slope(width[:2], rise[:2]), _end_slope(width[:-3:-1], rise[:-3:-1])
    return np.concatenate([first[None], inner, last[None]])


def _end_slope(width: Array, rise: Array) -> Array:
    # through three points, as long as the curve stays monotone
    slope = ((2.0 * width[0] + width[1]) * rise[0] - width[0] * rise[1]) / (width[0] + width[1])
    slope = np.where(np.sign(slope) == np.sign(rise[0]), slope, 0.0)
    far = (np.sign(rise[0]) != np.sign(rise[1])) & (np.abs(slope) > 3.0 * np.abs(rise[0]))
    return np.where(far, 3.0 * rise[0], slope)


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

    def slope(self, argument: Any) -> Array:
        """The slope in every lane (lanes,)."""
        return self(argument, 1)

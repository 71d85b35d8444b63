"""Smooth curves that never fall, by linear least squares: rising sums of cubic B-splines (I-splines)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

# Weight of the penalty on changes of slope; it only bridges gaps.
_STIFFNESS = 1e-3


@dataclass(frozen=True)
class RisingBasis:
    """Curves over start ... stop with `spans` equal pieces: a constant plus rising steps with weights above zero."""

    start: float
    stop: float
    spans: int

    @property
    def size(self) -> int:
        """Number of rising steps; the constant comes on top."""
        return self.spans + 2

    def columns(self, places: np.ndarray) -> np.ndarray:
        """Rising steps (n, size) from 0 to 1 at the places (n,), which are taken as inside the range."""
        from scipy.interpolate import BSpline

        breaks = np.linspace(self.start, self.stop, self.spans + 1)
        knots = np.concatenate([[self.start] * 3, breaks, [self.stop] * 3])
        splines = BSpline.design_matrix(np.clip(places, self.start, self.stop), knots, 3).toarray()
        return np.cumsum(splines[:, ::-1], axis=1)[:, -2::-1]

    def slope_changes(self) -> np.ndarray:
        """Rows (size - 1, size): differences of neighbouring mean slopes, as a step over its width."""
        breaks = np.linspace(0.0, 1.0, self.spans + 1)
        knots = np.concatenate([[0.0] * 3, breaks, [1.0] * 3])
        widths = (knots[4 : 4 + self.size] - knots[1 : 1 + self.size]) / 3.0
        slopes: np.ndarray = np.diag(1.0 / widths)
        return np.diff(slopes, axis=0) / self.spans


def fit_rising(places: np.ndarray, values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Values at the increasing places `at` (m,) of the smooth rising curve next to the points (n,)."""
    basis = RisingBasis(float(at[0]), float(at[-1]), max(1, len(at) - 1))
    columns = basis.columns(places)
    height = float(np.ptp(values)) or 1.0
    constant, steps = solve_rising(columns, values / height, _STIFFNESS * basis.slope_changes())
    return np.maximum.accumulate(height * (constant + basis.columns(at) @ steps))


def noise_of_rising(places: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, float]:
    """For `fit_rising` of values with independent errors of one: the standard errors (m,) of its own values, and how
    many degrees of freedom it takes from the points. What is known by its never falling makes them no smaller.
    """
    basis = RisingBasis(float(at[0]), float(at[-1]), max(1, len(at) - 1))
    columns = basis.columns(places)
    means, count = columns.mean(axis=0), len(places)
    stacked = np.vstack([columns - means, _STIFFNESS * np.sqrt(count) * basis.slope_changes()])
    weights = np.linalg.pinv(stacked)[:, :count]
    gains = (basis.columns(at) - means) @ weights + 1.0 / count
    return np.linalg.norm(gains, axis=1), 1.0 + float(np.sum((columns - means) * weights.T))


def solve_rising(columns: np.ndarray, values: np.ndarray, penalty: np.ndarray) -> tuple[float, np.ndarray]:
    """Least squares of values (n,) with a free constant and columns (n, c) with weights that are not negative.

    The rows `penalty` (p, c) times the weights are kept small, as strongly as all samples together.
    """
    from scipy.optimize import nnls

    means = columns.mean(axis=0)
    stacked = np.vstack([columns - means, penalty * np.sqrt(len(columns))])
    target = np.concatenate([values - values.mean(), np.zeros(len(penalty))])
    _, triangle = np.linalg.qr(np.column_stack([stacked, target]))
    weights, _ = nnls(triangle[:, :-1], triangle[:, -1])
    return float(values.mean() - means @ weights), weights

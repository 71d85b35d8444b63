"""Tables of dynamic stiffness brought together: over bands of frequency, and over both directions of a sweep."""

from __future__ import annotations

import numpy as np

from .order_tracking import DynamicStiffness


def average_bands(stiffness: DynamicStiffness, edges: np.ndarray) -> DynamicStiffness:
    """One mean value per band of frequency between `edges` (b + 1,) Hz; bands without a window are left out.

    The confidence counts how many of the overlapping windows are independent.
    """
    bands = np.digitize(stiffness.frequency, edges)
    order = np.argsort(bands, kind="stable")
    order = order[(bands[order] > 0) & (bands[order] < len(edges))]
    if not order.size:
        raise ValueError(
            f"expected bands that hold some of {_span(stiffness.frequency)}, got edges {_span(np.asarray(edges))}; "
            "choose edges inside the tested range"
        )
    _, first, count = np.unique(bands[order], return_index=True, return_counts=True)

    def mean(values: np.ndarray) -> np.ndarray:
        return (np.add.reduceat(values[order], first, axis=0).T / count).T

    columns = {name: mean(getattr(stiffness, name)) for name in DynamicStiffness.columns()}
    columns["noise"] = np.sqrt(mean(stiffness.noise**2))
    columns["confidence"] = np.sqrt(mean(stiffness.confidence**2) / stiffness.independent(count))
    return stiffness.with_columns(columns)


def average_directions(up: DynamicStiffness, down: DynamicStiffness) -> DynamicStiffness:
    """Mean of an upward and a downward sweep at the frequencies of the upward one, where both have been.

    The error of the sweep rate has opposite signs in the two directions and cancels.
    """
    order = np.argsort(down.frequency)
    inside = (up.frequency >= down.frequency[order[0]]) & (up.frequency <= down.frequency[order[-1]])
    if not inside.any():
        raise ValueError(
            f"expected two sweeps over a common range, got {_span(up.frequency)} and {_span(down.frequency)}; "
            "pair runs of the same frequencies"
        )
    kept, there = up.select(inside), down.select(order)
    columns = {
        name: 0.5 * (getattr(kept, name) + _at(kept.frequency, there.frequency, getattr(there, name)))
        for name in DynamicStiffness.columns()
    }
    columns["confidence"] = columns["confidence"] / np.sqrt(2.0)
    return kept.with_columns(columns)


def split_directions(stiffness: DynamicStiffness) -> tuple[DynamicStiffness, DynamicStiffness]:
    """The windows in which the frequency rises and those in which it falls."""
    rising = stiffness.sweep_rate > 0.0
    return stiffness.select(rising), stiffness.select(~rising)


def _at(wanted: np.ndarray, frequency: np.ndarray, values: np.ndarray) -> np.ndarray:
    columns = values.reshape(len(values), -1).T
    found = np.stack([np.interp(wanted, frequency, column) for column in columns], axis=-1)
    return found.reshape(len(wanted), *values.shape[1:])


def _span(frequency: np.ndarray) -> str:
    return f"{np.min(frequency):.4g} to {np.max(frequency):.4g} Hz"

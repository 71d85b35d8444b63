"""Tables of dynamic stiffness brought together: over bands of frequency, and over both directions of a sweep."""

from __future__ import annotations

import numpy as np

from .order_tracking import DynamicStiffness


def average_bands(stiffness: DynamicStiffness, edges: np.ndarray) -> DynamicStiffness:
    """One mean value per band of frequency between `edges` (b + 1,) Hz; bands without a window are left out.

    The confidence counts how many of the overlapping windows are independent.
    """
    bands = np.digitize(stiffness.frequency, edges)
    members = [np.flatnonzero(bands == band) for band in range(1, len(edges)) if np.any(bands == band)]
    if not members:
        raise ValueError(
            f"expected bands that hold some of {_span(stiffness.frequency)}, got edges {_span(np.asarray(edges))}; "
            "choose edges inside the tested range"
        )
    return _joined([_mean(stiffness.select(member)) for member in members])


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


def _mean(stiffness: DynamicStiffness) -> DynamicStiffness:
    columns = {name: np.mean(getattr(stiffness, name), axis=0) for name in DynamicStiffness.columns()}
    columns["noise"] = np.sqrt(np.mean(stiffness.noise**2))
    columns["confidence"] = np.sqrt(np.mean(stiffness.confidence**2) / stiffness.independent)
    return stiffness.with_columns(columns)


def _joined(rows: list[DynamicStiffness]) -> DynamicStiffness:
    return rows[0].with_columns({name: np.stack([getattr(row, name) for row in rows]) for name in rows[0].columns()})


def _at(wanted: np.ndarray, frequency: np.ndarray, values: np.ndarray) -> np.ndarray:
    columns = values.reshape(len(values), -1).T
    found = np.stack([np.interp(wanted, frequency, column) for column in columns], axis=-1)
    return found.reshape(len(wanted), *values.shape[1:])


def _span(frequency: np.ndarray) -> str:
    return f"{np.min(frequency):.4g} to {np.max(frequency):.4g} Hz"

"""Which samples of a long record to draw: few enough for a page, without changing what the eye would see."""

from __future__ import annotations

import itertools

import numpy as np

CYCLES, CYCLE_POINTS, LEAST_POINTS = 6, 300, 200


def affordable(runs: int, columns: int, most: int, numbers: int) -> int:
    """Points a run, at most `most`, with which a table of so many runs and columns keeps to its `numbers`."""
    return max(LEAST_POINTS, min(most, numbers // (max(1, runs) * columns)))


def cycle_excerpts(time: np.ndarray, displacement: np.ndarray, points: int) -> list[np.ndarray]:
    """Sample indices of whole cycles, spread evenly over the record, at most `points` in all.

    Thinning a sweep evenly would tear its fast cycles apart, so entire cycles are kept and others left out. A record
    without repeated cycles (a quasi-static loop) or one short enough is one excerpt.
    """
    everything = np.arange(displacement.size)
    starts = _cycle_starts(displacement)
    if displacement.size <= points or starts.size < 3:
        return [thin(everything, points)]
    return [thin(everything[a : b + 2], CYCLE_POINTS) for a, b in _spread(time, starts, points)]


def thin(indices: np.ndarray, points: int) -> np.ndarray:
    """At most `points` of `indices`, evenly spaced, with the first and the last."""
    if indices.size <= points:
        return indices
    return indices[np.linspace(0, indices.size - 1, points).round().astype(int)]


def envelope(series: list[np.ndarray], points: int) -> np.ndarray:
    """Sample indices (at most `points`) that keep the lowest and highest value of each series in every stretch."""
    size = series[0].size
    if size <= points:
        return np.arange(size)
    edges = np.linspace(0, size, points // (2 * len(series)) + 1).astype(int)
    lowest_first = [np.where(np.isnan(values), np.inf, sign * values) for values in series for sign in (1.0, -1.0)]
    kept = [a + int(np.argmin(values[a:b])) for a, b in itertools.pairwise(edges) for values in lowest_first]
    return np.unique(kept)


def _cycle_starts(displacement: np.ndarray) -> np.ndarray:
    # upward passages of the middle; a dead band of a tenth of the stroke keeps noise from counting
    low, high = np.nanmin(displacement), np.nanmax(displacement)
    middle, band = (low + high) / 2.0, (high - low) / 20.0
    side = np.where(displacement > middle + band, 1, np.where(displacement < middle - band, -1, 0))
    decided = np.flatnonzero(side)
    rising = np.flatnonzero(np.diff(side[decided]) > 0)
    return decided[rising + 1]


def _spread(time: np.ndarray, starts: np.ndarray, points: int) -> list[tuple[int, int]]:
    last = starts.size - 2
    count = max(1, min(last + 1, CYCLES, points // CYCLE_POINTS))
    moments = np.linspace(time[starts[0]], time[starts[last]], count)
    chosen = np.unique(np.clip(np.searchsorted(time[starts], moments), 0, last))
    return [(int(starts[index]), int(starts[index + 1])) for index in chosen]

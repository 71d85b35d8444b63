"""Where a measured motion turns round."""

from __future__ import annotations

import numpy as np

from .white_noise import white_noise

# White noise stays inside ten standard deviations peak to peak, whatever the length of the record.
_NOISE_SPAN = 10.0


def turning_points(signal: np.ndarray, threshold: float) -> np.ndarray:
    """Samples at which the signal reverses by more than `threshold`, in time order, high and low in turn.

    Smaller wiggles, noise say, are passed over: a turning point is the extreme value between two ways that are longer
    than the threshold. Start and end are none.
    """
    points: list[int] = []
    high = low = rising = 0
    candidates = _local_extremes(signal)
    for sample, value in zip(candidates.tolist(), signal[candidates].tolist(), strict=True):
        high = sample if value > signal[high] else high
        low = sample if value < signal[low] else low
        if rising >= 0 and signal[high] - value > threshold:
            points += [high] * rising
            rising, low = -1, sample
        elif rising <= 0 and value - signal[low] > threshold:
            points += [low] * -rising
            rising, high = 1, sample
    return np.array(points, dtype=int)


def noise_threshold(signal: np.ndarray) -> float:
    """The reversal that white noise alone would not reach."""
    return _NOISE_SPAN * white_noise(signal)


def typical_swing(signal: np.ndarray) -> float:
    """The stroke by which half of the travelled way is made of longer, half of shorter strokes; 0 at rest."""
    ordered = np.sort(strokes(signal, noise_threshold(signal)))
    way = np.cumsum(ordered)
    return float(ordered[np.searchsorted(way, 0.5 * way[-1])])


def strokes(signal: np.ndarray, threshold: float) -> np.ndarray:
    """Lengths, all positive, of the ways between start, turning points and end."""
    return np.abs(np.diff(signal[stroke_edges(signal, threshold)]))


def stroke_edges(signal: np.ndarray, threshold: float) -> np.ndarray:
    """Samples of the start, the turning points and the end."""
    return np.concatenate([[0], turning_points(signal, threshold), [len(signal) - 1]])


def _local_extremes(signal: np.ndarray) -> np.ndarray:
    steps = np.diff(signal)
    moving = np.flatnonzero(steps)
    turns = moving[1:][np.sign(steps[moving[1:]]) != np.sign(steps[moving[:-1]])]
    return np.concatenate([[0], turns, [len(signal) - 1]])

"""Bringing repeated runs onto one time base, to a fraction of a sample."""

from __future__ import annotations

import numpy as np

# Half length of the interpolating kernel; it passes white noise up to a few percent of the Nyquist frequency.
_REACH = 24
_ROUNDS = 4
_SMALLEST_LAG = 1e-6


class NotRepeatsError(ValueError):
    """Runs that were said to repeat each other cannot be compared: they moved otherwise, or are too short."""


def lag_between(reference: np.ndarray, signal: np.ndarray) -> float:
    """By how many samples `signal` (m,) comes later than `reference` (n,); a fraction counts.

    The best whole number comes from the cross-correlation, the fraction from least squares on the slope. A harmonic
    motion fits at every period: the overlap then decides for the smallest shift.
    """
    lag = float(_whole_lag(reference, signal))
    for _ in range(_ROUNDS):
        start, stop = common_span(len(reference), [(len(signal), lag)])
        shifted = shifted_by(signal, lag, start, stop)
        slope = np.gradient(shifted)
        gap = reference[start:stop] - shifted
        slope, gap = slope - slope.mean(), gap - gap.mean()
        if not np.any(slope):
            return lag
        step = float(slope @ gap / (slope @ slope))
        lag += float(np.clip(step, -1.0, 1.0))
        if abs(step) < _SMALLEST_LAG:
            break
    return lag


def common_span(length: int, others: list[tuple[int, float]]) -> tuple[int, int]:
    """First and one-past-last sample of a run of `length` where others, given as (length, lag), can be read too.

    Raises NotRepeatsError where these are too few.
    """
    start, stop = 0, length
    for other, lag in others:
        start = max(start, int(np.ceil(_REACH - lag)))
        stop = min(stop, int(np.floor(other - _REACH - lag)))
    if stop - start < 2 * _REACH:
        raise NotRepeatsError(
            f"expected runs that overlap by {2 * _REACH} samples beyond the ends, got lags "
            f"{[round(lag, 1) for _, lag in others]} on {length} samples; "
            "measure longer, start them on one trigger, or do not name them repeats"
        )
    return start, stop


def shifted_by(signal: np.ndarray, lag: float, start: int, stop: int) -> np.ndarray:
    """The signal at the places start + lag ... stop + lag - 1, by a windowed sinc, which keeps the power of noise."""
    whole = int(np.round(lag))
    reach = np.arange(-_REACH, _REACH + 1)
    distance = reach - (lag - whole)
    kernel = np.sinc(distance) * np.cos(0.5 * np.pi * distance / (_REACH + 1)) ** 2
    piece = signal[start + whole - _REACH : stop + whole + _REACH]
    return np.convolve(piece, kernel[::-1] / kernel.sum(), mode="valid")


def _whole_lag(reference: np.ndarray, signal: np.ndarray) -> int:
    size = 2 ** int(np.ceil(np.log2(len(reference) + len(signal))))
    first = np.fft.rfft(signal - signal.mean(), size)
    second = np.fft.rfft(reference - reference.mean(), size)
    likeness = np.fft.irfft(first * second.conj(), size)
    lag = int(np.argmax(likeness))
    return lag if lag < len(signal) else lag - size

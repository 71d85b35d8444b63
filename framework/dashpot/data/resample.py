"""Changing the instants of sampling without changing what was measured."""

from __future__ import annotations

import numpy as np

# length and shape of the anti-alias filter: flat up to 80 % of the new Nyquist frequency, 90 dB down from there on
_HALF_PERIODS = 30
_KAISER_BETA = 9.0
_CUTOFF = 0.9


def advance(values: np.ndarray, samples: float) -> np.ndarray:
    """A lagging channel (n,) moved forward by a number of samples: its value at i is that at i + samples.

    Cubic spline: at 40 samples a period the error is below 2e-5 of the amplitude. Outside the record the ends repeat;
    `trim` cuts that off.
    """
    from scipy.interpolate import CubicSpline

    instants = np.arange(values.size, dtype=float)
    return CubicSpline(instants, values)(np.clip(instants + samples, 0, values.size - 1))


def trim(count: int, shifts: list[float]) -> slice:
    """The samples that all channels still have after they were advanced by `shifts` samples."""
    first = int(np.ceil(max(0.0, *(-shift for shift in shifts), 0.0)))
    return slice(first, count - int(np.ceil(max(0.0, *shifts, 0.0))))


def decimate(values: np.ndarray, factor: int) -> np.ndarray:
    """Every `factor`-th sample of (n,), after a low-pass of zero phase; the ends are continued by point reflection."""
    from scipy.signal import fftconvolve, firwin

    reach = min(_HALF_PERIODS * factor, values.size - 1)
    taps = firwin(2 * reach + 1, _CUTOFF / factor, window=("kaiser", _KAISER_BETA))
    before = 2 * values[0] - values[reach:0:-1]
    after = 2 * values[-1] - values[-2 : -reach - 2 : -1]
    return fftconvolve(np.concatenate([before, values, after]), taps, mode="valid")[::factor]

"""Forces with a memory, on a path refined to some points per sample."""

from __future__ import annotations

import numpy as np
from numba import njit
from scipy.interpolate import make_interp_spline
from scipy.signal import lfilter

FINE = 6


def slider(path: np.ndarray, reach: float) -> np.ndarray:
    """The stretch of a spring that slips beyond `reach` [m]: a Jenkins element of stiffness one."""
    return _slide(_refined(path), reach)[::FINE]


def bouc_wen(path: np.ndarray, reach: float) -> np.ndarray:
    """z' = (x' - 0.5 |x'| |z| z - 0.5 x' z^2)/reach, without unit."""
    return _wind(_refined(path), reach)[::FINE]


def maxwell(path: np.ndarray, time: float, rate: float) -> np.ndarray:
    """Stretch of a spring in series with a dashpot, relaxation time in s, that was at rest; `rate` samples per s."""
    decay = np.exp(-1.0 / (FINE * rate * time))
    changes = np.diff(_refined(path), prepend=path[0])
    return lfilter([(1.0 - decay) * time * rate * FINE], [1.0, -decay], changes)[::FINE]


def _refined(path: np.ndarray) -> np.ndarray:
    samples = np.arange(path.size)
    return make_interp_spline(samples, path, k=5)(np.linspace(0, path.size - 1, (path.size - 1) * FINE + 1))


@njit(cache=True)
def _slide(path: np.ndarray, reach: float) -> np.ndarray:
    stretch = np.zeros(path.size)
    for i in range(1, path.size):
        stretch[i] = min(reach, max(-reach, stretch[i - 1] + path[i] - path[i - 1]))
    return stretch


@njit(cache=True)
def _wind(path: np.ndarray, reach: float) -> np.ndarray:
    z = np.zeros(path.size)
    for i in range(1, path.size):
        step, old = path[i] - path[i - 1], z[i - 1]
        z[i] = old + (step - 0.5 * abs(step) * abs(old) * old - 0.5 * step * old * old) / reach
    return z

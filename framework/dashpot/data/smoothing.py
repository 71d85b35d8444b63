"""A noisy path made smooth: local polynomials, as long as the fastest part of the motion allows."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]

DEGREE = 8
PASSED = 0.3  # half width times frequency: up to there polynomials of this degree err by less than 1e-5
SHORTEST, LONGEST = 6, 60  # half widths in samples
STANDS_OUT = 3.0  # times the density of the white noise
FEWEST = 256  # samples that have a spectrum
OF_A_SHORT_PATH = 0.025  # periods a sample
PIECES, OVERLAP = 4, 0.7  # of a record whose spectra are averaged
LINES = 9  # of a spectrum that are averaged
WIDENED = 7  # lines by which a line is widened, by the window of a piece and by the average
NEGLIGIBLE = 1e-6  # of the mean square of the velocity


def smooth_path(dt: float, x: Array, noise: float) -> tuple[Array, Array, Array]:
    """Displacement, velocity and acceleration (n,) of a path sampled every ``dt``; ``noise`` is its white noise in m.

    Least squares by polynomials around every sample. Source: Savitzky and Golay, Anal. Chem. 36 (1964) 1627.
    """
    most = (x.size - 1) // 2
    half = min(int(np.clip(PASSED / max(fastest_part(x, noise), 1e-9), SHORTEST, LONGEST)), most)
    at = np.linspace(-1.0, 1.0, 2 * half + 1)
    fit = np.linalg.pinv(legendre.legvander(at, min(DEGREE, 2 * half)))
    place, speed, bend = (_moved_along(x, _rate(at, fit, order) / (dt * half) ** order) for order in range(3))
    return place, speed, bend


def fastest_part(x: Array, noise: float) -> float:
    """The frequency in periods a sample above which a path (n,) holds next to no velocity but that of white noise."""
    from scipy.signal import welch

    if x.size < FEWEST:
        return OF_A_SHORT_PATH
    length = max(x.size // PIECES, FEWEST)
    frequency, power = welch(x, 1.0, "blackmanharris", length, int(OVERLAP * length), detrend="linear")
    power = np.convolve(power, np.ones(LINES) / LINES, mode="same")[: power.size]
    excess = np.where(power > STANDS_OUT * 2.0 * noise**2, power, 0.0) * frequency**2
    above = np.cumsum(excess[::-1])[::-1]
    last = np.count_nonzero(above > NEGLIGIBLE * above[0]) - 1
    return float(frequency[max(last - WIDENED, 0)])


def _rate(at: Array, fit: NDArray[np.floating], order: int) -> Array:
    """Weights (2 half + 1, 2 half + 1): row by row the derivative at one place of a window from all samples of it."""
    basis = legendre.legder(np.eye(fit.shape[0]), order, axis=0) if order else np.eye(fit.shape[0])
    return legendre.legval(at, basis).T @ fit


def _moved_along(x: Array, weights: Array) -> Array:
    half = weights.shape[0] // 2
    middle = np.convolve(x, weights[half, ::-1], mode="valid")
    return np.concatenate([weights[:half] @ x[: 2 * half + 1], middle, weights[half + 1 :] @ x[-2 * half - 1 :]])

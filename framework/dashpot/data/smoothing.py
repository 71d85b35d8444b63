"""A noisy path made smooth: local polynomials, as long as the fastest part of the motion allows.

Where even the shortest ones would lose more of the motion than they take from the noise, the path is left as it is.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from dashpot.data.white_noise import white_noise

Array = NDArray[np.float64]

DEGREE = 8
PASSED = 0.3  # half width times frequency: up to there polynomials of this degree err by less than 1e-5
SHORTEST, LONGEST = 6, 60  # half widths in samples
STANDS_OUT = 3.0  # times the density of the white noise
FEWEST = 128  # samples that have a spectrum
LENGTH = 256  # samples of a piece, at least, where there are so many
OF_A_SHORT_PATH = 0.025  # periods a sample
PIECES, OVERLAP = 4, 0.7  # of a record whose spectra are averaged
LINES = 9  # of a spectrum that are averaged
WIDENED = 7  # lines by which a line is widened, by the window of a piece and by the average
NEGLIGIBLE = 1e-6  # of the mean square of the velocity
DARK = ("chebwin", 160.0)  # dB: what this window spreads is no noise
NOISE_ALONE = 0.2  # periods a sample: beyond half of all lines are taken for noise


def smooth_path(dt: float, x: Array, half: int) -> tuple[Array, Array, Array]:
    """Displacement, velocity and acceleration (n,) of a path sampled every ``dt``; windows have 2 ``half`` + 1 samples.

    Least squares by polynomials around every sample. Source: Savitzky and Golay, Anal. Chem. 36 (1964) 1627.
    """
    half = min(half, (x.size - 1) // 2)
    at, fit = _window(half)
    place, speed, bend = (_moved_along(x, _rate(at, fit, order) / (dt * half) ** order) for order in range(3))
    return place, speed, bend


def half_width(x: Array, noise: float) -> int:
    """The half width in samples with which a path (n,) with this white noise in m is smoothed."""
    return int(np.clip(PASSED / max(fastest_part(x, noise), 1e-9), SHORTEST, LONGEST))


def sensor_noise(x: Array) -> float:
    """The white noise in m on a path (n,), however fast the motion: beyond it and between its lines, noise is alone."""
    if x.size < FEWEST:
        return white_noise(x)
    frequency, power = _spectrum(x, DARK)
    return min(white_noise(x), float(np.sqrt(0.5 * np.median(power[frequency > NOISE_ALONE]))))


def gains(x: Array, noise: float, half: int) -> bool:
    """Whether windows of this half width give a better velocity than the interpolating quintic spline."""
    if x.size < FEWEST:
        return False
    frequency, power = _spectrum(x)
    # what the window of a piece spreads beyond the fastest part is no motion
    moving = (power > STANDS_OUT * 2.0 * noise**2) & (frequency <= fastest_part(x, noise) + frequency[1])
    at, fit = _window(half)
    steps = np.arange(-half, half + 1)
    weights = _rate(at, fit, 1)[half] / half
    smoothed = np.sin(2.0 * np.pi * np.outer(frequency, steps)) @ weights
    angle = 2.0 * np.pi * frequency
    spline = (50.0 * np.sin(angle) + 5.0 * np.sin(2.0 * angle)) / (33.0 + 26.0 * np.cos(angle) + np.cos(2.0 * angle))
    lost, spoilt = (
        np.sum(power[moving] * (response - angle)[moving] ** 2) + 2.0 * noise**2 * np.sum(response**2)
        for response in (smoothed, spline)
    )
    return bool(lost < spoilt)


def fastest_part(x: Array, noise: float) -> float:
    """The frequency in periods a sample above which a path (n,) holds next to no velocity but that of white noise."""
    if x.size < FEWEST:
        return OF_A_SHORT_PATH
    frequency, power = _spectrum(x)
    excess = np.where(power > STANDS_OUT * 2.0 * noise**2, power, 0.0) * frequency**2
    above = np.cumsum(excess[::-1])[::-1]
    last = np.count_nonzero(above > NEGLIGIBLE * above[0]) - 1
    return float(frequency[max(int(last) - WIDENED, 0)])


def _spectrum(x: Array, window: str | tuple[str, float] = "blackmanharris") -> tuple[Array, Array]:
    from scipy.signal import welch

    length = min(max(x.size // PIECES, LENGTH), x.size)
    frequency, power = welch(x, 1.0, window, length, int(OVERLAP * length), detrend="linear")
    return frequency, np.convolve(power, np.ones(LINES) / LINES, mode="same")[: power.size]


def _window(half: int) -> tuple[Array, NDArray[np.floating]]:
    at = np.linspace(-1.0, 1.0, 2 * half + 1)
    return at, np.linalg.pinv(legendre.legvander(at, min(DEGREE, 2 * half)))


def _rate(at: Array, fit: NDArray[np.floating], order: int) -> Array:
    """Weights (2 half + 1, 2 half + 1): row by row the derivative at one place of a window from all samples of it."""
    basis = legendre.legder(np.eye(fit.shape[0]), order, axis=0) if order else np.eye(fit.shape[0])
    return legendre.legval(at, basis).T @ fit


def _moved_along(x: Array, weights: Array) -> Array:
    half = weights.shape[0] // 2
    middle = np.convolve(x, weights[half, ::-1], mode="valid")
    return np.concatenate([weights[:half] @ x[: 2 * half + 1], middle, weights[half + 1 :] @ x[-2 * half - 1 :]])

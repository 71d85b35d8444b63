"""How a measured path gets its rates: the interpolating spline or the local polynomials with the best velocity.

Longer polynomials take more of the noise and lose more of the motion. Where even the shortest ones would lose more than
they take, the path is left as it is. At a corner, or at the fast end of a sweep, they are shorter than elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from dashpot.data.interpolating import FEWEST, FREQUENCIES, HIGH, QUINTIC, response_of_spline
from dashpot.data.white_noise import white_noise

Array = NDArray[np.float64]

DEGREE = 8
# of windows, in samples
HALF_WIDTHS = (6, 7, 8, 9, 10, 12, 14, 17, 20, 24, 29, 35, 42, 50, 60, 72, 86, 104, 125, 150, 180, 216, 260, 312, 375)
NOISE_OF_SPAN = 1e-6  # of the path: what is less is rounding
STANDS_OUT = 3.0  # times the density of the white noise
LENGTH = 256  # samples of a piece, at least, where there are so many
OF_A_SHORT_PATH = 12  # half width in samples
PIECES, OVERLAP = 4, 0.7  # of a record whose spectra are averaged
LINES = 9  # of a spectrum that are averaged
WIDENED = 7  # lines by which a line is widened, by the window of a piece and by the average
NEGLIGIBLE = 1e-6  # of the mean square of the velocity
QUIET = 0.25  # of a record: how far the shortest polynomials are off there is its noise
BY_CHANCE = 0.01  # of records with a place where noise alone makes the windows narrower
DARK = ("chebwin", 160.0)  # dB: what this window spreads is no noise
NOISE_ALONE = 0.2  # periods a sample: beyond half of all lines are taken for noise
NEAR_NYQUIST = 0.45  # periods a sample: the power from here on tells how much there is beyond the Nyquist frequency


@dataclass(frozen=True)
class Choice:
    """How a path gets its rates: polynomials of 2 ``half`` + 1 samples if ``smooth``, else a spline of ``degree``.

    ``narrower`` are half widths for where the motion is faster, each with the standard deviation in m a sample by which
    the noise makes its velocity another one than that of the width before.
    """

    half: int
    smooth: bool
    degree: int
    narrower: tuple[tuple[int, float], ...] = ()


def smooth_path(
    dt: float, x: Array, half: int, narrower: Sequence[tuple[int, float]] = ()
) -> tuple[Array, Array, Array]:
    """Displacement, velocity and acceleration (n,) of a path sampled every ``dt``; windows have 2 ``half`` + 1 samples.

    Least squares by polynomials around every sample. Where one of the ``narrower`` windows, as in ``Choice``, gives
    another velocity than the one before by more than noise does anywhere in 99 of 100 records, that one has lost
    motion, and so has every window of its width that holds the place: there the narrower one counts. Where the shortest
    polynomials leave more than elsewhere, there is as much more noise: that of a jitter goes with the speed.
    Sources: Savitzky and Golay, Anal. Chem. 36 (1964) 1627; Lepski, Theory of Probability and its Applications 35
    (1991) 454, for the choice of a width by place.
    """
    from scipy.special import ndtri

    half = min(half, (x.size - 1) // 2)
    found = last = _smoothed(dt, x, half)
    most = -ndtri(0.5 * BY_CHANCE / x.size) / dt * _noise_around(x, half) if narrower else 0.0
    lost = np.ones(x.size, dtype=bool)
    for narrow, noise in narrower:
        shorter = _smoothed(dt, x, narrow)
        apart = np.abs(shorter[1] - last[1]) > most * noise
        apart[:half] = apart[-half:] = False  # where polynomials end noise has more of a hold on them
        lost &= _mean_around(apart, half) > 0.0
        if not lost.any():
            break
        found += _mean_around(lost, narrow) * (shorter - found)
        half, last = narrow, shorter
    place, speed, bend = found
    return place, speed, bend


def _smoothed(dt: float, x: Array, half: int) -> Array:
    """Displacement, velocity and acceleration (3, n) by windows of one width."""
    at, fit = _window(half)
    return np.array([_moved_along(x, _rate(at, fit, order) / (dt * half) ** order) for order in range(3)])


def _noise_around(x: Array, half: int) -> Array:
    """How many times the noise around each sample (n,) is that of the quiet parts of the record, one at least."""
    rest = x - _moved_along(x, _rate(*_window(HALF_WIDTHS[0]), 0))
    square = _mean_around(rest**2, half)
    return np.sqrt(np.maximum(square / max(float(np.quantile(square, QUIET)), 1e-300), 1.0))


def _mean_around(values: NDArray[Any], half: int) -> Array:
    """The mean (n,) of the 2 ``half`` + 1 values around each one; at the ends of a record the last one goes on."""
    total = np.cumsum(np.concatenate([[0.0], np.pad(values, half, mode="edge")]))
    return np.asarray((total[2 * half + 1 :] - total[: -2 * half - 1]) / (2.0 * half + 1.0))


def best_rates(x: Array, noise: float, shown: float | None = None) -> Choice:
    """What gives the best velocity of a path (n,) with this white noise in m.

    What is expected is the motion that is lost, by the spectrum of the path, and the noise that passes; of splines
    also what they make of motions above the Nyquist frequency, which the samples show as slower ones. Where it is known
    up to which frequency, in periods a sample, the path is ``shown`` in the force, all that is faster is noise, be it
    white, a hum or the jitter of a clock, and below it there is as much.
    """
    if x.size < FEWEST:
        return Choice(OF_A_SHORT_PATH, False, QUINTIC)
    frequency, power = _spectrum(x)
    omega = 2.0 * np.pi * frequency
    passing = _noise_of(frequency, power, noise, shown)
    stands_out = power > STANDS_OUT * passing
    # what the window of a piece spreads beyond the fastest part is no motion
    moving = stands_out & (frequency <= _fastest_part(frequency, power * stands_out) + frequency[1])

    def expected(response: Array) -> float:
        """The mean square, but for a factor, of the velocity that is lost and of the noise that passes."""
        at = np.interp(frequency, FREQUENCIES, response)
        lost = np.sum(power[moving] * (at - omega)[moving] ** 2)
        return float(lost + np.sum(passing * at**2))

    beyond = 0.0 if shown is not None and shown < NEAR_NYQUIST else _near_nyquist(x, noise)

    def mistaken(response: Array) -> float:
        """The same for motions above the Nyquist frequency, which are taken to be as strong as those just below it."""
        at = np.interp(frequency, FREQUENCIES, response)
        return beyond * float(np.sum((at + 2.0 * np.pi - omega) ** 2))

    quintic, high = response_of_spline(QUINTIC), response_of_spline(HIGH)
    degree = HIGH if expected(high) + mistaken(high) < expected(quintic) + mistaken(quintic) else QUINTIC
    error, half = min((expected(_response(half)), half) for half in HALF_WIDTHS if 2 * half < x.size)
    noisy = noise > NOISE_OF_SPAN * np.ptp(x)
    smooth = bool(noisy) and error < expected(response_of_spline(degree))
    return Choice(half, smooth, degree, _narrower(half, frequency, passing))


def _narrower(half: int, frequency: Array, passing: Array) -> tuple[tuple[int, float], ...]:
    """Half widths below one, each half of the one before, and the noise of their differences; see ``Choice``."""
    found, wide = [], np.interp(frequency, FREQUENCIES, _response(half))
    while (half := half // 2) >= HALF_WIDTHS[0]:
        narrow = np.interp(frequency, FREQUENCIES, _response(half))
        found.append((half, float(np.sqrt(np.trapezoid(passing * (narrow - wide) ** 2, frequency)))))
        wide = narrow
    return tuple(found)


def _noise_of(frequency: Array, power: Array, noise: float, shown: float | None) -> Array:
    """The density (f,) of the noise: white, or what is faster than what is ``shown`` in the force."""
    # a line of the path and one of its coherence are both widened
    faster = frequency > (0.5 if shown is None else shown + 2 * WIDENED * frequency[1])
    if not faster.any():
        return np.full(frequency.size, 2.0 * noise**2)
    return np.where(faster, power, np.median(power[faster]))


def sensor_noise(x: Array) -> float:
    """The white noise in m on a path (n,), however fast the motion: beyond it and between its lines, noise is alone."""
    if x.size < FEWEST:
        return white_noise(x)
    frequency, power = _spectrum(x, DARK)
    return min(white_noise(x), float(np.sqrt(0.5 * np.median(power[frequency > NOISE_ALONE]))))


def _fastest_part(frequency: Array, power: Array) -> float:
    """The frequency in periods a sample above which a motion of this power (f,) holds next to no velocity."""
    above = np.cumsum((power * frequency**2)[::-1])[::-1]
    last = np.count_nonzero(above > NEGLIGIBLE * above[0]) - 1
    return float(frequency[max(int(last) - WIDENED, 0)])


def _near_nyquist(x: Array, noise: float) -> float:
    """The density of power (m^2 a line) just below the Nyquist frequency, but for that of the noise."""
    frequency, power = _spectrum(x, DARK)
    return max(float(np.mean(power[frequency > NEAR_NYQUIST])) - 2.0 * noise**2, 0.0)


def _spectrum(x: Array, window: str | tuple[str, float] = "blackmanharris") -> tuple[Array, Array]:
    from scipy.signal import welch

    length = min(max(x.size // PIECES, LENGTH), x.size)
    frequency, power = welch(x, 1.0, window, length, int(OVERLAP * length), detrend=_less_line)
    return frequency, np.convolve(power, np.ones(LINES) / LINES, mode="same")[: power.size]


def _less_line(piece: Array) -> Array:
    """A piece (..., n) less the straight line through it; that of scipy asks a general solver."""
    time = np.arange(piece.shape[-1]) - 0.5 * (piece.shape[-1] - 1)
    slope = piece @ time / (time @ time)
    return piece - piece.mean(axis=-1, keepdims=True) - np.multiply.outer(slope, time)


def _window(half: int) -> tuple[Array, NDArray[np.floating]]:
    at = np.linspace(-1.0, 1.0, 2 * half + 1)
    return at, np.linalg.pinv(legendre.legvander(at, min(DEGREE, 2 * half)))


@cache
def _response(half: int) -> Array:
    """The velocity (f,) per unit of displacement that a window gives at ``FREQUENCIES``."""
    at, fit = _window(half)
    weights = _rate(at, fit, 1)[half] / half
    found: Array = np.sin(2.0 * np.pi * np.outer(FREQUENCIES, np.arange(-half, half + 1))) @ weights
    return found


def _rate(at: Array, fit: NDArray[np.floating], order: int) -> Array:
    """Weights (2 half + 1, 2 half + 1): row by row the derivative at one place of a window from all samples of it."""
    basis = legendre.legder(np.eye(fit.shape[0]), order, axis=0) if order else np.eye(fit.shape[0])
    return legendre.legval(at, basis).T @ fit


def _moved_along(x: Array, weights: Array) -> Array:
    half = weights.shape[0] // 2
    middle = np.convolve(x, weights[half, ::-1], mode="valid")
    return np.concatenate([weights[:half] @ x[: 2 * half + 1], middle, weights[half + 1 :] @ x[-2 * half - 1 :]])

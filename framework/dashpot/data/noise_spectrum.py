"""The noise of a periodic signal, read between its orders, where only noise can be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .orders import TURN, Windows, place_windows

# Sums of cosines whose spectrum ends at the third and the fourth line: Blackman and Blackman-Harris, over that many
# periods, so that it ends half-way between two orders.
_WINDOWS = {
    6.0: (0.42, 0.5, 0.08),
    8.0: (0.35875, 0.48829, 0.14128, 0.01168),
}
_STEADY = 0.1
_ORDERS_READ = 24
_BINS_PER_OCTAVE = 3


@dataclass(frozen=True)
class NoiseSpectrum:
    """One-sided power density (m,) in unit^2/Hz over `frequency` (m,) Hz, of a signal sampled every `sample_time`."""

    frequency: np.ndarray
    density: np.ndarray
    sample_time: float

    @property
    def deviation(self) -> float:
        """Standard deviation of the noise: root of the integral from 0 to the Nyquist frequency."""
        edges = np.append(self.frequency, 0.5 / self.sample_time)
        density = np.append(self.density, self.density[-1])
        return float(np.sqrt(self._below() + np.trapezoid(density, edges)))

    def white_equivalent(self, frequency: np.ndarray) -> np.ndarray:
        """Standard deviation of the white noise that would have the same density at `frequency`."""
        return np.sqrt(np.interp(frequency, self.frequency, self.density) * 0.5 / self.sample_time)

    def flat_below(self) -> NoiseSpectrum:
        """The same with the density of the lowest octave from there down to zero."""
        level = np.mean(self.density[self.frequency <= 2.0 * self.frequency[0]])
        return NoiseSpectrum(np.append(0.0, self.frequency), np.append(level, self.density), self.sample_time)

    def _below(self) -> float:
        """Power below the lowest frequency that was read, where the density goes on as a first-order shape."""
        lowest = self.frequency[0]
        if lowest == 0.0 or self.density[0] == 0.0:
            return 0.0
        grid = np.linspace(0.0, lowest, 65)
        shape = _first_order_shape(self.frequency, self.density)
        return float(np.trapezoid(shape(grid), grid) * self.density[0] / shape(np.array([lowest]))[0])


def noise_between_orders(
    signal: np.ndarray, angle: np.ndarray, envelope: np.ndarray, sample_time: float
) -> NoiseSpectrum | None:
    """Noise of a signal (n,) that follows the phase `angle` (n,), without its orders; None when it is too short.

    In windows of eight (else six) periods the signal is read half-way between the orders; the window is such that the
    orders themselves, also slowly growing ones, do not show there. Windows in which the `envelope` (n,) of the motion
    changes by more than a tenth are left out. The median over like frequencies passes over single disturbances.
    """
    windows = _longest_windows(angle)
    steady = [_is_steady(envelope[start:stop]) for start, stop in zip(windows.start, windows.stop, strict=True)]
    readings = [_read_window(signal, angle, windows, window) for window in np.flatnonzero(steady).tolist()]
    if not readings:
        return None
    frequency = np.concatenate([frequency for frequency, _ in readings]) / sample_time
    density = np.concatenate([power for _, power in readings]) * 2.0 * sample_time
    return collect_spectrum(frequency, density, sample_time)


def collect_spectrum(frequency: np.ndarray, density: np.ndarray, sample_time: float) -> NoiseSpectrum:
    """Gather single readings of a density, each with an exponential distribution, in bins of a third of an octave."""
    bins = np.round(np.log2(frequency) * _BINS_PER_OCTAVE)
    members = [bins == centre for centre in np.unique(bins)]
    medians = [np.median(density[member]) / _median_of_exponential(int(member.sum())) for member in members]
    places = [np.mean(frequency[member]) for member in members]
    return NoiseSpectrum(np.array(places), np.array(medians), sample_time)


def _longest_windows(angle: np.ndarray) -> Windows:
    for periods in sorted(_WINDOWS, reverse=True):
        windows = place_windows(angle, periods, 0.5 * periods)
        if len(windows):
            break
    return windows


def _is_steady(envelope: np.ndarray) -> bool:
    return bool(np.ptp(envelope) <= _STEADY * np.max(envelope))


def _read_window(signal: np.ndarray, angle: np.ndarray, windows: Windows, window: int) -> tuple[np.ndarray, np.ndarray]:
    inside = slice(windows.start[window], windows.stop[window])
    local = angle[inside]
    speed = np.gradient(local)
    weights = speed * _cosine_sum((local - windows.centre[window]) / windows.periods, _WINDOWS[windows.periods])
    around = signal[inside] - weights @ signal[inside] / weights.sum()
    orders = _between_orders(TURN / np.max(speed))
    lines = np.einsum("i,ij->j", weights * around, np.exp(-1j * np.outer(local, orders)))
    return orders * np.average(speed, weights=weights) / TURN, np.abs(lines) ** 2 / np.sum(weights**2)


def _cosine_sum(angle: np.ndarray, coefficients: tuple[float, ...]) -> np.ndarray:
    return sum(coefficient * np.cos(multiple * angle) for multiple, coefficient in enumerate(coefficients))


def _between_orders(samples_per_period: float) -> np.ndarray:
    highest = max(0.5 * samples_per_period - 1.0, 1.0)
    return np.unique(np.geomspace(1.0, highest, _ORDERS_READ).astype(int) - 1) + 0.5


def _median_of_exponential(count: int) -> float:
    """Expected median of so many readings of mean one, the upper of the two middle ones averaged in when even."""
    upper = np.sum(1.0 / np.arange(count // 2 + 1, count + 1))
    return float(upper if count % 2 else upper + 1.0 / count)


def _first_order_shape(frequency: np.ndarray, density: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """Fit density = white + slow / (1 + (frequency / corner)^2), both parts positive, in relative terms."""
    from scipy.optimize import nnls

    def parts(at: np.ndarray, corner: float) -> np.ndarray:
        return np.stack([np.ones_like(at), 1.0 / (1.0 + (at / corner) ** 2)], axis=-1)

    corners = np.geomspace(frequency[0] / 3.0, frequency[-1], 40)
    scale = np.maximum(density, 1e-9 * np.max(density))[:, None]
    fits = [nnls(parts(frequency, corner) / scale, density / scale[:, 0]) for corner in corners]
    best = int(np.argmin([rest for _, rest in fits]))
    return lambda at: parts(at, corners[best]) @ fits[best][0]

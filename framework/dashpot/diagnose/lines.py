"""The strongest spectral line in the residuals of all runs: mains, a pump or a fan, whatever turns undriven."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LEVEL_WIDTH = 25.0  # resolutions of the shortest run over which the spectrum of what is no line is level
FEWEST_PLACES = 15  # whose median is that level
SPACING = 0.25  # of the resolution of the longest run
PADDING = 4
HANN = 1.5  # noise that passes its window, over that of a line's resolution
UNDERFLOW = -700.0


@dataclass(frozen=True)
class Line:
    """A line of ``frequency`` (Hz) at ``score`` standard deviations of pure noise, ``size`` in units of it (RMS)."""

    frequency: float
    score: float
    size: float


def strongest_line(white: Mapping[str, Array], steps: Mapping[str, float]) -> Line:
    """The line whose power over all runs is highest above its neighbours; ``white`` (n,) and ``steps`` (s) by run.

    The periodograms of white noise are exponentially distributed, their sum over runs by a gamma distribution; as
    many lines were tried as the grid has places. Where no run is long enough to show any, both numbers are zero.
    """
    from scipy.stats import gamma, norm

    runs, samples = len(white), sum(values.size for values in white.values())
    lengths = [values.size * steps[run] for run, values in white.items()]
    spacing = SPACING / max(lengths)
    grid = np.arange(1.0 / min(lengths), 0.5 / max(steps.values()), spacing)
    if grid.size == 0:
        return Line(0.0, 0.0, 0.0)
    power = np.sum([_periodogram(values, steps[run], grid) for run, values in white.items()], axis=0)
    width = max(FEWEST_PLACES, int(LEVEL_WIDTH / min(lengths) / spacing))
    height = power / np.maximum(_level(power, width) / gamma.median(runs), 1e-300)
    best = int(np.argmax(height))
    chance = max(gamma.logsf(height[best], runs) + np.log(grid.size), UNDERFLOW)
    size = np.sqrt(2.0 * HANN * max(height[best] - runs, 0.0) / samples)
    return Line(float(grid[best]), max(float(norm.isf(np.exp(min(chance, 0.0)))), 0.0), float(size))


def _level(power: Array, width: int) -> Array:
    """The median of pieces about ``width`` long, and straight lines between them."""
    pieces = np.array_split(np.arange(power.size), max(power.size // width, 1))
    middles, levels = zip(*((np.mean(piece), np.median(power[piece])) for piece in pieces), strict=True)
    return np.interp(np.arange(power.size), middles, levels)


def _periodogram(values: Array, step: float, grid: Array) -> Array:
    padded = PADDING * 2 ** int(np.ceil(np.log2(values.size)))
    window = np.hanning(values.size + 2)[1:-1]
    power = np.abs(np.fft.rfft(window * values, padded)) ** 2 / (window @ window)
    return np.interp(grid, np.arange(power.size) / (padded * step), power)

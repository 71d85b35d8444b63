"""How far, how fast and how often a motion goes: what a model that was identified with it has seen."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dashpot.data.drive import Drive
from dashpot.data.reversals import noise_threshold, turning_points

Ends = tuple[float, float]

STILL = 0.01  # of the median amplitude of the motions: below it what is left of the noise of a sensor at rest moves


def motion_range(drives: Sequence[Drive], smallest: float | None = None) -> dict[str, Ends]:
    """The least and the largest displacement (m), speed (m/s), amplitude, preload (m) and frequency (Hz) of motions.

    The last three are those of half cycles, from one turning point to the next: half the stroke, its middle, and half
    over its duration. Strokes below ``smallest`` m are no half cycles; by default that is the smallest amplitude that
    makes up a motion (the median of its strokes, by way), or the noise. They are left out where nothing turns.
    """
    found = {
        "displacement": _ends([drive.displacement for drive in drives]),
        "speed": (0.0, max(float(np.max(np.abs(drive.velocity))) for drive in drives)),
    }
    noise = [noise_threshold(drive.displacement) for drive in drives]
    typical = sorted(_typical(drive, least) for drive, least in zip(drives, noise, strict=True))
    usual = [each for each in typical if each > STILL * typical[len(typical) // 2]]
    if not usual:
        return found
    least = max(min(usual), *noise) if smallest is None else max(smallest, *noise)
    cycles = np.concatenate([_half_cycles(drive, least) for drive in drives])
    if not len(cycles):
        return found | {"amplitude": (min(usual), max(usual))}
    amplitude, preload, frequency = cycles.T
    largest = float(np.max(amplitude))
    return found | {
        "amplitude": (min(*usual, largest), largest),
        "preload": _ends([preload]),
        "frequency": _ends([frequency]),
    }


def _half_cycles(drive: Drive, least: float) -> np.ndarray:
    """Amplitude, preload and frequency (cycles, 3) of the half cycles whose strokes are longer than ``least``."""
    at = turning_points(drive.displacement, least)
    place = drive.displacement[at]
    return np.column_stack(
        [0.5 * np.abs(np.diff(place)), 0.5 * (place[1:] + place[:-1]), 0.5 / (drive.dt * np.diff(at))]
    )


def _typical(drive: Drive, noise: float) -> float:
    """The amplitude by which half of the way between turning points is made of larger, half of smaller ones, or 0."""
    strokes = np.sort(2.0 * _half_cycles(drive, noise)[:, 0])
    if not strokes.size:
        return 0.0
    way = np.cumsum(strokes)
    return 0.5 * float(strokes[np.searchsorted(way, 0.5 * way[-1])])


def _ends(columns: Sequence[np.ndarray]) -> Ends:
    return float(min(np.min(each) for each in columns)), float(max(np.max(each) for each in columns))

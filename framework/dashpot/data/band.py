"""The band of frequencies that was driven."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from dashpot.data.drive import Drive

LEAST_STROKE = 0.01  # of the largest: in a smaller one the speed is mostly that of noise
WITHIN = 0.98  # of the square of the velocity


def end_of_band(drives: Collection[Drive], stroke: float) -> float:
    """The highest frequency in Hz that was driven: of a sweep its end, of many sines the fastest that matters.

    Rigs drive small strokes faster than large ones, so every motion counts whose stroke is not far below ``stroke`` in
    m; of a ramp it is one over its length.
    """
    return max(_highest(drive) for drive in drives if np.ptp(drive.displacement) >= LEAST_STROKE * stroke)


def _highest(drive: Drive) -> float:
    power = np.cumsum(np.abs(np.fft.rfft(drive.velocity)) ** 2)
    place = max(1, int(np.searchsorted(power, WITHIN * power[-1])))
    return float(np.fft.rfftfreq(drive.samples, drive.dt)[place])

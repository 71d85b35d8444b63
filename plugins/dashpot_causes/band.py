"""The band of frequencies that was driven, and what lies so far beyond it that it shows as a mass."""

from __future__ import annotations

import numpy as np

from dashpot.contract.cause import View

HIGHEST = 2.0  # times the end of the band: a mass on a spring that is stiffer is a mass
LEAST_STROKE = 0.01  # of the largest: in a smaller one the speed is mostly that of noise
WITHIN = 0.98  # of the square of the velocity


def end_of_band(view: View) -> float:
    """The highest frequency in Hz that was driven: of a sweep its end, of many sines the fastest that matters.

    Rigs drive small strokes faster than large ones, so every run counts; of a ramp it is one over its length.
    """
    strokes = {run: float(np.ptp(view.displacement(run))) for run in view.runs}
    return max(_highest(view, run) for run, stroke in strokes.items() if stroke >= LEAST_STROKE * view.stroke)


def _highest(view: View, run: str) -> float:
    velocity, dt = view.velocity(run), view.step(run)
    power = np.cumsum(np.abs(np.fft.rfft(velocity)) ** 2)
    place = max(1, int(np.searchsorted(power, WITHIN * power[-1])))
    return float(np.fft.rfftfreq(velocity.size, dt)[place])

"""Under which conditions a run was made: as the dataset names them, else as its motion shows them, rounded."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from dashpot.data.order_tracking import Oscillation
from dashpot.data.run import Run

STEADY = 1.1  # a frequency that changes by less than this factor over a run is one frequency
DIGITS = 2


@dataclass(frozen=True)
class Conditions:
    """``amplitude`` and ``preload`` (mean deflection) in m; ``frequency`` in Hz, None for a sweep."""

    amplitude: float
    preload: float
    frequency: float | None


def conditions_of(run: Run, track: Oscillation) -> Conditions:
    """The nominal conditions of an oscillating run, alike for runs that were meant alike.

    Where the dataset says nothing, amplitude and frequency are rounded to two digits and the preload to the decade of
    the amplitude.
    """
    amplitude = run.settings.get("amplitude", rounded(float(np.median(np.abs(track.motion))), DIGITS))
    preload = run.settings.get("preload", _to_decade(float(np.median(track.preload)), amplitude))
    return Conditions(amplitude, preload, _steady_frequency(run, track))


def rounded(value: float, digits: int) -> float:
    """A number with so many significant digits."""
    return float(f"{value:.{digits}g}")


def _to_decade(value: float, scale: float) -> float:
    decade = 10.0 ** np.floor(np.log10(scale)) if scale > 0.0 else 0.0
    return float(np.round(value / decade) * decade) + 0.0 if decade else value


def _steady_frequency(run: Run, track: Oscillation) -> float | None:
    if np.max(track.frequency) > STEADY * np.min(track.frequency):
        return None
    return run.settings.get("frequency", rounded(float(np.median(track.frequency)), DIGITS))

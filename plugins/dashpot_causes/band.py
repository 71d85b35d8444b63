"""The band of frequencies that was driven, and what lies so far beyond it that it shows as a mass."""

from __future__ import annotations

import numpy as np

from dashpot.contract.cause import View

HIGHEST = 2.0  # times the end of the band: a mass on a spring that is stiffer is a mass


def end_of_band(view: View) -> float:
    """About the highest frequency in Hz that was driven at the largest stroke."""
    return float(view.speed / (np.pi * view.stroke))

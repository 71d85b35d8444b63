"""Motions at constant speed from turn to turn."""

from __future__ import annotations

import numpy as np

from .reversals import turning_points

# of the way, by which what is no stroke may turn back
TURNS = 0.1
# root mean square departure of a stroke from a straight line, over its length: half of that of half a sine, 0.0426
_STRAIGHT = 0.0213
_MOST = 0.9  # of the strokes
# half a sine of fewer samples may look straight: three lie on a line
_SAMPLES = 8


def is_triangle(displacement: np.ndarray) -> bool:
    """Whether nine of ten full strokes of a motion (n,) are straight, be they round at the turns; False without any.

    At a turn up to three tenths of a stroke may be round, on either side. A sine that grows until the actuator goes no
    faster has straight strokes, too, but others before them.
    """
    turns = turning_points(displacement, TURNS * float(np.ptp(displacement)))
    bends = [_bend(displacement[first : last + 1]) for first, last in zip(turns[:-1], turns[1:], strict=True)]
    return bool(bends) and float(np.quantile(bends, _MOST)) < _STRAIGHT


def _bend(stroke: np.ndarray) -> float:
    if stroke.size < _SAMPLES:
        return 1.0
    place = np.linspace(-1.0, 1.0, stroke.size)
    rest = stroke - np.mean(stroke)
    rest = rest - (place @ rest) / (place @ place) * place
    return float(np.sqrt(np.mean(rest**2)) / abs(stroke[-1] - stroke[0]))

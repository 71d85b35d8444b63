"""Bands of frequency with round edges."""

from __future__ import annotations

import numpy as np

Band = tuple[float, float]

COUNT = 5
STEPS = (1.0, 2.0, 5.0, 10.0)
ROUNDING = 1e-9


def frequency_bands(low: float, high: float) -> list[Band]:
    """About five bands of equal width with round edges, in Hz, that cover low to high."""
    raw = (high - low) / COUNT
    decade = 10.0 ** np.floor(np.log10(raw))
    width = decade * next(step for step in STEPS if step * decade >= raw * (1.0 - ROUNDING))
    edges = width * np.arange(np.floor(low / width + ROUNDING), np.ceil(high / width - ROUNDING) + 1.0)
    return [(float(a), float(b)) for a, b in zip(edges, edges[1:], strict=False)]

"""Forces without memory: elastic tables, dampers, factors over deflection."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator


def elastic(at, force, x):
    """The monotone cubic through a table, continued by its end slopes."""
    cubic = PchipInterpolator(at, force)
    slope = cubic.derivative()
    inside = cubic(np.clip(x, at[0], at[-1]))
    return inside + slope(at[0]) * np.minimum(x - at[0], 0.0) + slope(at[-1]) * np.maximum(x - at[-1], 0.0)


def factor(at, values, x):
    """The monotone cubic through a table, held beyond its ends."""
    return PchipInterpolator(at, values)(np.clip(x, at[0], at[-1]))

"""A row of a table of dynamic stiffness, from its complex stiffness."""

from __future__ import annotations

import numpy as np

from dashpot.data.run import Run
from dashpot.data.steady import STEADY, cosine, sine, steady_samples


def row(
    name: str,
    frequency: float,
    amplitude: float,
    stiffness: complex,
    preload: float = 0.0,
    scatter: float = 0.0,
    **settings: float,
) -> Run:
    count = steady_samples(frequency)
    force = amplitude * (stiffness.real * sine(count) + stiffness.imag * cosine(count))
    sensors = {"force": {"noise": scatter * amplitude}} if scatter else {}
    told = {"frequency": frequency, "amplitude": amplitude, "preload": preload, **settings}
    channels = {"displacement": preload + amplitude * sine(count), "force": force}
    return Run(name, STEADY, np.arange(count) / (100.0 * frequency), channels, told, group=name, sensors=sensors)

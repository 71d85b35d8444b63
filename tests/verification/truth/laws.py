"""The laws as differential equations, dF/dt for a velocity v, each for a whole array of branches.

Maxwell (1.4), Dahl in its general form (1.5), Prandtl as a spring in series with a Dahl slider (1.6), hydro (1.9).
"""

from __future__ import annotations

import numpy as np


def maxwell_rate(force, v, stiffness, relaxation_time):
    return stiffness * v - force / relaxation_time


def dahl_slope(force, side, stiffness, limit, exponent=1.0):
    """dF/dx of a slider that moves to ``side`` (1 or -1)."""
    left = 1.0 - side * force / limit
    return stiffness * np.abs(left) ** exponent * np.sign(left)


def prandtl_slope(force, side, stiffness, limit, sharpness=10.0, exponent=1.0):
    """dF/dx of a spring in series with a slider ``sharpness`` times as stiff."""
    left = np.maximum(1.0 - side * force / limit, 0.0)
    slider = sharpness * stiffness * left**exponent
    return stiffness * slider / (stiffness + slider)


def hydro_rates(force, flow, v, fluid_mass, stiffness, damping):
    """dF/dt of the bulging walls, and the acceleration of the fluid behind them."""
    return stiffness * (v - flow), (force - damping * flow) / fluid_mass

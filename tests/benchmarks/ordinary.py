"""What one would write without a framework: a scalar loop with explicit Euler steps, compiled by numba."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numba import njit
from numpy.typing import NDArray
from truth import FACTOR_AT, SHARPNESS
from workload import DT, KNOTS

Array = NDArray[np.float64]


def euler_force(path: tuple[Array, Array], numbers: Mapping[str, float]) -> Array:
    """The force (samples,) of tire model 5 along displacement and velocity, tables by straight lines."""
    x, v = path
    carcass = np.interp(x, KNOTS, [numbers[f"stiffness.stiffness[{k}]"] for k in range(KNOTS.size)])
    factor = np.interp(x, FACTOR_AT, [numbers[f"damping.scale[{k}]"] for k in range(FACTOR_AT.size)])
    kinds = (("maxwell", "relaxation_time"), ("prandtl", "limit"))
    rows = [
        np.array([[numbers[f"{name}_{k}.stiffness"], numbers[f"{name}_{k}.{key}"]] for k in (1, 2, 3)])
        for name, key in kinds
    ]
    dahl = np.array([numbers["friction.stiffness"], numbers["friction.limit"]])
    return euler(x, carcass + numbers["damping.damping"] * factor * v, *rows, dahl, DT)


@njit(error_model="numpy")
def euler(x, static, maxwell, prandtl, dahl, dt):  # noqa: ANN001, ANN201
    """The force along a sampled path; every law is as it stands in a textbook."""
    force = np.empty(x.size)
    relaxing, sliding, friction = np.zeros(3), np.zeros(3), 0.0
    for k in range(x.size):
        travel = x[k] - x[k - 1] if k else 0.0
        side = 1.0 if travel > 0.0 else -1.0
        total = static[k]
        for i in range(3):
            relaxing[i] += maxwell[i, 0] * travel - dt * relaxing[i] / maxwell[i, 1]
            slope = SHARPNESS * prandtl[i, 0] * max(1.0 - side * sliding[i] / prandtl[i, 1], 0.0)
            sliding[i] += travel * prandtl[i, 0] * slope / (prandtl[i, 0] + slope)
            total += relaxing[i] + sliding[i]
        friction += travel * dahl[0] * (1.0 - side * friction / dahl[1])
        force[k] = total + friction
    return force

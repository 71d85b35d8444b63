"""What one would write without a framework: a scalar loop with explicit Euler steps, compiled by numba."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numba import njit
from numpy.typing import NDArray
from truth import FACTOR_AT, SHARPNESS
from workload import DT, KNOTS, Sweep

Array = NDArray[np.float64]


def euler_force(sweep: Sweep, numbers: Mapping[str, float]) -> Array:
    """The force (samples,) of tire model 5, tables by straight lines."""
    x, v, _ = sweep.path(sweep.time)
    return euler(x, v, *euler_numbers(numbers), DT)


def euler_numbers(numbers: Mapping[str, float]) -> tuple[Array, ...]:
    """The numbers of a network in arrays."""
    kinds = (("maxwell", ("stiffness", "relaxation_time")), ("prandtl", ("stiffness", "limit")))
    rows = [np.array([[numbers[f"{name}_{k}.{key}"] for key in keys] for k in (1, 2, 3)]) for name, keys in kinds]
    carcass = np.array([numbers[f"stiffness.stiffness[{k}]"] for k in range(KNOTS.size)])
    factor = numbers["damping.damping"] * np.array([numbers[f"damping.scale[{k}]"] for k in range(FACTOR_AT.size)])
    return (
        KNOTS,
        carcass,
        FACTOR_AT,
        factor,
        *rows,
        np.array([numbers["friction.stiffness"], numbers["friction.limit"]]),
    )


@njit(error_model="numpy")
def euler(x, v, knots, carcass, factor_at, factor, maxwell, prandtl, dahl, dt):  # noqa: ANN001, ANN201
    """The force along a sampled path; every law is as it stands in a textbook."""
    force = np.empty(x.size)
    relaxing, sliding, friction = np.zeros(3), np.zeros(3), 0.0
    for k in range(x.size):
        travel = x[k] - x[k - 1] if k else 0.0
        side = 1.0 if travel > 0.0 else -1.0
        total = np.interp(x[k], knots, carcass) + np.interp(x[k], factor_at, factor) * v[k]
        for i in range(3):
            relaxing[i] += maxwell[i, 0] * travel - dt * relaxing[i] / maxwell[i, 1]
            slope = SHARPNESS * prandtl[i, 0] * max(1.0 - side * sliding[i] / prandtl[i, 1], 0.0)
            sliding[i] += travel * prandtl[i, 0] * slope / (prandtl[i, 0] + slope)
            total += relaxing[i] + sliding[i]
        friction += travel * dahl[0] * (1.0 - side * friction / dahl[1])
        force[k] = total + friction
    return force

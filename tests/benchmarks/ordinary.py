"""What one would write without a framework: a scalar loop with explicit Euler steps, compiled by numba."""

from __future__ import annotations

import time
from statistics import median

import numpy as np
from numba import njit
from workload import DT, runs

MAXWELL = np.array([[8e3, 0.160], [8e3, 0.032], [12e3, 0.0064]])
PRANDTL = np.array([[20e3, 6.0], [14e3, 20.0], [9e3, 60.0]])
DAHL = np.array([60e3, 15.0])


def euler_nanoseconds(rounds: int) -> float:
    """Time per sample of one parameter vector on the twelve sweeps."""
    drives = runs()
    times = []
    for number in range(rounds + 1):
        began = time.perf_counter()
        for drive in drives:
            _euler(drive.displacement, drive.velocity, MAXWELL, PRANDTL, DAHL, DT)
        if number:
            times.append(time.perf_counter() - began)
    return 1e9 * median(times) / (len(drives) * drives[0].samples)


@njit(error_model="numpy")
def _euler(x, v, maxwell, prandtl, dahl, dt):  # noqa: ANN001, ANN202
    relaxing, sliding, friction = np.zeros(3), np.zeros(3), 0.0
    total = 0.0
    for k in range(1, x.size):
        travel = x[k] - x[k - 1]
        side = 1.0 if travel > 0.0 else -1.0
        force = 1.8e5 * x[k] + 1e6 * x[k] ** 2 + 40.0 * (1.5 - 20.0 * x[k]) * v[k]
        for i in range(3):
            relaxing[i] += maxwell[i, 0] * travel - dt * relaxing[i] / maxwell[i, 1]
            stiff = 10.0 * prandtl[i, 0] * max(1.0 - side * sliding[i] / prandtl[i, 1], 0.0)
            sliding[i] += travel * prandtl[i, 0] * stiff / (prandtl[i, 0] + stiff)
            force += relaxing[i] + sliding[i]
        friction += travel * dahl[0] * (1.0 - side * friction / dahl[1])
        total += (force + friction) ** 2
    return total

"""Laws with memory as differential equations along a given smooth motion, for solve_ivp.

Hydro (1.9), a mass hung on a spring, Stribeck in a Dahl slider (1.13), Bouc-Wen in its classical numbers, warming up.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.integrate import solve_ivp

Rate = Callable[[float, np.ndarray], Sequence[float]]


def integrate(rate: Rate, start: Sequence[float], times: np.ndarray, turns: Sequence[float] = ()) -> np.ndarray:
    """The memories (count, n) at ``times``; the integration begins anew at every turning point."""
    found = np.empty((len(start), times.size))
    found[:, 0], state = start, np.array(start, dtype=float)
    inside = [turn for turn in turns if times[0] < turn < times[-1]]
    ends = [times[0], *inside, times[-1]]
    for begin, end in zip(ends, ends[1:], strict=False):
        here = (times > begin) & (times <= end)
        at = times[here] if here.any() and times[here][-1] == end else np.append(times[here], end)
        answer = solve_ivp(
            rate, (begin, end), state, method="DOP853", rtol=1e-10, atol=1e-13, t_eval=at, max_step=(end - begin) / 50.0
        )
        assert answer.success
        found[:, here] = answer.y[:, : here.sum()]
        state = answer.y[:, -1]
    return found


def hydro_rate(place, mass, wall, damping, turbulence=0.0, chamber=0.0) -> Rate:
    """Place and velocity of the fluid while the piston is at ``place(t)``."""

    def rate(t, y):
        force = wall * (place(t) - y[0]) - chamber * y[0] - damping * y[1] - turbulence * abs(y[1]) * y[1]
        return [y[1], force / mass]

    return rate


def absorber_pull(stretch, rate, stiffness, damping, turbulence=0.0):
    """The force of spring and dashpot on a mass that hangs on them."""
    return stiffness * stretch + damping * rate + turbulence * abs(rate) * rate


def absorber_rate(place, speed, mass, *numbers) -> Rate:
    """Place and velocity of a mass that hangs on what moves as ``place(t)`` with ``speed(t)``."""

    def rate(t, y):
        return [y[1], absorber_pull(place(t) - y[0], speed(t) - y[1], *numbers) / mass]

    return rate


def stribeck_rate(speed, stiffness, limit, breakaway, stribeck_velocity) -> Rate:
    """The force of a slider that moves with ``speed(t)``."""

    def rate(t, force):
        v = speed(t)
        now = limit + (breakaway - limit) * np.exp(-((v / stribeck_velocity) ** 2))
        return stiffness * (v - abs(v) * force / now)

    return rate


def bristles(rate: Rate, time, bent, stiffness, damping, speeds) -> np.ndarray:
    """The force (n,) of ``bent`` bristles with damping, sigma_0 z + sigma_1 dz/dt; none while they are let go."""
    bending = np.array([rate(t, force) for t, force in zip(time, bent, strict=True)]) / stiffness
    return bent + damping * np.where(bending * speeds > 0.0, bending, 0.0)


def bouc_wen_rate(speed, a, beta, gamma, exponent) -> Rate:
    """z' = A x' - beta |x'| |z|^(n - 1) z - gamma x' |z|^n."""

    def rate(t, z):
        v, power = speed(t), np.abs(z) ** exponent
        return a * v - beta * abs(v) * power * np.sign(z) - gamma * v * power

    return rate

"""A mass on ideal friction: smooth equations between events, each of which is located."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

EXACT = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-13, "max_step": 2e-3, "dense_output": True}


def _until(rates, event, direction, time, y, at):
    """The path (2, n) at those times ``at`` that lie before the event, which they are, and where it ends and why."""

    def ends(t, y):
        return event(t, y)

    ends.terminal, ends.direction = True, direction
    run = solve_ivp(rates, (time, at[-1]), y, events=ends, **EXACT)
    inside = (at >= time) & (at <= run.t[-1])
    path = run.sol(at[inside]) if inside.any() else np.zeros((2, 0))
    return path, inside, run.t[-1], run.y[:, -1]


def force_on_a_slider(motion, at, mass, stiffness, limit):
    """The force at a base that carries a mass by ideal friction and a spring, from rest.

    The mass sticks until the friction that it needs exceeds the limit, and slides until it is as fast as the base.
    """

    def needed(t, y):
        return mass * motion.bend(t) - stiffness * (motion.place(t) - y[0])

    time, y, side, found = at[0], np.zeros(2), 0.0, np.zeros(at.size)
    while time < at[-1]:
        if side:
            rates = lambda t, y, side=side: [y[1], (stiffness * (motion.place(t) - y[0]) + side * limit) / mass]  # noqa: E731
            event, direction = lambda t, y: motion.speed(t) - y[1], -side
        else:
            rates = lambda t, y: [motion.speed(t), motion.bend(t)]  # noqa: E731
            event, direction = lambda t, y: limit - abs(needed(t, y)), -1.0
        path, inside, time, y = _until(rates, event, direction, time, y, at)
        friction = side * limit if side else needed(at[inside], path)
        found[inside] = stiffness * (motion.place(at[inside]) - path[0]) + friction
        rest = needed(time, y)
        side = np.sign(rest) if not side or abs(rest) > limit else 0.0
    return found

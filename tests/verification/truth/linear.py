"""Linear systems along cosines, solved exactly: the cosines are states of one matrix exponential."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm
from verification.truth.motion import Cosines


@dataclass(frozen=True)
class StateSpace:
    """y' = a y + b (x, x', x'', 1), force = c y + d (x, x', x'', 1)."""

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray

    def force(self, motion: Cosines, times: np.ndarray) -> np.ndarray:
        """The force at equally spaced times from 0 on, from the equilibrium."""
        count, omegas = self.a.shape[0], motion.omegas
        # x, x', x'', 1 from the states 1, cos(w t), sin(w t)
        none, cosine, sine = np.zeros(omegas.size), motion.amplitudes, -motion.amplitudes * omegas
        see = np.array(
            [
                [motion.mean, *cosine, *none],
                [0.0, *none, *sine],
                [0.0, *(-cosine * omegas**2), *none],
                [1.0, *none, *none],
            ]
        )
        turning = np.zeros((1 + 2 * omegas.size,) * 2)
        for number, omega in enumerate(omegas, 1):
            turning[number, number + omegas.size], turning[number + omegas.size, number] = -omega, omega
        whole = np.block([[self.a, self.b @ see], [np.zeros((see.shape[1], count)), turning]])
        # all lengths and forces in one size would lose digits in the exponential
        begin = np.concatenate([[1.0], np.ones(omegas.size), np.zeros(omegas.size)])
        state = np.concatenate([np.linalg.solve(self.a, -self.b @ (see @ begin)), begin])
        step, out = expm(whole * (times[1] - times[0])), np.hstack([self.c, self.d @ see])
        found = np.empty(times.size)
        for number in range(times.size):
            found[number] = out @ state
            state = step @ state
        return found

    def stiffness(self, omega: float) -> complex:
        """The complex stiffness in the steady state."""
        rates = np.array([1.0, 1j * omega, -(omega**2), 0.0])
        states = np.linalg.solve(1j * omega * np.eye(self.a.shape[0]) - self.a, self.b @ rates)
        return complex(self.c @ states + self.d @ rates)


def quarter_car(m, body, k, d, ks, ds, gravity=0.0, tire_offset=0.0, offset=0.0) -> StateSpace:
    """Platform, tire, wheel, suspension, body that is free to move; states: both places and velocities."""
    a = np.array(
        [
            [0, 1, 0, 0],
            [-(k + ks) / m, -(d + ds) / m, ks / m, ds / m],
            [0, 0, 0, 1],
            [ks / body, ds / body, -ks / body, -ds / body],
        ],
        dtype=float,
    )
    b = np.array(
        [
            [0, 0, 0, 0],
            [k / m, d / m, 0, (k * tire_offset - ks * offset) / m - gravity],
            [0, 0, 0, 0],
            [0, 0, 0, ks * offset / body - gravity],
        ],
        dtype=float,
    )
    return StateSpace(a, b, np.array([-k, -d, 0, 0], dtype=float), np.array([k, d, 0, k * tire_offset], dtype=float))


def zener(k, k_inner, d_inner) -> StateSpace:
    """A spring in series with a spring and a damper in parallel; the state is the deflection of those."""
    return StateSpace(
        np.array([[-(k + k_inner) / d_inner]]),
        np.array([[k / d_inner, 0.0, 0.0, 0.0]]),
        np.array([-k]),
        np.array([k, 0.0, 0.0, 0.0]),
    )


def three_in_series(k, d, k_last, d_last) -> StateSpace:
    """A spring, a damper, and a spring beside a damper, one behind the other: two places between them."""
    # F = k (x - z1), z2' = (F - k_last z2)/d_last, z1' = z2' + F/d
    a = np.array([[-k / d - k / d_last, -k_last / d_last], [-k / d_last, -k_last / d_last]])
    b = np.array([[k / d + k / d_last, 0.0, 0.0, 0.0], [k / d_last, 0.0, 0.0, 0.0]])
    return StateSpace(a, b, np.array([-k, 0.0]), np.array([k, 0.0, 0.0, 0.0]))


def chain(m1, m2, k1, d1, k2, b2, k3, d3) -> StateSpace:
    """Two masses in a chain to the ground, spring and inerter between them, moved behind a spring and a damper."""
    mass = np.array([[m1 + b2, -b2], [-b2, m2 + b2]])
    stiff, damped = np.array([[k1 + k2, -k2], [-k2, k2 + k3]]), np.diag([d1, d3])
    pushed = np.linalg.solve(mass, np.array([[k1, d1, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]]))
    a = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(mass, stiff), -np.linalg.solve(mass, damped)]])
    return StateSpace(
        a, np.vstack([np.zeros((2, 4)), pushed]), np.array([-k1, 0.0, -d1, 0.0]), np.array([k1, d1, 0.0, 0.0])
    )

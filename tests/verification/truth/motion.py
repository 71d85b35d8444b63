"""Smooth motions that begin at rest, with their exact rates at any time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import null_space


@dataclass(frozen=True)
class Cosines:
    """x(t) = mean + sum of amplitude cos(omega t); times may be arrays."""

    mean: float
    amplitudes: np.ndarray
    omegas: np.ndarray

    def place(self, t):
        return self.mean + np.cos(np.multiply.outer(t, self.omegas)) @ self.amplitudes

    def speed(self, t):
        return -np.sin(np.multiply.outer(t, self.omegas)) @ (self.amplitudes * self.omegas)

    def bend(self, t):
        return -np.cos(np.multiply.outer(t, self.omegas)) @ (self.amplitudes * self.omegas**2)

    def scaled(self, factor: float) -> Cosines:
        """The motion about its place at the begin, by a factor."""
        start = float(self.place(0.0))
        return Cosines(start + factor * (self.mean - start), factor * self.amplitudes, self.omegas)


def smooth_motion(rng, place, amplitude, lowest=3.0, highest=20.0, count=6) -> Cosines:
    """Random cosines between two frequencies in Hz; at the begin x is ``place`` and x' to x''''' are zero."""
    omegas = 2.0 * np.pi * np.sort(rng.uniform(lowest, highest, count))
    free = null_space(np.array([(omegas / omegas[-1]) ** 2, (omegas / omegas[-1]) ** 4]))
    amplitudes = free @ rng.standard_normal(free.shape[1])
    shape = Cosines(0.0, amplitudes, omegas)
    reach = np.max(np.abs(shape.place(np.linspace(0.0, 1.0, 2000)) - shape.place(0.0)))
    amplitudes = amplitudes * amplitude / reach
    return Cosines(place - amplitudes.sum(), amplitudes, omegas)

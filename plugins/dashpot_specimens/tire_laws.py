"""What the tire answers to its deflection: carcass, sliding rubber, relaxing rubber. None is an element of dashpot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.signal import fftconvolve
from scipy.special import gamma, gammaincc

from dashpot_specimens.tire_path import STEP, DrivenPath


@dataclass(frozen=True)
class Tire:
    """A passenger car tire at standstill; lengths in m, forces in N.

    carcass: tangent `stiffness` at first contact, rising by `hardening` (exp(x / hardening_length) - 1).
    sliding: Iwan's sliders, their stiffness spread over all yield travels between two ends by a power law, and
    scaled by the contact patch, x / (x + `patch_length`).
    relaxing: modulus exp(-sqrt(t / relaxation_time)), plus a damper, both scaled by a level that falls with x.
    """

    stiffness: float = 172e3
    hardening: float = 32e3
    hardening_length: float = 25e-3

    sliding_stiffness: float = 13e3
    travel_power: float = -0.35
    shortest_travel: float = 0.03e-3
    longest_travel: float = 8e-3
    patch_length: float = 1e-3

    relaxing_stiffness: float = 58e3
    relaxation_time: float = 15e-3
    damping: float = 40.0
    level_length: float = 18e-3

    def force(self, path: DrivenPath) -> np.ndarray:
        """Force along a path that begins with the tire relaxed and shaken free of friction, shape (steps,)."""
        return self.carcass(path.deflection) + self.sliding(path.deflection) + self.relaxing(path)

    def carcass(self, x: np.ndarray) -> np.ndarray:
        """Elastic force."""
        reach = x / self.hardening_length
        return self.stiffness * x + self.hardening * self.hardening_length * (np.expm1(reach) - reach)

    def sliding(self, x: np.ndarray) -> np.ndarray:
        """Force of the sliders, 60 of them."""
        edges = np.geomspace(self.shortest_travel, self.longest_travel, 61)
        travels = np.sqrt(edges[1:] * edges[:-1])
        stiffness = self.sliding_stiffness * (travels / 3e-3) ** self.travel_power * np.log(edges[1:] / edges[:-1])
        return x / (x + self.patch_length) * slide(x, stiffness, travels)

    def relaxing(self, path: DrivenPath) -> np.ndarray:
        """Hereditary force, the modulus averaged over each step, and viscous force."""
        changes = np.diff(path.deflection)
        edges = np.sqrt(np.arange(changes.size + 1) * STEP / self.relaxation_time)
        modulus = -2 * self.relaxation_time / STEP * gamma(2) * np.diff(gammaincc(2, edges))
        remembered = np.concatenate([[0.0], fftconvolve(changes, modulus)[: changes.size]])
        level = 1 / (1 + (path.deflection / self.level_length) ** 2)
        return level * (self.relaxing_stiffness * remembered + self.damping * path.velocity)


@njit(cache=True)
def slide(path, stiffness, travels):  # type: ignore[no-untyped-def]
    """Summed force of elastic sliders, exact between the points of the path."""
    stretch = np.zeros(travels.size)
    force = np.zeros(path.size)
    for i in range(1, path.size):
        change = path[i] - path[i - 1]
        total = 0.0
        for j in range(travels.size):
            stretch[j] = min(max(stretch[j] + change, -travels[j]), travels[j])
            total += stiffness[j] * stretch[j]
        force[i] = total
    return force

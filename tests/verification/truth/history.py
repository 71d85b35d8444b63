"""Forces with memory along a given motion, integrated with solve_ivp from turning point to turning point."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp
from verification.truth.laws import dahl_slope, hydro_rates, maxwell_rate, prandtl_slope

TOLERANCES = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-10}


@dataclass
class Histories:
    """Branches whose forces are integrated together; each is asked for by its law and its numbers."""

    maxwells: list[tuple[float, ...]] = field(default_factory=list)
    dahls: list[tuple[float, ...]] = field(default_factory=list)
    prandtls: list[tuple[float, ...]] = field(default_factory=list)
    hydros: list[tuple[float, ...]] = field(default_factory=list)

    def family(self, word: str) -> list[tuple[float, ...]]:
        return {"maxwell": self.maxwells, "dahl": self.dahls, "prandtl": self.prandtls, "hydro": self.hydros}[word]

    def ask(self, word: str, numbers: tuple[float, ...]) -> None:
        if numbers not in self.family(word):
            self.family(word).append(numbers)

    def place(self, word: str, numbers: tuple[float, ...]) -> int:
        """Which of the integrated forces belongs to a branch; behind that of a hydro element is its flow."""
        first, second, third = self.ends
        begin, width = {"maxwell": (0, 1), "dahl": (first, 1), "prandtl": (second, 1), "hydro": (third, 2)}[word]
        return begin + width * self.family(word).index(numbers)

    @property
    def ends(self) -> tuple[int, int, int]:
        """Where the forces of each family end."""
        first = len(self.maxwells)
        second = first + len(self.dahls)
        return first, second, second + len(self.prandtls)

    @property
    def count(self) -> int:
        return self.ends[-1] + 2 * len(self.hydros)

    def rate(self, velocity: Callable[[float], float], side: float) -> Callable[[float, np.ndarray], np.ndarray]:
        """dF/dt of all branches while the motion goes to one side."""
        first, second, third = self.ends
        maxwells, dahls, prandtls, hydros = (
            np.array(family).T for family in (self.maxwells, self.dahls, self.prandtls, self.hydros)
        )

        def rate(time: float, force: np.ndarray) -> np.ndarray:
            v = velocity(time)
            found = np.empty_like(force)
            if first:
                found[:first] = maxwell_rate(force[:first], v, *maxwells)
            if second > first:
                found[first:second] = v * dahl_slope(force[first:second], side, *dahls)
            if third > second:
                found[second:third] = v * prandtl_slope(force[second:third], side, *prandtls)
            if force.size > third:
                found[third::2], found[third + 1 :: 2] = hydro_rates(force[third::2], force[third + 1 :: 2], v, *hydros)
            return found

        return rate

    def along_cubics(self, dt: float, x: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Forces (branches, n) at samples of the path of cubics through positions and velocities, from rest."""
        forces = np.zeros((self.count, x.size))
        for k in range(x.size - 1):
            speed = hermite_velocity(dt, x[k], x[k + 1], v[k], v[k + 1])
            ends = [0.0, *turning_times(speed, dt), dt]
            force = forces[:, k]
            for begin, end in zip(ends, ends[1:], strict=False):
                side = np.sign(speed(0.5 * (begin + end)))
                found = solve_ivp(self.rate(speed, side), (begin, end), force, **TOLERANCES)
                assert found.success
                force = found.y[:, -1]
            forces[:, k + 1] = force
        return forces

    def along_curve(self, velocity: Callable[[float], float], turns: np.ndarray, times: np.ndarray) -> np.ndarray:
        """Forces (branches, n) at ``times`` of a smooth motion that turns at ``turns``, from rest."""
        forces = np.zeros((self.count, times.size))
        force = np.zeros(self.count)
        inside = turns[(turns > times[0]) & (turns < times[-1])]
        ends = np.concatenate([times[:1], inside, times[-1:]])
        for begin, end in zip(ends, ends[1:], strict=False):
            here = (times > begin) & (times <= end)
            at = np.append(times[here], end) if not here.any() or times[here][-1] < end else times[here]
            side = np.sign(velocity(0.5 * (begin + end)))
            found = solve_ivp(self.rate(velocity, side), (begin, end), force, t_eval=at, max_step=2e-3, **TOLERANCES)
            assert found.success
            forces[:, here] = found.y[:, : here.sum()]
            force = found.y[:, -1]
        return forces


def hermite_velocity(dt: float, x0: float, x1: float, v0: float, v1: float) -> Callable[[float], float]:
    """The velocity over a step of the cubic with these positions and velocities at its ends."""

    # derivatives of the four Hermite polynomials
    def velocity(time: float) -> float:
        u = time / dt
        return (6 * u * u - 6 * u) * (x0 - x1) / dt + (3 * u * u - 4 * u + 1) * v0 + (3 * u * u - 2 * u) * v1

    return velocity


def turning_times(velocity: Callable[[float], float], dt: float) -> list[float]:
    """Where a quadratic velocity changes its sign inside a step."""
    begin, middle, end = velocity(0.0), velocity(0.5 * dt), velocity(dt)
    polynomial = [2 * (begin - 2 * middle + end), -3 * begin + 4 * middle - end, begin]
    roots = np.roots(polynomial)
    real = np.sort(roots[np.abs(roots.imag) < 1e-12].real)
    return [dt * float(root) for root in real if 0.0 < root < 1.0] if real.size < 2 or real[0] != real[1] else []

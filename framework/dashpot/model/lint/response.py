"""How each branch answers small harmonic motions of many sizes and speeds around many points."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.model.lint.law import Array, Law
from dashpot.model.network import Branch
from dashpot.model.topology import Topology

Complex = NDArray[np.complex128]

STEPS = 32  # of a cycle
SLOWEST, FASTEST = 1e-2, 3e2  # Hz
SMALLEST, LARGEST = 1e-6, 2e-2  # amplitude in m
REACH = 1e-2  # m, where no table says how far the deflection goes


@dataclass(frozen=True, eq=False)
class Trials:
    """Harmonic motions: one angular frequency (lanes,) for all edges, a middle and an amplitude for each."""

    omega: Array
    middle: tuple[Array, ...]
    amplitude: tuple[Array, ...]


@dataclass(frozen=True, eq=False)
class Answer:
    """How an edge answers its trials: complex stiffness and mean force (lanes,)."""

    stiffness: Complex
    mean: Array

    def split(self, count: int) -> list[Answer]:
        """The answers of so many blocks of lanes."""
        return [Answer(*pair) for pair in zip(np.split(self.stiffness, count), np.split(self.mean, count), strict=True)]

    def scaled(self, factor: float) -> Answer:
        """The answer of a branch with so many times the force."""
        return Answer(factor * self.stiffness, factor * self.mean)


def draw_trials(topology: Topology, lanes: int, seed: int = 0) -> Trials:
    """Random motions that reach all knots of all tables; edges between the same nodes move alike."""
    rng = np.random.default_rng(seed)
    omega = 2.0 * np.pi * np.exp(rng.uniform(np.log(SLOWEST), np.log(FASTEST), lanes))
    between: dict[frozenset[str], list[Branch]] = {}
    for edge in topology.edges:
        between.setdefault(frozenset((edge.lower, edge.upper)), []).append(edge.branch)
    motions = {pair: _draw_motion(branches, omega, rng) for pair, branches in between.items()}
    found = [motions[frozenset((edge.lower, edge.upper))] for edge in topology.edges]
    # the same motion is a deflection of the other sign for a branch that lies the other way round
    signs = [1.0 if edge.lower < edge.upper else -1.0 for edge in topology.edges]
    return Trials(
        omega,
        tuple(sign * middle for sign, (middle, _) in zip(signs, found, strict=True)),
        tuple(amplitude for _, amplitude in found),
    )


def _draw_motion(branches: Iterable[Branch], omega: Array, rng: np.random.Generator) -> tuple[Array, Array]:
    curves = [curve for branch in branches for curve in branch.characteristics().values() if curve.at]
    places = [at for curve in curves if curve.curve.over[1] == "m" for at in curve.at] or [-REACH, REACH]
    speeds = [abs(at) for curve in curves if curve.curve.over[1] == "m/s" for at in curve.at]
    low, high = min(places), max(places)
    middle = rng.uniform(low, high, omega.size)
    amplitude = np.exp(rng.uniform(np.log(SMALLEST), np.log(max(LARGEST, high - low)), omega.size))
    if speeds:
        fast = rng.uniform(0.1, 1.5, omega.size) * max(speeds) / omega
        amplitude = np.where(rng.random(omega.size) < 0.5, fast, amplitude)
    return middle, amplitude


def answer_of(law: Law, omega: Array, middle: Array, amplitude: Array) -> Answer:
    """The answer of a law: first harmonic and mean of the second cycle of a motion from rest."""
    angle = 2.0 * np.pi * np.arange(2 * STEPS + 1)[:, None] / STEPS
    path = middle + amplitude * np.sin(angle)
    velocity = amplitude * omega * np.cos(angle)
    acceleration = -amplitude * omega**2 * np.sin(angle)
    force = law.force(path, velocity, acceleration, 2.0 * np.pi / (STEPS * omega))[STEPS:]
    first = 2.0 / STEPS * np.sum(force * np.exp(-1j * angle[STEPS + 1 :]), axis=0)
    return Answer(1j * first / amplitude, force.mean(axis=0))

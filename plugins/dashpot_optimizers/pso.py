"""Particle swarm."""

from __future__ import annotations

import numpy as np

from dashpot.contract.optimizer import Blocks, Search, Space
from dashpot_optimizers.latin_hypercube import scatter
from dashpot_optimizers.option import require

WORTHWHILE = 1e-6
TOGETHER = 0.9


class ParticleSwarm(Search):
    """Particles drawn to the best place of their own and to the best one of their neighbours on a ring.

    particles: size of the swarm; iterations: blocks asked, the first included; neighbours: how many a particle follows
    on each side of the ring; inertia, pull: share of the velocity that is kept, strength of both pulls; fastest: the
    largest move in one coordinate; stall: iterations without a relative gain of 1e-6 after which the search ends.

    Kennedy and Eberhart, Proc. ICNN (1995) 1942. The random strength of a pull is mostly one number for the whole
    particle instead of one for each coordinate: then the swarm does not depend on the axes, and narrow oblique
    valleys (stiffness against relaxation time) do not stop it.
    """

    word = "pso"
    needs = "losses"

    def __init__(
        self,
        particles: int = 96,
        iterations: int = 200,
        neighbours: int = 10,
        inertia: float = 0.6,
        pull: float = 1.7,
        fastest: float = 0.2,
        stall: int = 40,
    ):
        require("particles", particles, 2)
        require("iterations", iterations, 1)
        require("neighbours", neighbours, 1)
        require("inertia", inertia, 0.0, 1.0)
        require("pull", pull, 0.0, 4.0)
        require("fastest", fastest, 1e-6, 1.0)
        require("stall", stall, 1)
        self.particles, self.iterations, self.neighbours = particles, iterations, neighbours
        self.inertia, self.pull, self.fastest, self.stall = inertia, pull, fastest, stall

    def search(self, space: Space, rng: np.random.Generator) -> Blocks:
        """Move the swarm until it stalls."""
        ring = self._ring()
        places = scatter(rng, self.particles, space.start)
        velocities = rng.uniform(-self.fastest, self.fastest, places.shape)
        memory, worth = places, (yield places)
        record, idle = worth.min(), 0
        for _ in range(1, self.iterations):
            guides = memory[ring[np.arange(self.particles), worth[ring].argmin(axis=1)]]
            places, velocities = reflect(places, self._velocities(rng, velocities, memory - places, guides - places))
            losses = yield places
            better = losses < worth
            memory, worth = np.where(better[:, None], places, memory), np.where(better, losses, worth)
            idle = 0 if worth.min() < record * (1.0 - WORTHWHILE) else idle + 1
            record = worth.min() if idle == 0 else record
            if idle == self.stall:
                return f"no gain in {self.stall} iterations"
        return f"{self.iterations} iterations done"

    def _ring(self) -> np.ndarray:
        """The numbers of each particle's neighbours, itself included: (particles, neighbours)."""
        reach = min(self.neighbours, self.particles // 2)
        return (np.arange(self.particles)[:, None] + np.arange(-reach, reach + 1)) % self.particles

    def _velocities(
        self, rng: np.random.Generator, velocities: np.ndarray, to_own: np.ndarray, to_guide: np.ndarray
    ) -> np.ndarray:
        together = rng.random((len(velocities), 1)) < TOGETHER
        own, guide = (self._strengths(rng, together, velocities.shape) for _ in range(2))
        wanted = self.inertia * velocities + own * to_own + guide * to_guide
        return np.clip(wanted, -self.fastest, self.fastest)

    def _strengths(self, rng: np.random.Generator, together: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
        return self.pull * np.where(together, rng.random((shape[0], 1)), rng.random(shape))


def reflect(places: np.ndarray, velocities: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Move by at most 1 in each coordinate; who would leave the unit cube bounces off its wall."""
    moved = places + velocities
    outside = (moved < 0.0) | (moved > 1.0)
    inside = np.clip(1.0 - np.abs(1.0 - np.abs(moved)), 0.0, 1.0)
    return np.where(outside, inside, moved), np.where(outside, -velocities, velocities)

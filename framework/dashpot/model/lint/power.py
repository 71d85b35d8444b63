"""Factors that make a branch give back more work than was put in."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dashpot.model.lint.law import Array, Law
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import Problem

LANES, STEPS, WAVES = 32, 240, 3
SLOWEST, FASTEST = 1e-2, 1e2  # Hz
TOLERANCE = 5e-3  # of all work that goes to and fro


def find_pumps(spec: NetworkSpec) -> Iterator[Problem]:
    """Branches whose law is passive by itself but not with its factor over deflection."""
    for branch in spec.leaves():
        if branch.scale and branch.element.passive and not branch.shares and _gains(Law.of(branch)) > TOLERANCE:
            place = branch.scale.node.place if branch.scale.node else branch.place
            yield Problem(
                place,
                f"with its factor over deflection the branch '{branch.name}' can generate energy",
                "use the factor on a law that dissipates at every instant",
                "warning",
            )


def _gains(law: Law) -> float:
    """The most work that comes back, as a share of all that goes to and fro."""
    path, velocity, acceleration, dt = _closed_paths(max(map(abs, law.branch.scale.at)) if law.branch.scale else 1.0)
    force = law.force(path, velocity, acceleration, dt)
    # the trapezoid over each step; a law without memory has at the first instant the force that it has at the last
    before = np.concatenate([0.0 * force[:1] if law.branch.element.declares.states else force[-1:], force[:-1]])
    work = 0.5 * (before + force) * np.diff(path, axis=0)
    done, moved = np.cumsum(work, axis=0), np.sum(np.abs(work), axis=0)
    # a memory is empty at first and can give back nothing; without one, closed paths alone say what was lost
    least = np.min(done, axis=0) if law.branch.element.declares.states else done[-1]
    share = -least / np.where(moved > 0.0, moved, np.inf)
    return float(np.nanmax(share, initial=0.0))


def _closed_paths(reach: float) -> tuple[Array, Array, Array, Array]:
    """Paths (STEPS + 1, LANES) from 0 and back to it, at every speed, beyond the knots of the factor."""
    rng = np.random.default_rng(1)
    period = 1.0 / np.exp(rng.uniform(np.log(SLOWEST), np.log(FASTEST), LANES))
    angle = 2.0 * np.pi * np.arange(STEPS + 1)[:, None, None] / STEPS
    waves = np.arange(1, WAVES + 1)[:, None]
    size = rng.uniform(-1.0, 1.0, (WAVES, LANES)) / waves
    turned = waves * angle + rng.uniform(0.0, 2.0 * np.pi, (WAVES, LANES))
    path = np.sum(size * np.sin(turned), axis=1)
    stretch = 1.5 * reach / np.max(np.abs(path - path[0]), axis=0)
    omega = 2.0 * np.pi / period
    velocity = omega * np.sum(size * waves * np.cos(turned), axis=1)
    acceleration = -(omega**2) * np.sum(size * waves**2 * np.sin(turned), axis=1)
    return stretch * (path - path[0]), stretch * velocity, stretch * acceleration, period / STEPS

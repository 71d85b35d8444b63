"""The mass of a wheel without a model of its tire: contact force over wheel motion, the body being held."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .order_tracking import follow, harmonics_of

Array = NDArray[np.float64]

LEVEL = 0.975
CLUSTER = 1.5  # Hz: neighbouring windows of a sweep share their error
REFERENCE = 5e-3  # m
STARTING = 0.3  # of the largest wheel amplitude: below it friction sticks


@dataclass(frozen=True, eq=False)
class WheelRun:
    """A dynamic run of a wheel: its motion ``wheel`` (n,) m, the contact ``force`` (n,) N, ``added_mass`` kg on it."""

    wheel: Array
    force: Array
    sample_time: float
    added_mass: float = 0.0


@dataclass(frozen=True)
class WheelMass:
    """``mass`` in kg with its 95 % ``interval``; ``compliance`` in m/N of what is in series with the damper, 0 where it
    was taken as rigid; ``residual``: N/m, what the regression leaves."""

    mass: float
    interval: tuple[float, float]
    compliance: float
    residual: float


def wheel_mass(runs: Sequence[WheelRun], elastic: bool = False) -> WheelMass:
    """The mass of a wheel from Re(F / z) = k + friction - m w^2 over all runs, the added masses taken off.

    k is the spring. The friction of the suspension, sliding over an amplitude A much longer than its own travel, adds
    stiffness like A^-1.5. ``elastic`` adds what a damper in series with rubber of the compliance c does, c Im(F / z)^2,
    which looks like a negative mass otherwise. It assumes damping that is proportional to speed; a digressive damper
    leaves a part of the bias. The interval holds the scatter of the regression between bands of frequency, not what the
    form of the equation leaves out. Raises NotOscillatingError for runs that are no sweeps, and ValueError where the
    sweeps see too little of the frequencies to tell mass from spring.
    """
    rows = [_points(run) for run in runs]
    omega, amplitude, storage, loss = np.concatenate(rows, axis=1)
    clusters = np.concatenate(
        [np.floor(row[0] / (2.0 * np.pi * CLUSTER)) + 1e3 * number for number, row in enumerate(rows)]
    )
    columns = [-(omega**2), np.ones_like(omega), (amplitude / REFERENCE) ** -1.5] + [loss**2] * elastic
    design = np.column_stack(columns)
    size = np.sqrt(np.mean(design**2, axis=0))
    found, _, rank, _ = np.linalg.lstsq(design / size, storage, rcond=1e-10)
    if rank < design.shape[1] or np.unique(clusters).size <= 2 * design.shape[1]:
        raise ValueError(
            "expected sweeps over a range of frequencies and amplitudes, got too little to tell mass from "
            "spring; sweep through the wheel resonance"
        )
    residual = storage - design / size @ found
    width = _half_width(design / size, residual, clusters)
    mass, half = float(found[0] / size[0]), float(width / size[0])
    compliance = float(found[3] / size[3]) if elastic else 0.0
    return WheelMass(mass, (mass - half, mass + half), compliance, float(np.sqrt(np.mean(residual**2))))


def _points(run: WheelRun) -> Array:
    """Angular frequency rad/s, amplitude m, storage and loss N/m of the wheel without the added mass, (4, windows)."""
    stiffness = harmonics_of(run.force, follow(run.wheel, run.sample_time))
    moving = stiffness.amplitude > STARTING * stiffness.amplitude.max()
    omega = 2.0 * np.pi * stiffness.frequency
    storage = stiffness.storage + run.added_mass * omega**2
    return np.array([omega, stiffness.amplitude, storage, stiffness.loss])[:, moving]


def _half_width(design: Array, residual: Array, clusters: Array) -> float:
    # of the first number: sandwich with the bands of each run as clusters, corrected like a jackknife
    from scipy.special import stdtrit

    bread = np.linalg.inv(design.T @ design)
    names = np.unique(clusters)
    scores = []
    for name in names:
        own = design[clusters == name]
        free = np.eye(len(own)) - own @ bread @ own.T
        scores.append(own.T @ np.linalg.solve(free, residual[clusters == name]))
    meat = np.array(scores).T @ np.array(scores) * (len(names) - 1) / len(names)
    return float(stdtrit(len(names) - design.shape[1], LEVEL) * np.sqrt((bread @ meat @ bread)[0, 0]))

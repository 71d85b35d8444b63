"""How far the force of a run is a multiple of what all other runs foretell for it, without a model.

The forces of the others are fitted by a handful of general functions of deflection and velocity; the run that spoils
that fit most is the odd one, and its force is compared with the forecast.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.run import Run

Array = NDArray[np.float64]

SAMPLES = 2000
RIDGE = 1e-8
FEWEST = 3


@dataclass(frozen=True)
class Likeness:
    """``gain``: force over forecast; ``likeness``: share of the force's square that gain times forecast explains.

    ``others`` are the gains of the other runs against one another.
    """

    run: str
    gain: float
    likeness: float
    others: tuple[float, ...]


def odd_one(runs: Sequence[Run]) -> Likeness | None:
    """The run without which the others agree best; None for fewer than three runs."""
    if len(runs) < FEWEST:
        return None
    shapes = _shapes(runs)
    forces = [_thinned(run.force, run) for run in runs]
    grams = [rows @ rows.T / (force @ force) for rows, force in zip(shapes, forces, strict=True)]
    rights = [rows @ force / (force @ force) for rows, force in zip(shapes, forces, strict=True)]
    tries = [_without(number, shapes, forces, grams, rights) for number in range(len(runs))]
    odd = int(np.argmin([misfit for misfit, _, _ in tries]))
    _, coefficients, gains = tries[odd]
    forecast = coefficients @ shapes[odd]
    gain, likeness = _compare(forces[odd], forecast)
    return Likeness(runs[odd].name, gain, likeness, tuple(gains))


def _without(
    number: int, shapes: Sequence[Array], forces: Sequence[Array], grams: Sequence[Array], rights: Sequence[Array]
) -> tuple[float, Array, list[float]]:
    others = [k for k in range(len(forces)) if k != number]
    gram = np.sum([grams[k] for k in others], axis=0)
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    matrix = gram / np.outer(scale, scale) + RIDGE * np.eye(scale.size)
    coefficients = np.linalg.solve(matrix, np.sum([rights[k] for k in others], axis=0) / scale) / scale
    found = [_compare(forces[k], coefficients @ shapes[k]) for k in others]
    misfits = [
        np.mean((forces[k] - coefficients @ shapes[k]) ** 2) / max(float(np.mean(forces[k] ** 2)), 1e-300)
        for k in others
    ]
    return float(np.mean(np.minimum(misfits, 1.0))), coefficients, [gain for gain, _ in found]


def _compare(force: Array, forecast: Array) -> tuple[float, float]:
    power = float(forecast @ forecast)
    if power == 0.0:
        return 0.0, 0.0
    gain = float(force @ forecast) / power
    left = force - gain * forecast
    return gain, 1.0 - float(left @ left) / max(float(force @ force), 1e-300)


def _shapes(runs: Sequence[Run]) -> list[Array]:
    reach = float(np.median([np.max(np.abs(run.displacement)) for run in runs])) or 1.0
    velocities = [np.gradient(run.displacement, run.sample_time) for run in runs]
    speed = float(np.median([np.quantile(np.abs(v), 0.95) for v in velocities])) or 1.0
    return [
        _thinned(_functions(run.displacement / reach, v / speed), run) for run, v in zip(runs, velocities, strict=True)
    ]


def _functions(x: Array, v: Array) -> Array:
    return np.array([np.ones(x.size), x, x**2, x**3, v, v * np.abs(v), v * x, np.tanh(10.0 * v)])


def _thinned(signal: Array, run: Run) -> Array:
    return signal[..., :: max(1, run.force.size // SAMPLES)]

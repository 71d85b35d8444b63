"""Is there structure left that no suspect explains? Tests that name nothing.

Two questions to the whitened residual of the final model: does it correlate with a general set of functions of the
motion, and do repeated runs agree about it?
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.noise import NoiseModel
from dashpot.assess.projection import SparseRows, normal_equations, project_out, stack
from dashpot.assess.screen import Columns
from dashpot.assess.view import ModelView
from dashpot.data.run import Run

Array = NDArray[np.float64]
Signals = Mapping[str, Array]

SIGNIFICANT = 6.0
SMALLEST_SIZE = 0.1
LAGS = (0.003, 0.02, 0.15, 1.0)


@dataclass(frozen=True)
class Leftover:
    """``score`` is in standard deviations of pure noise, ``size`` the structured part in units of the noise (RMS)."""

    score: float
    size: float

    @property
    def notable(self) -> bool:
        """Whether something is left that is both certain and not negligible."""
        return self.score > SIGNIFICANT and self.size > SMALLEST_SIZE


def look_for_leftover(view: ModelView, columns: Columns, noise: NoiseModel, runs: Sequence[Run]) -> Leftover:
    """The more telling one of the two tests, sensor errors within the data sheet left aside."""
    return max(
        _correlation(view, columns, noise),
        _agreement(_without_sensor_errors(columns, noise), noise, runs),
        key=lambda leftover: (leftover.notable, leftover.size),
    )


def _correlation(view: ModelView, columns: Columns, noise: NoiseModel) -> Leftover:
    general = {run: general_functions(view, run)[:, view.scored[run].first :] for run in columns.residual}
    rows = (columns.tangents, columns.nuisance, SparseRows.of(general))
    normal = normal_equations(columns.residual, rows, noise, columns.jobs)
    projected = project_out(normal, columns.precision.size, columns.precision)
    scale = np.sqrt(np.maximum(projected.original, 1e-300))
    values, vectors = np.linalg.eigh(projected.spread / np.outer(scale, scale))
    kept = values > 1e-8 * values[-1]
    excess = float(np.sum((vectors[:, kept].T @ (projected.scores / scale)) ** 2 / values[kept])) - float(kept.sum())
    score = excess / float(np.sqrt(2.0 * kept.sum()))
    return Leftover(score, float(np.sqrt(max(excess, 0.0) / projected.samples)))


def _without_sensor_errors(columns: Columns, noise: NoiseModel) -> Signals:
    if columns.nuisance.size == 0:
        return columns.residual
    rows = stack(columns.tangents, columns.nuisance)
    normal = normal_equations(columns.residual, rows, noise, columns.jobs)
    scale = np.sqrt(np.maximum(np.diag(normal.gram) + columns.precision, 1e-300))
    gram = (normal.gram + np.diag(columns.precision)) / np.outer(scale, scale)
    strengths = np.linalg.lstsq(gram, normal.right / scale, rcond=1e-11)[0] / scale
    return {run: values - rows.combined(strengths, run) for run, values in columns.residual.items()}


def general_functions(view: ModelView, run: str) -> Array:
    """Products of deflection and velocity, powers, signs, and the same remembered for a while: (functions, n)."""
    x = (view.displacement(run) - np.mean(view.reach)) / (0.5 * np.ptp(view.reach))
    local = view.displacement(run) - np.mean(view.displacement(run))
    local = local / max(float(np.std(local)), 1e-300)
    v = view.velocity(run) / view.speed
    a = np.gradient(v)
    plain = [
        x,
        x**2,
        x**3,
        x**4,
        v,
        v * np.abs(v),
        np.abs(v),
        v**3,
        v * x,
        v * x**2,
        v * local,
        v * local**2,
        np.tanh(20.0 * v),
        np.tanh(20.0 * v) * x,
        np.tanh(20.0 * v) * local,
        local**2,
        local**3,
        np.tanh(4.0 * x),
        a,
        a * local,
        view.force(run) * v,
    ]
    remembered = [_low_pass(signal, view.step(run) / lag) for lag in LAGS for signal in (local, local**2, np.abs(v))]
    return np.array([*plain, *remembered])


def _low_pass(signal: Array, share: float) -> Array:
    from scipy.signal import lfilter

    keep = np.exp(-share)
    return lfilter([1.0 - keep], [1.0, -keep], signal)


def _agreement(residual: Signals, noise: NoiseModel, runs: Sequence[Run]) -> Leftover:
    total, samples = 0.0, 0
    white = {run: noise.whiten(run, residual[run]) for run in residual}
    for run in runs:
        if run.repeats in white and run.name in white:
            first, second = white[run.repeats], white[run.name]
            count = min(first.size, second.size)
            total += float(first[-count:] @ second[-count:])
            samples += count
    if samples == 0:
        return Leftover(0.0, 0.0)
    return Leftover(total / np.sqrt(samples), float(np.sqrt(max(total, 0.0) / samples)))

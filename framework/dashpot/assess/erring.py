"""Sensors that err within their data sheet: what such errors make of a force counts as noise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.noise import NoiseModel
from dashpot.data.sensor_errors import error_shapes
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

DEVIATIONS = 3.0  # of what a sheet says an error may have


@dataclass(frozen=True, eq=False)
class _Shapes:
    """Orthonormal whitened rows (k, n), and the share (k,) of a signal along each that errors of a sensor explain."""

    rows: Array
    taken: Array

    def without(self, white: Array) -> Array:
        return white - ((white @ self.rows.T) * self.taken) @ self.rows


@dataclass(frozen=True, eq=False)
class ErringNoise(NoiseModel):
    """A noise to which errors of gain, zero and delay add, normal and new in every run."""

    shapes: Mapping[str, _Shapes]

    def whiten(self, run: str, signals: Array) -> Array:
        """Signals (..., n) of a run in units of noise and errors."""
        white = super().whiten(run, signals)
        return self.shapes[run].without(white) if run in self.shapes else white


def beside_sensors(
    noise: NoiseModel,
    runs: Sequence[ScoredRun],
    sensors: Mapping[str, Mapping[str, float]],
    forces: Mapping[str, Array],
) -> NoiseModel:
    """The noise of runs with the errors that the data sheets of their force channels admit, standard deviations.

    ``forces`` (n,) N of a model are what the errors are in proportion to. Measured ones will not do: a common gain of
    all runs, which a model follows, would scale their noise as well and so make it look smaller.
    """
    erring = [(run, sheet) for run in runs if (sheet := sensors.get(run.name))]
    shapes = {run.name: _shapes(noise, run, sheet, forces[run.name]) for run, sheet in erring}
    return ErringNoise(noise.filters, shapes) if shapes else noise


def less_sensor_errors(
    misfits: Sequence[Array], runs: Sequence[ScoredRun], sensors: Mapping[str, Mapping[str, float]]
) -> list[Array]:
    """Misfits (samples,) of runs less all that errors of the kinds in their sheets could have made, of any size."""
    return [_less_errors(misfit, _error_rows(run, sensors.get(run.name, {}), run.force))
            for misfit, run in zip(misfits, runs, strict=True)]  # fmt: skip


def beyond_sensors(
    misfits: Sequence[Array], runs: Sequence[ScoredRun], sensors: Mapping[str, Mapping[str, float]]
) -> list[Array]:
    """Misfits (samples,) of runs less what errors of the sizes in their sheets could have made of them."""
    return [_less_admitted(misfit, _error_rows(run, sensors.get(run.name, {}), run.force))
            for misfit, run in zip(misfits, runs, strict=True)]  # fmt: skip


def _less_admitted(misfit: Array, rows: Array) -> Array:
    """Each row is what an error of one standard deviation makes."""
    from scipy.optimize import lsq_linear

    if not rows.size:
        return misfit
    directions, triangle = np.linalg.qr(rows.T)
    sizes = lsq_linear(triangle, directions.T @ misfit, bounds=(-DEVIATIONS, DEVIATIONS)).x
    return misfit - sizes @ rows


def _less_errors(misfit: Array, rows: Array) -> Array:
    return misfit - np.linalg.lstsq(rows.T, misfit, rcond=1e-10)[0] @ rows if rows.size else misfit


def _error_rows(run: ScoredRun, sheet: Mapping[str, float], force: Array) -> Array:
    shapes = error_shapes(force, run.drive.dt)
    rows = [sheet[key] * shape[run.first :] for key, shape in shapes.items() if sheet.get(key, 0.0) > 0.0]
    return np.array(rows).reshape(len(rows), run.samples)


def _shapes(noise: NoiseModel, run: ScoredRun, sheet: Mapping[str, float], force: Array) -> _Shapes:
    white = noise.whiten(run.name, _error_rows(run, sheet, force))
    _, sizes, directions = np.linalg.svd(white, full_matrices=False)
    return _Shapes(directions, 1.0 - 1.0 / np.sqrt(1.0 + sizes**2))

"""Errors of the force channel that its data sheet admits: ordinary, and another one in every run.

The gain, the zero and the delay of a run are drawn from normal distributions of the deviations that the data sheet
states. They are no finding, and no part of the noise either: random effects, whose covariance is that of the noise in
as many directions.
Source: N. M. Laird, J. H. Ware: Random-effects models for longitudinal data. Biometrics 38, 1982.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.table_rows import records
from dashpot.diagnose.view import ModelView
from dashpot.diagnose.whitening import Noise
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

SHAPES: Mapping[str, Callable[[Array, float], Array]] = {
    "gain": lambda force, step: force,
    "zero": lambda force, step: np.ones_like(force),
    "delay": lambda force, step: -np.gradient(force, step),
}
Sheets = Mapping[str, Mapping[str, float]]  # deviations in SI by run and quantity


def admitted(sheets: Sheets, view: ModelView, runs: Sequence[ScoredRun], noise: Noise) -> dict[str, Array]:
    """What one standard deviation of each error would add to the records that have a data sheet (k, kept) in N."""
    found = {run.name: _shapes(sheets.get(run.name, {}), view, run.name) for run in records(runs)}
    return {run: noise.reduce(run, shapes) for run, shapes in found.items() if len(shapes)}


def error_admitted(sheets: Sheets, view: ModelView, runs: Sequence[ScoredRun]) -> float:
    """The RMSE in N that these errors alone give a model that is right, on the samples of the records in the view."""
    squares = [np.sum(_shapes(sheets.get(run.name, {}), view, run.name) ** 2, axis=0) for run in records(runs)]
    return float(np.sqrt(np.mean(np.concatenate(squares)))) if squares else 0.0


def _shapes(sheet: Mapping[str, float], view: ModelView, name: str) -> Array:
    """The same of one run (k, samples), as the view has it, not reduced."""
    force, step, run = view.force(name), view.step(name), view.scored[name]
    shapes = [sheet[word] * shape(force, step)[run.first :] for word, shape in SHAPES.items() if sheet.get(word)]
    return np.array(shapes).reshape(len(shapes), run.samples)

"""What fitted models leave of measured forces."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.contest import Model
from dashpot.assess.erring import beyond_sensors
from dashpot.assess.gain import crossed
from dashpot.assess.mend import Mend, mended, shape_rows
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network

Array = NDArray[np.float64]


def misfits_of(model: Model, runs: Sequence[ScoredRun]) -> list[Array]:
    """Simulated minus measured force (samples,) of runs, their mends taken out."""
    if not runs:
        return []
    objective = Objective(compile_network(model.fitted), [mended(run, model.mends) for run in runs])
    misfits = objective.misfits(model.values)[0]
    return [misfits[piece] for piece in objective.pieces]


def residuals_of(model: Model, runs: Mapping[str, ScoredRun]) -> dict[str, Array]:
    """Measured minus simulated force (n,) of every run, warm-up included, mends taken out."""
    sound = [mended(run, model.mends) for run in runs.values()]
    forces = Objective(compile_network(model.fitted), sound).forces(model.values)
    return {run.name: run.force - force[0] for run, force in zip(sound, forces, strict=True)}


def crossed_misfits(model: Model, runs: Sequence[ScoredRun], mends: Sequence[Mend]) -> list[Array]:
    """As ``misfits_of``, but the strengths of ``mends`` come from the other pieces of every run."""
    shapes = shape_rows(mends, runs)
    strengths = np.concatenate([mend.strengths for mend in mends])
    found = []
    for run, misfit in zip(runs, misfits_of(model, runs), strict=True):
        rows = shapes[run.name]
        found.append(crossed(misfit - strengths @ rows, rows, run.drive.dt) if rows.any() else misfit)
    return found


def share_of_change(
    before: Model, after: Model, runs: Sequence[ScoredRun], sensors: Mapping[str, Mapping[str, float]]
) -> float:
    """The share by which the error falls if the difference of two models is no error of the second.

    What the data sheets of ``sensors`` admit may be left out of both: it hides small effects. An error of a sensor
    beyond its sheet counts whole. The larger share of the two is the answer.
    """
    first, second = misfits_of(before, runs), misfits_of(after, runs)
    changes = [one - other for one, other in zip(first, second, strict=True)]
    beyond = [beyond_sensors(signals, runs, sensors) for signals in (changes, first)]
    shares = (balanced(changed) / max(balanced(error), 1e-300) for changed, error in ((changes, first), beyond))
    return float(1.0 - np.sqrt(max(1.0 - max(shares) ** 2, 0.0)))


def pooled(signals: Iterable[Array]) -> float:
    """Root mean square over all samples of several signals."""
    return float(np.sqrt(np.mean(np.concatenate(list(signals)) ** 2)))


def balanced(signals: Iterable[Array]) -> float:
    """Root mean square over several signals of which each has the same weight, however long it is."""
    return float(np.sqrt(np.mean([np.mean(signal**2) for signal in signals])))


def plainly_strong(mend: Mend, model: Model, runs: Sequence[ScoredRun]) -> Mend:
    """The mend with the strengths that make the plain error of a model smallest on runs, its numbers kept."""
    rows, misfits = shape_rows([mend], runs), misfits_of(model, runs)
    shapes, misfit = np.concatenate([rows[run.name] for run in runs], axis=1), np.concatenate(misfits)
    return replace(mend, strengths=-np.linalg.lstsq(shapes.T, misfit, rcond=1e-10)[0])

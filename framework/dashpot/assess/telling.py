"""The next measurement: the cheapest run on which two models that fit alike would come apart.

Both are simulated on every run of a menu. What a refit of the rival could still make up for, within what the present
data leave open of its numbers, does not count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.contest import Bench, Model
from dashpot.assess.menu import Proposal, runs_to_choose_from
from dashpot.assess.noise import NoiseModel
from dashpot.assess.unseen import known_directions
from dashpot.assess.view import view_of
from dashpot.data.drive import drive_from_samples
from dashpot.fit.objective import Objective
from dashpot.fit.refine import linearise
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network

Array = NDArray[np.float64]

ENOUGH = 30.0  # with a squared distance of 30 the better model leads by 10 in chi square in 95 of 100 cases


@dataclass(frozen=True)
class Telling:
    """A run and the squared distance, in units of the noise, that it is expected to bring between two models."""

    proposal: Proposal
    distance: float

    @property
    def words(self) -> str:
        """The run with what is to be expected of it."""
        return f"{self.proposal.words}: the two would differ by {np.sqrt(self.distance):.2g} standard deviations"


def telling_run(bench: Bench, one: Model, other: Model, noise: NoiseModel) -> Telling | None:
    """The shortest run that separates two models, whichever is true; None when no run of the menu does."""
    deviation = noise_deviation(bench, noise)
    known = {id(model): known_directions(bench, model, noise) for model in (one, other)}
    found = []
    for proposal in runs_to_choose_from(view_of(one.fitted, bench.runs, bench.elements)):
        run = _as_run(proposal, deviation)
        forces = [_force(model, run) for model in (one, other)]
        distances = [
            _distance(forces[1] - forces[0], _tangents(model, run), known[id(model)], deviation)
            for model in (one, other)
        ]
        found.append(Telling(proposal, min(distances)))
    telling = [choice for choice in found if choice.distance >= ENOUGH]
    return min(telling, key=lambda choice: choice.proposal.seconds, default=None)


def noise_deviation(bench: Bench, noise: NoiseModel) -> float:
    """The median over runs of the noise per sample in N, as if it were white."""
    return float(np.median([1.0 / np.abs(np.sum(noise.filters[run.name])) for run in bench.runs]))


def _as_run(proposal: Proposal, deviation: float) -> ScoredRun:
    drive = drive_from_samples(proposal.dt, proposal.displacement)
    return ScoredRun("next", "sweep", drive, np.zeros(proposal.displacement.size), proposal.displacement.size // 20)


def _force(model: Model, run: ScoredRun) -> Array:
    return Objective(compile_network(model.fitted), [run]).forces(model.values)[0][0][run.first :]


def _tangents(model: Model, run: ScoredRun) -> Array:
    objective = Objective(compile_network(model.fitted), [run], whiten=lambda name, misfits: misfits)
    return linearise(objective, model.coordinates, model.point)[1]


def _distance(difference: Array, tangents: Array, directions: Array, deviation: float) -> float:
    rows = directions @ tangents / deviation
    target = difference / deviation
    gram = rows @ rows.T + np.eye(rows.shape[0])
    right = rows @ target
    return float(target @ target - right @ np.linalg.solve(gram, right)) if right.size else float(target @ target)

"""The next measurement: the cheapest run on which two models that fit alike would come apart.

Both are simulated on every run of a menu. What a refit of the rival could still make up for, within what the present
data leave open of its numbers, does not count.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause
from dashpot.data.drive import drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.data.steady import SAMPLES
from dashpot.diagnose.proposals import LONGEST, Proposal, runs_to_choose_from
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.table_rows import is_row
from dashpot.diagnose.term import Model
from dashpot.diagnose.view import view_of
from dashpot.diagnose.whitening import Noise
from dashpot.fit.linear import Held, linearise
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.kernel.settings import used_settings

Array = NDArray[np.float64]

ENOUGH = 30.0  # with a squared distance of 30 the better model leads by 10 in chi square in 95 of 100 cases
LONGER = (1, 3, 3, 3)  # times as long as before
MOST_TRIED = 3


@dataclass(frozen=True)
class NextRun:
    """A run and the squared distance, in units of the noise, that it is expected to bring between two models.

    Its settings, where a model depends on them, are those of the run ``like``.
    """

    proposal: Proposal
    distance: float
    like: str = ""

    @property
    def words(self) -> str:
        """The run with what is to be expected of it."""
        settings = f", with the settings of '{self.like}'" if self.like else ""
        apart = f"the two would differ by {np.sqrt(self.distance):.2g} standard deviations"
        return f"{self.proposal.words}{settings}: {apart}"


def next_run(refitter: Refitter, one: Model, other: Model, noise: Noise) -> NextRun | None:
    """The shortest run that separates two models, whichever is true; None when no run of the menu does.

    Where none does as it is, those that come nearest are tried at greater length.
    """
    pair = _Pair.of(refitter, one, other, noise)
    menu = list(runs_to_choose_from(view_of(one.fitted, refitter.runs, refitter.elements)))
    for times in LONGER:
        longer = [proposal.longer(times) for proposal in menu]
        found = [pair.tell(proposal) for proposal in longer if proposal.seconds < LONGEST]
        if apart := [choice for choice in found if choice.distance >= ENOUGH]:
            return min(apart, key=lambda choice: choice.proposal.seconds)
        menu = [choice.proposal for choice in sorted(found, key=lambda choice: -choice.distance)[:MOST_TRIED]]
    return None


@dataclass(frozen=True, eq=False)
class _Pair:
    """Two models with the directions in which the present data leave each of them open.

    ``like`` is the run whose settings hold where the models depend on some.
    """

    models: tuple[Model, Model]
    known: tuple[Array, Array]
    deviation: float
    like: ScoredRun

    @classmethod
    def of(cls, refitter: Refitter, one: Model, other: Model, noise: Noise) -> _Pair:
        known = known_directions(refitter, one, noise), known_directions(refitter, other, noise)
        return cls((one, other), known, noise_deviation(refitter, noise), refitter.runs[0])

    def tell(self, proposal: Proposal) -> NextRun:
        """How far the two come apart on a run, whichever is true.

        Where one has fewer numbers it has to miss what the other one foresees; if it is true itself, the other one has
        to give up what it owes to chance.
        """
        settings = self.like.excitation.settings
        run = _as_run(proposal, settings)
        forces = [_force(model, run) for model in self.models]
        fewest = min(model.point.size for model in self.models)
        distances = [
            _distance(forces[1] - forces[0], _tangents(model, run), directions, self.deviation)
            for model, directions in zip(self.models, self.known, strict=True)
            if model.point.size == fewest
        ]
        depends = any(used_settings(model.fitted, settings) for model in self.models)
        return NextRun(proposal, min(distances), self.like.name if depends else "")


def noise_deviation(refitter: Refitter, noise: Noise) -> float:
    """The median over runs of the noise per sample in N, as if it were white; of rows per sample of a period."""
    samples = {run.name: np.sqrt(0.5 * SAMPLES) if is_row(run) else 1.0 for run in refitter.runs}
    return float(np.median([samples[name] / np.abs(np.sum(noise.filters[name])) for name in samples]))


def known_directions(refitter: Refitter, model: Model, noise: Noise) -> Array:
    """Directions (p, p) of the model's numbers, scaled so that the training runs leave a deviation of one in each."""
    _, tangents = refitter.linearise(model, noise)
    gram = sum(rows @ rows.T for rows in tangents.values())
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    values, vectors = np.linalg.eigh(gram / np.outer(scale, scale))
    kept = values > 1e-10 * max(float(values[-1]), 1e-300) if values.size else np.zeros(0, bool)
    return (vectors[:, kept] / np.sqrt(values[kept])).T / scale


def _as_run(proposal: Proposal, settings: Mapping[str, float]) -> ScoredRun:
    displacement = proposal.displacement
    drive = drive_from_samples(proposal.dt, displacement)
    whole = replace(Excitation.of_drive(drive), settings=settings)
    return ScoredRun("next", "sweep", drive, np.zeros(displacement.size), displacement.size // 20, whole=whole)


def _force(model: Model, run: ScoredRun) -> Array:
    return Objective(compile_network(model.fitted), [run]).forces(model.values)[0][0][run.first :]


def _tangents(model: Model, run: ScoredRun) -> Array:
    objective = Held(Objective(compile_network(model.fitted), [run]))
    [rows] = linearise(objective, model.coordinates, model.point).each(lambda _, rows: rows[1:])
    return rows


def _distance(difference: Array, tangents: Array, directions: Array, deviation: float) -> float:
    rows = directions @ tangents / deviation
    target = difference / deviation
    gram = rows @ rows.T + np.eye(rows.shape[0])
    right = rows @ target
    taken_up = right @ np.linalg.lstsq(gram, right, rcond=1e-12)[0] if right.size else 0.0
    return float(target @ target - taken_up)


def measurement_between(cause: type[Cause], rival: str, causes: Mapping[str, type[Cause]]) -> str:
    """The measurement that tells a cause from a rival, by its word, or an empty text when neither of them says."""
    other = causes[rival].confused_with if rival in causes else {}
    return cause.confused_with.get(rival) or other.get(cause.word, "")

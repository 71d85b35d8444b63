"""Faults of single held-out runs: these runs judge the model, so they must be sound themselves.

Looked for at the end, with the final model, whose numbers are known from the training runs as well as these tell them.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.contest import Bench, Model
from dashpot.assess.finalists import tie_width
from dashpot.assess.mend import Mend, make_mend
from dashpot.assess.noise import NoiseModel, learn_noise
from dashpot.assess.nuisance import sensor_nuisance
from dashpot.assess.projection import SparseRows, normal_equations, stack
from dashpot.assess.screen import Candidate, Columns, Finding, collect_bank, rich_residual, screen
from dashpot.assess.suspicion import first_noise, resolution
from dashpot.assess.view import ModelView, view_of
from dashpot.contract.cause import Cause

Array = NDArray[np.float64]

NOISE_ROUNDS = 2
SMALLEST_SHARE = 0.02  # of the whitened squares of the faulty runs, which is one percent of their error


@dataclass(frozen=True, eq=False)
class Jury:
    """The held-out runs, and the directions in which the final model may still be wrong there."""

    bench: Bench
    directions: Array
    causes: Sequence[type[Cause]]
    seed: int

    def faulty(self, model: Model, known: Collection[str] = ()) -> tuple[Finding, Mend, tuple[str, ...]] | None:
        """The most significant fault of single runs that is also worth a word, and words of those alike; or None.

        Of faults alike it is one of a word that is ``known`` of other runs.
        """
        columns, view = self._columns(model)
        if columns is None:
            return None
        noise = first_noise(self.bench, model)
        for _ in range(NOISE_ROUNDS):
            noise = learn_noise(rich_residual(columns, noise), resolution(self.bench))
        seen = screen(columns, noise, self.seed)
        finding = seen.best
        if finding is None or finding.gain < SMALLEST_SHARE * columns.samples_of(finding):
            return None
        near = [one for one in seen.findings if one.merit > finding.merit - tie_width(finding)]
        finding = next((one for one in near if one.candidate.cause.word in known), finding)
        words = dict.fromkeys(one.candidate.cause.word for one in near)
        return finding, make_mend(view, finding), tuple(word for word in words if word != finding.candidate.cause.word)

    def _columns(self, model: Model) -> tuple[Columns | None, ModelView]:
        residual, tangents = self.bench.linearise(model)
        view = view_of(model.fitted, self.bench.runs, self.bench.elements, self.bench.jobs)
        candidates = _local_candidates(self.causes, view, model)
        if not candidates:
            return None, view
        sheet, priors = sensor_nuisance(self.bench.runs, view, self.bench.sensors)
        turned = SparseRows.dense({run: self.directions @ rows for run, rows in tangents.items()})
        nothing = SparseRows.dense({run: rows[:0] for run, rows in tangents.items()})
        known = np.concatenate([np.ones(turned.size), priors])
        bank = collect_bank(view, candidates)
        return Columns(residual, nothing, stack(turned, sheet), bank, known, tuple(candidates), self.bench.jobs), view


def known_directions(bench: Bench, model: Model, noise: NoiseModel) -> Array:
    """Directions (p, p) of the model's numbers, scaled so that the training runs leave a deviation of one in each."""
    residual, tangents = bench.linearise(model)
    gram = normal_equations(residual, SparseRows.dense(tangents), noise, bench.jobs).gram
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    values, vectors = np.linalg.eigh(gram / np.outer(scale, scale))
    kept = values > 1e-10 * max(float(values[-1]), 1e-300) if values.size else np.zeros(0, bool)
    return (vectors[:, kept] / np.sqrt(values[kept])).T / scale


def _local_candidates(causes: Sequence[type[Cause]], view: ModelView, model: Model) -> list[Candidate]:
    found: list[Candidate] = []
    for cause in causes:
        if cause.kind != "measurement":
            continue
        for suspect in cause().suspects(view, model.fitted):
            if suspect.local:
                first = found[-1].columns.stop if found else 0
                found.append(Candidate(cause, suspect, slice(first, first + len(suspect.grid))))
    return found

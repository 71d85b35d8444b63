"""Faults of the force channel, taken out of the measured force.

A mend is to the measurement what a branch is to the network: a shape over time with a strength. The strengths are found
together with the numbers of the network.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.projection import Normal, Projected
from dashpot.assess.screen import Finding, solve_places
from dashpot.assess.view import ModelView
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

DRAWS = 400


@dataclass(frozen=True, eq=False)
class Mend:
    """``shapes[run]`` (k, n) N, each times its strength (k,), stand in the measured force of a run.

    ``chosen`` (k,) are their places in the grid of the suspect that was found, ``deviations`` (k,) the standard
    deviations of the strengths.
    """

    finding: Finding
    chosen: tuple[int, ...]
    shapes: Mapping[str, Array]
    strengths: Array
    deviations: Array

    @property
    def local(self) -> bool:
        """Whether it touches single runs and says nothing about others."""
        return self.finding.candidate.suspect.local

    @property
    def roams(self) -> bool:
        """Whether it may sit at other places of its grid on another model."""
        suspect = self.finding.candidate.suspect
        return not suspect.local and not suspect.joint and len(suspect.grid) > 1

    def keeping(self, finding: Finding, kept: Iterable[int]) -> Mend:
        """The mend of the ``finding`` that has only these places left, by their number."""
        at = list(kept)
        shapes = {run: rows[at] for run, rows in self.shapes.items() if rows[at].any()}
        return Mend(finding, tuple(self.chosen[k] for k in at), shapes, self.strengths[at], self.deviations[at])

    def within(self, runs: Collection[str]) -> Mend:
        """The mend with those of its places left that touch no other than these runs."""
        elsewhere = [rows.any(axis=1) for run, rows in self.shapes.items() if run not in runs]
        kept = np.flatnonzero(~np.any(elsewhere, axis=0)) if elsewhere else np.arange(self.strengths.size)
        return self.keeping(self.finding.keeping(kept), kept)

    def fault(self, run: str) -> Array | float:
        """What is to be taken out of the force of a run, (n,) N."""
        return self.strengths @ self.shapes[run] if run in self.shapes else 0.0

    def told(self) -> dict[str, tuple[float, str, tuple[float, float]]]:
        """The strengths by name, with unit and 95 % interval."""
        suspect = self.finding.candidate.suspect
        tries = np.zeros((1 + DRAWS, len(suspect.grid)))
        errors = np.random.default_rng(0).standard_normal((1 + DRAWS, self.strengths.size)) * self.deviations
        errors[0] = 0.0
        tries[:, list(self.chosen)] = self.strengths + errors
        told = [suspect.tell(strengths.tolist()) for strengths in tries]
        return {
            name: (value, unit, _middle([other[name][0] for other in told[1:]]))
            for name, (value, unit) in told[0].items()
        }


def _middle(values: Sequence[float]) -> tuple[float, float]:
    low, high = np.quantile(values, [0.025, 0.975])
    return float(low), float(high)


def make_mend(view: ModelView, finding: Finding) -> Mend:
    """The mend of a finding, its shapes on every run of the view that it touches."""
    shapes = _shapes(view, finding, finding.chosen)
    return Mend(finding, finding.chosen, shapes, finding.strengths, finding.deviations)


def reshaped(mend: Mend, view: ModelView) -> Mend:
    """The mend with its strengths and the shapes that it has on another model."""
    return replace(mend, shapes=_shapes(view, mend.finding, mend.chosen))


def relocated(mend: Mend, best: Finding | None, projected: Projected, view: ModelView) -> Mend:
    """The mend at the places of the ``best`` finding of its suspect alone, where these explain more than its own."""
    found = mend.finding.candidate.suspect
    if best is None or set(best.chosen) == set(mend.chosen):
        return mend
    own = solve_places(projected.scores, projected.spread, mend.chosen, found.sign)[0]
    price = (1 + found.unknowns) * np.log(projected.samples)
    if best.merit <= own - len(mend.chosen) * price:
        return mend
    shapes = _shapes(view, mend.finding, best.chosen)
    return replace(mend, chosen=best.chosen, shapes=shapes, strengths=best.strengths, deviations=best.deviations)


def _shapes(view: ModelView, finding: Finding, chosen: Sequence[int]) -> dict[str, Array]:
    shapes = {run: np.atleast_2d(finding.candidate.suspect.columns(view, run))[list(chosen)] for run in view.runs}
    return {run: rows for run, rows in shapes.items() if rows.any()}


def mended(run: ScoredRun, mends: Sequence[Mend]) -> ScoredRun:
    """The run with all faults taken out of its force."""
    faults = [mend.fault(run.name) for mend in mends if run.name in mend.shapes]
    return replace(run, force=run.force - sum(faults)) if faults else run


def shape_rows(mends: Sequence[Mend], runs: Sequence[ScoredRun]) -> dict[str, Array]:
    """The shapes of all mends (k, n) by run, warm-up cut off."""
    return {
        run.name: np.concatenate([
            np.empty((0, run.force.size)),
            *(mend.shapes.get(run.name, np.zeros((mend.strengths.size, run.force.size))) for mend in mends),
        ])[:, run.first :]
        for run in runs
    }  # fmt: skip


def corrected(mends: Sequence[Mend], normal: Normal, learned: bool) -> tuple[Mend, ...]:
    """The mends after one Gauss-Newton step of their strengths; ``normal`` has them behind the network's tangents.

    ``learned`` says that the noise is known, so that the deviations of the strengths are.
    """
    scale = np.sqrt(np.maximum(np.diag(normal.gram), 1e-300))
    inverse = np.linalg.pinv(normal.gram / np.outer(scale, scale), rcond=1e-11, hermitian=True)
    steps, spread = inverse @ (normal.right / scale) / scale, np.sqrt(np.maximum(np.diag(inverse), 0.0)) / scale
    found, first = [], normal.right.size - sum(mend.strengths.size for mend in mends)
    for mend in mends:
        place = slice(first, first := first + mend.strengths.size)
        deviations = spread[place] if learned else mend.deviations
        found.append(replace(mend, strengths=mend.strengths + steps[place], deviations=deviations))
    return tuple(found)

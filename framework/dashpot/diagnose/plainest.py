"""What tables of dynamic stiffness alone cannot show, and is not looked for in them.

They tell the fundamental of a steady state. Of laws that have the same one the plainest is tried, which has least of
what no table tells, mean and harmonics: a dashpot, and not one that acts in one direction only with twice the damping.
Of a law that fades while it is driven they tell nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import View
from dashpot.data.steady import SAMPLES, parts_of
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.table_rows import is_row, shown
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

MOST_PROBED = 12  # rows on which laws are compared
TWINS = 0.999999  # the cosine between fundamentals that no table tells apart
PLAINER = 1e-3  # share of the square of a force that has to be fundamental in one and not in the other
STEADY = 0.1  # of a fundamental: what would change by more in another run as long, as fast as in the last period


def not_shown(candidates: Sequence[Candidate], view: View, runs: Sequence[ScoredRun]) -> NDArray[np.intp]:
    """The columns of candidates that runs cannot show; none where there is a record among them."""
    free = [one for one in candidates if one.site is None and not one.suspect.joint]
    if not free or not all(is_row(run) for run in runs):
        return np.zeros(0, dtype=np.intp)
    places = np.concatenate([np.arange(one.columns.start, one.columns.stop) for one in free])
    probed = [_probe(run, np.concatenate([_raw(one, view, run.name) for one in free])) for run in _spread(runs)]
    fundamental = np.concatenate([each["parts"] for each in probed], axis=1)
    share = np.mean([each["share"] for each in probed], axis=0)
    fades = np.any([each["fades"] for each in probed], axis=0)
    unit = fundamental / np.maximum(np.linalg.norm(fundamental, axis=1), 1e-300)[:, None]
    plainer = (np.abs(unit @ unit.T) > TWINS) & (share > share[:, None] + PLAINER)
    return np.asarray(places[fades | plainer.any(axis=1)])


def _spread(runs: Sequence[ScoredRun]) -> list[ScoredRun]:
    """A few rows of all frequencies, amplitudes and preloads."""

    def conditions(run: ScoredRun) -> tuple[float, ...]:
        return tuple(run.excitation.settings[key] for key in ("preload", "amplitude", "frequency"))

    ordered = sorted(runs, key=conditions)
    return [ordered[k] for k in np.unique(np.linspace(0, len(ordered) - 1, MOST_PROBED).astype(int))]


def _raw(candidate: Candidate, view: View, run: str) -> Array:
    return np.atleast_2d(candidate.suspect.columns(view, run))


def _probe(run: ScoredRun, forces: Array) -> Mapping[str, Array]:
    """Of forces (m, n): the fundamental (m, 2) as the row shows it, its share of the square, and whether it fades."""
    parts = parts_of(shown(run, forces))
    last, before = forces[:, -SAMPLES:], forces[:, -2 * SAMPLES : -SAMPLES]
    square, change = np.mean(last**2, axis=1), np.linalg.norm(parts_of(last) - parts_of(before), axis=1)
    size, periods = np.linalg.norm(parts, axis=1), forces.shape[1] / SAMPLES
    share = np.divide(np.mean(parts**2, axis=1), square, out=np.zeros(len(forces)), where=square > 0.0)
    return {"parts": parts, "share": share, "fades": change * periods > STEADY * size}

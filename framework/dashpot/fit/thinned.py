"""Runs with no more samples than the band that was driven asks for: what a search works on.

The path keeps its positions and rates at the samples that stay, and between two of them it is a cubic, as before; the
force is decimated behind a low-pass of zero phase.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from dashpot.data.band import end_of_band
from dashpot.data.drive import Drive, drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.data.resample import decimate
from dashpot.data.steady import STEADY
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun

SAMPLES = 16  # a period at the end of the driven band: eight harmonics
END = 15  # samples at either end, over which the low-pass has to guess what is beyond: they do not count
FEWEST = 10 * END  # samples of a run that is decimated


def largest_stroke(runs: Collection[ScoredRun]) -> float:
    """The largest stroke of a single dynamic run in m, of any run if there is no dynamic one."""
    dynamic = [run for run in runs if run.kind not in ("quasi_static", "hold")]
    return float(max(np.ptp(run.drive.displacement) for run in dynamic or runs))


def highest_frequency(runs: Collection[ScoredRun]) -> float:
    """The highest frequency in Hz that was driven, in any run."""
    return end_of_band([run.drive for run in runs], largest_stroke(runs))


def thinned(runs: Sequence[ScoredRun]) -> list[ScoredRun]:
    """The runs at ``SAMPLES`` a period of the highest frequency driven, those that have fewer as they are."""
    highest = highest_frequency(runs)
    return [_every(run, int(1.0 / (SAMPLES * highest * run.drive.dt))) for run in runs]


def thinned_objective(objective: Objective) -> Objective | None:
    """The same on thinned runs, on which a descent may begin; None where no run has more samples than that."""
    runs = thinned(objective.runs)
    if all(one is other for one, other in zip(runs, objective.runs, strict=True)):
        return None
    return Objective(objective.network, runs, objective.jobs, weights=objective.shares.tolist())


def _every(run: ScoredRun, step: int) -> ScoredRun:
    kept = -(-run.force.size // max(step, 1))
    if step < 2 or kept < FEWEST or run.kind == STEADY:
        return run
    cut = slice(kept - END)
    whole = run.whole and _excitation(run.whole, step, cut)
    drive, force = _path(run.drive, step, cut), decimate(run.force, step)[cut]
    return replace(run, drive=drive, force=force, first=max(-(-run.first // step), END), whole=whole)


def _excitation(whole: Excitation, step: int, cut: slice) -> Excitation:
    motions = {name: _path(drive, step, cut) for name, drive in whole.motions.items()}
    loads = {name: decimate(load, step)[cut] for name, load in whole.loads.items()}
    return replace(whole, motions=motions, loads=loads, dt=whole.dt * step, samples=cut.stop)


def _path(drive: Drive, step: int, cut: slice) -> Drive:
    kept = (signal[::step][cut].copy() for signal in (drive.displacement, drive.velocity, drive.acceleration))
    return drive_from_path(drive.dt * step, *kept)

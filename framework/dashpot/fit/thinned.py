"""Runs with fewer samples: what a descent begins on, and what a search works on where there are very many.

The path keeps its positions and rates at the samples that stay, and between two of them it is a cubic, as before. For a
descent the force is decimated behind a low-pass of zero phase. A law that bends sharply has harmonics beyond that,
which the low-pass takes from the measured force alone: where a residual is to tell what is missing, the force is taken
at the samples that stay, as it is simulated there.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from math import ceil

import numpy as np
from numpy.typing import NDArray

from dashpot.data.band import end_of_band
from dashpot.data.drive import Drive, drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.data.resample import decimate
from dashpot.data.steady import STEADY
from dashpot.fit.enough_steps import Team
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.system import CompiledSystem

Array = NDArray[np.float64]
Resampling = Callable[[Array, int], Array]

SLOW = ("quasi_static", "hold")
SAMPLES = 16  # a period at the end of the driven band: eight harmonics
END = 15  # samples at either end, over which the low-pass has to guess what is beyond: they do not count
MOST = 200_000  # samples of all runs together, beyond which a search takes fewer
WORTHWHILE = 0.5  # of the samples: what a descent that begins on thinned runs must save
FEWEST = 10 * END  # samples of a run that is decimated


def largest_stroke(runs: Collection[ScoredRun]) -> float:
    """The largest stroke of a single dynamic run in m, of any run if there is no dynamic one."""
    dynamic = [run for run in runs if run.kind not in SLOW]
    return float(max(np.ptp(run.drive.displacement) for run in dynamic or runs))


def highest_frequency(runs: Collection[ScoredRun]) -> float:
    """The highest frequency in Hz that was driven, in any run."""
    return end_of_band([run.drive for run in runs], largest_stroke(runs))


def thinned(runs: Sequence[ScoredRun]) -> list[ScoredRun]:
    """The runs at ``SAMPLES`` a period of the highest frequency driven, those that have fewer as they are."""
    return [_every(run, step, decimate) for run, step in zip(runs, _longest_steps(runs), strict=True)]


def subsampled(runs: Sequence[ScoredRun]) -> list[ScoredRun]:
    """The runs as they are or, where they have more than ``MOST`` samples, at as few as that or as ``thinned`` has.

    The force is the measured one at the samples that stay.
    """
    step = ceil(sum(run.force.size for run in runs) / MOST)
    return [_every(run, min(step, longest), _taken) for run, longest in zip(runs, _longest_steps(runs), strict=True)]


def _longest_steps(runs: Sequence[ScoredRun]) -> list[int]:
    highest = highest_frequency(runs) if runs else 0.0
    return [int(1.0 / (SAMPLES * highest * run.drive.dt)) for run in runs]


def _taken(values: Array, step: int) -> Array:
    return values[::step].copy()


def thinned_objective(objective: Objective) -> Objective | None:
    """The same on thinned runs, on which a descent may begin; None where these have more than half of the samples.

    Slow runs have as many samples as their own motion asks for. A run whose samples lie closely enough for steps of
    high order stays as it is: fewer of them would take other steps, and no less time.
    """
    whole, runs = objective.runs, list(objective.runs)
    for slow in (True, False):
        some = [number for number, run in enumerate(whole) if (run.kind in SLOW) is slow]
        for number, run in zip(some, thinned([whole[number] for number in some]), strict=True):
            runs[number] = run
    changed = [team for team in objective.teams if any(runs[number] is not whole[number] for number in team)]
    for team in changed:
        if _of_high_order(objective, team):
            for number in team:
                runs[number] = whole[number]
    if sum(run.samples for run in runs) > WORTHWHILE * sum(run.samples for run in whole):
        return None
    return Objective(objective.network, runs, objective.jobs, weights=objective.shares.tolist())


def counted(vectors: int, sparse: Objective, objective: Objective) -> int:
    """As how many parameter vectors on all samples those on thinned runs count."""
    return ceil(vectors * sparse.total / objective.total)


def _of_high_order(objective: Objective, team: Team) -> bool:
    network = objective.network
    return isinstance(network, CompiledSystem) and network.takes_high_order(
        network.prepare(objective.runs[team[0]].excitation)
    )


def _every(run: ScoredRun, step: int, resample: Resampling) -> ScoredRun:
    kept = -(-run.force.size // max(step, 1))
    if step < 2 or kept < FEWEST or run.kind == STEADY:
        return run
    cut = slice(kept - END)
    whole = run.whole and _excitation(run.whole, step, cut)
    drive, force = _path(run.drive, step, cut), resample(run.force, step)[cut]
    return replace(run, drive=drive, force=force, first=max(-(-run.first // step), END), whole=whole)


def _excitation(whole: Excitation, step: int, cut: slice) -> Excitation:
    motions = {name: _path(drive, step, cut) for name, drive in whole.motions.items()}
    loads = {name: decimate(load, step)[cut] for name, load in whole.loads.items()}
    channels = {name: _taken(signal, step)[cut] for name, signal in whole.channels.items()}
    return replace(whole, motions=motions, loads=loads, dt=whole.dt * step, samples=cut.stop, channels=channels)


def _path(drive: Drive, step: int, cut: slice) -> Drive:
    kept = (signal[::step][cut].copy() for signal in (drive.displacement, drive.velocity, drive.acceleration))
    return drive_from_path(drive.dt * step, *kept)

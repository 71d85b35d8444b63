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
from dashpot.fit.scored import ScoredRun

SAMPLES = 16  # a period at the end of the driven band: eight harmonics


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


def _every(run: ScoredRun, step: int) -> ScoredRun:
    if step < 2 or run.kind == STEADY:
        return run
    drive, whole = _path(run.drive, step), run.whole and _excitation(run.whole, step)
    return replace(run, drive=drive, force=decimate(run.force, step), first=-(-run.first // step), whole=whole)


def _excitation(whole: Excitation, step: int) -> Excitation:
    motions = {name: _path(drive, step) for name, drive in whole.motions.items()}
    loads = {name: decimate(load, step) for name, load in whole.loads.items()}
    return replace(whole, motions=motions, loads=loads, dt=whole.dt * step, samples=-(-whole.samples // step))


def _path(drive: Drive, step: int) -> Drive:
    kept = (signal[::step].copy() for signal in (drive.displacement, drive.velocity, drive.acceleration))
    return drive_from_path(drive.dt * step, *kept)

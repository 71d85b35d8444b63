"""Runs with no more samples than the band that was driven asks for: what a search works on.

The path keeps its positions and rates at the samples that stay, and between two of them it is a cubic, as before; the
force is decimated behind a low-pass of zero phase. Near the ends of a record, where that would have to guess what is
beyond, the force is that of cubics through the samples about (Savitzky and Golay, Analytical Chemistry 36 (1964) 1627).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dashpot.data.band import end_of_band
from dashpot.data.drive import Drive, drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.data.resample import decimate
from dashpot.data.steady import STEADY
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

SAMPLES = 16  # a period at the end of the driven band: eight harmonics
END = 15  # samples at either end, over which the low-pass has to guess what is beyond
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


def _every(run: ScoredRun, step: int) -> ScoredRun:
    kept = -(-run.force.size // max(step, 1))
    if step < 2 or kept < FEWEST or run.kind == STEADY:
        return run
    whole = run.whole and _excitation(run.whole, step)
    first = -(-run.first // step)
    return replace(run, drive=_path(run.drive, step), force=_every_nth(run.force, step), first=first, whole=whole)


def _every_nth(force: Array, step: int) -> Array:
    from scipy.signal import savgol_filter

    found, beside = decimate(force, step), savgol_filter(force, 2 * step + 1, 3)[::step]
    found[:END], found[-END:] = beside[:END], beside[-END:]
    return found


def _excitation(whole: Excitation, step: int) -> Excitation:
    motions = {name: _path(drive, step) for name, drive in whole.motions.items()}
    loads = {name: _every_nth(load, step) for name, load in whole.loads.items()}
    return replace(whole, motions=motions, loads=loads, dt=whole.dt * step, samples=-(-whole.samples // step))


def _path(drive: Drive, step: int) -> Drive:
    kept = (signal[::step].copy() for signal in (drive.displacement, drive.velocity, drive.acceleration))
    return drive_from_path(drive.dt * step, *kept)

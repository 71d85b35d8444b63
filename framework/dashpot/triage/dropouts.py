"""Samples that were lost: the motion jumps on, farther than it goes between two samples anywhere near."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.data.clock import LONGEST_GAP
from dashpot.data.run import Run
from dashpot.data.white_noise import white_noise
from dashpot.text.quantity import pretty
from dashpot.triage.fault import Fault

Array = NDArray[np.float64]

MOVING = ("sweep", "harmonic", "random", "quasi_static")
SIDE = 10
DEGREE = 2
SUSPECT = 6.0
CERTAIN = 12.0
NOTABLE = 5e-3  # of the stroke: smaller jumps do no harm


def lost_samples(run: Run) -> Fault | None:
    """Places at which a smooth motion goes on elsewhere, as if time had been cut out.

    Where the clock was uneven, as many samples may be missing anywhere as reading bridges between two stamps.
    """
    x = run.displacement
    if run.kind not in MOVING or x.size < 8 * SIDE:
        return None
    jumps = {
        place: step
        for place, step in _jumps(x, max(white_noise(x), 1e-9 * float(np.ptp(x))), _missing(run)).items()
        if abs(step) > NOTABLE * float(np.ptp(x))
    }
    if not jumps:
        return None
    where, size = max(jumps.items(), key=lambda jump: abs(jump[1]))
    return Fault(
        run.name,
        "lost_samples",
        f"its motion jumps at {_times(len(jumps))}, by {pretty(size, 'm', 3)} at {where * run.sample_time:.6g} s: "
        "no actuator moves so between two samples",
        "Samples were lost: record again, or cut a whole piece out with 'rows'",
    )


def _missing(run: Run) -> float:
    """How many samples may be missing between two without anything being wrong."""
    return LONGEST_GAP if run.uneven else 1.0


def _times(count: int) -> str:
    return "one place" if count == 1 else f"{count} places"


def _jumps(x: Array, noise: float, missing: float) -> dict[int, float]:
    """The first sample after each jump, and its size in m."""
    third = np.abs(np.diff(x, 3))
    usual = 1.4826 * float(np.median(third)) + noise
    peaks = np.flatnonzero(third > SUSPECT * usual) + 2
    peaks = peaks[(peaks > SIDE) & (peaks < x.size - SIDE - 2)]
    places = peaks[:, None] + np.arange(-1, 3)
    sizes = _steps(x, places, noise, missing)
    found: dict[int, float] = {}
    for at, near, steps in zip(peaks.tolist(), places, sizes, strict=True):
        best = int(np.argmax(np.abs(steps)))
        if steps[best] and not any(abs(at - known) < SIDE for known in found):
            found[int(near[best])] = float(steps[best])
    return found


def _steps(x: Array, places: NDArray[np.intp], noise: float, missing: float) -> Array:
    """The steps between what comes before places and what comes after, both continued; 0 where it is none.

    A step may be as long as the way between two samples at the fastest speed nearby, beside its own error: where a
    motion turns it stands still, and yet the play in a drive lets it lurch, and a triangle may turn between samples.
    """
    sides = [x[places[..., None] + np.arange(-SIDE, 0)], x[places[..., None] + np.arange(SIDE)]]
    times = [np.arange(-SIDE, 0) + 0.5, np.arange(SIDE) + 0.5]
    powers = [np.vander(time, DEGREE + 1, increasing=True) for time in times]
    before, after = (side @ np.linalg.pinv(power).T for side, power in zip(sides, powers, strict=True))
    fitted = np.concatenate([before @ powers[0].T, after @ powers[1].T], axis=-1)
    scatter = np.std(np.concatenate(sides, axis=-1) - fitted, axis=-1)
    step = after[..., 0] - before[..., 0]
    speed = np.max(
        np.abs(
            [
                side[..., 1] + 2.0 * side[..., 2] * end
                for side, time in zip((before, after), times, strict=True)
                for end in (time[0], time[-1])
            ]
        ),
        axis=0,
    )
    certain = np.abs(step) > CERTAIN * np.maximum(noise, scatter) + missing * speed
    return np.where(certain, step, 0.0)

"""Samples that were lost on an even time base: displacement and force jump on together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.triage.fault import Fault
from dashpot.data.run import Run
from dashpot.data.white_noise import white_noise
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]

MOVING = ("sweep", "harmonic", "random", "quasi_static")
SIDE = 10
DEGREE = 2
SUSPECT = 6.0
CERTAIN = 12.0
NOTABLE = 5e-3  # of the stroke: smaller jumps do no harm


def lost_samples(run: Run) -> Fault | None:
    """Places at which a smooth motion goes on elsewhere, as if time had been cut out."""
    x = run.displacement
    if run.kind not in MOVING or x.size < 8 * SIDE:
        return None
    jumps = {
        place: step
        for place, step in _jumps(x, max(white_noise(x), 1e-9 * float(np.ptp(x)))).items()
        if abs(step) > NOTABLE * float(np.ptp(x))
    }
    if not jumps:
        return None
    where, size = max(jumps.items(), key=lambda jump: abs(jump[1]))
    return Fault(
        run.name, "lost_samples",
        f"its motion jumps at {_times(len(jumps))}, by {pretty(size, 'm', 3)} at {where * run.sample_time:.6g} s: "
        "no actuator moves so between two samples",
        "Samples were lost: record again, or cut a whole piece out with 'rows'",
    )  # fmt: skip


def _times(count: int) -> str:
    return "one place" if count == 1 else f"{count} places"


def _jumps(x: Array, noise: float) -> dict[int, float]:
    """The first sample after each jump, and its size in m."""
    third = np.abs(np.diff(x, 3))
    usual = 1.4826 * float(np.median(third)) + noise
    found: dict[int, float] = {}
    for peak in np.flatnonzero(third > SUSPECT * usual):
        at = int(peak) + 2
        if not SIDE < at < x.size - SIDE - 2 or any(abs(at - known) < SIDE for known in found):
            continue
        sizes = {place: _jump(x, place, noise) for place in range(at - 1, at + 3)}
        place = max(sizes, key=lambda k: abs(sizes[k]))
        if sizes[place]:
            found[place] = sizes[place]
    return found


def _jump(x: Array, at: int, noise: float) -> float:
    """The step between what comes before ``at`` and what comes after, both continued; 0 where it is none."""
    t = np.arange(SIDE) + 0.5
    before = np.polynomial.Polynomial.fit(-t[::-1], x[at - SIDE : at], DEGREE).convert()
    after = np.polynomial.Polynomial.fit(t, x[at : at + SIDE], DEGREE).convert()
    left = np.concatenate([x[at - SIDE : at] - before(-t[::-1]), x[at : at + SIDE] - after(t)])
    step = float(after(0.0) - before(0.0))
    speed = max(abs(before.deriv()(0.0)), abs(after.deriv()(0.0)))
    return step if abs(step) > max(CERTAIN * max(noise, float(np.std(left))), speed) else 0.0

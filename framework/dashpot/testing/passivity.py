"""A passive element gives back no more work than was put in."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.kernel.network import compile_network
from dashpot.model.element import Element
from dashpot.testing.motion import random_drive
from dashpot.testing.specimen import draw_sizes, draw_specimens
from dashpot.testing.verdict import Examination

Array = NDArray[np.float64]

TOLERANCE = 1e-3  # of all work that went to and fro, besides what trapezoids of twice the width miss
FEWEST = 100  # steps in which work is done: a contact that is hardly touched says nothing
SAMPLES = 6001  # so that every second one ends where all do
ADVICE = "Check the sign of the force and the growth of the states; set `passive = False` if the law is meant so."
KINDS = ("sweep", "multisine", "dwelling")


def check_passivity(element: type[Element], seed: int | None = None) -> None:
    """From the unloaded state the work put in is never negative, whatever the path; skipped without ``passive``."""
    examination = Examination.begin(element, "passivity", seed)
    if not element.passive:
        return
    rng = examination.rng()
    for kind in KINDS:
        sizes = draw_sizes(rng)
        drive = random_drive(rng, kind, sizes.length, sizes.time, SAMPLES, sizes.time / 100.0)
        for specimen in draw_specimens(element, rng, sizes):
            force = compile_network(specimen.spec).along(drive)(specimen.values)
            work, coarse = _work(force, drive.displacement), _work(force[:, ::2], drive.displacement[::2])
            moved = np.sum(np.abs(np.diff(work, axis=1)), axis=1) + np.finfo(float).tiny
            error = np.max(np.abs(work[:, ::2] - coarse), axis=1) / moved
            lowest = np.min(work, axis=1) / moved
            touched = np.count_nonzero(np.diff(work, axis=1), axis=1) >= FEWEST
            if not (lowest >= -TOLERANCE - error)[touched].all():
                what = f"with {specimen.form}, a {kind} gives back more work than was put in"
                examination.fail(f"{what}, by {-np.min(lowest[touched]):.1%} of all that goes to and fro", ADVICE)


def _work(force: Array, path: Array) -> Array:
    # done on each lane since the first sample (lanes, samples)
    pieces = 0.5 * (force[:, 1:] + force[:, :-1]) * np.diff(path)
    return np.concatenate([np.zeros((force.shape[0], 1)), np.cumsum(pieces, axis=1)], axis=1)

"""A passive element gives back no more work than was put in."""

from __future__ import annotations

import numpy as np

from dashpot.kernel.network import compile_network
from dashpot.model.element import Element
from dashpot.testing.motion import random_drive
from dashpot.testing.specimen import draw_sizes, draw_specimens
from dashpot.testing.verdict import Examination

TOLERANCE = 1e-3  # of all work that went to and fro, for the trapezoids between samples
SAMPLES = 6000
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
            network = compile_network(specimen.spec)
            force = network.simulate(network.prepare(drive), specimen.values)
            pieces = 0.5 * (force[:, 1:] + force[:, :-1]) * np.diff(drive.displacement)
            moved = np.sum(np.abs(pieces), axis=1) + np.finfo(float).tiny
            lowest = np.min(np.cumsum(pieces, axis=1), axis=1) / moved
            if not (lowest >= -TOLERANCE).all():
                what = f"with {specimen.form}, a {kind} gives back more work than was put in"
                examination.fail(f"{what}, by {-np.min(lowest):.1%} of all that goes to and fro", ADVICE)

"""Harmonics that the actuator itself puts into the motion."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dashpot.data.run import Run
from dashpot.data.tracking import track
from dashpot.data.triangles import is_triangle
from dashpot.text.problem import RUNS_ALIKE

NOTABLE = 0.05
ORDERS = 4


def actuator_remarks(runs: Sequence[Run]) -> list[str]:
    """A remark for each run where a harmonic of the displacement exceeds 5 % of the motion; one for many of them.

    The measured motion drives the model, so this is no fault; but harmonics of the force are then not the specimen's.
    The harmonics of a triangle are prescribed: nothing is said of them.
    """
    found = {
        run.name: largest
        for run in runs
        if (largest := _largest(run)) and largest[1] > NOTABLE and not is_triangle(run.displacement)
    }
    if len(found) < RUNS_ALIKE:
        return [f"Run '{name}': {_told(*largest)}" for name, largest in found.items()]
    which = f"All {len(found)} runs" if len(found) == len(runs) else f"{len(found)} of {len(runs)} runs"
    name, largest = max(found.items(), key=lambda item: item[1][1])
    return [f"{which}, most of all '{name}': {_told(*largest)}"]


def _told(order: int, share: float) -> str:
    return (
        f"harmonic {order} of the displacement itself is {share:.0%} of the motion; "
        "the actuator adds it, so harmonics of the force are partly its own."
    )


def _largest(run: Run) -> tuple[int, float] | None:
    """The order of the largest harmonic of a displacement, and its share; None where there are no orders."""
    oscillation = track(run)
    if oscillation is None:
        return None
    orders = oscillation.orders.fit(run.displacement[:, None], ORDERS)
    shares = np.nanmedian(np.abs(orders.harmonics[:, 1:, 0] / orders.harmonics[:, :1, 0]), axis=0)
    number = int(np.argmax(shares))
    return number + 2, float(shares[number])

"""Harmonics that the actuator itself puts into the motion."""

from __future__ import annotations

import numpy as np

from dashpot.data.run import Run
from dashpot.data.tracking import track

NOTABLE = 0.05
ORDERS = 4


def actuator_harmonics(run: Run) -> str:
    """A remark where a harmonic of the displacement exceeds 5 % of the motion, else an empty text.

    The measured motion drives the model, so this is no fault; but harmonics of the force are then not the specimen's.
    """
    oscillation = track(run)
    if oscillation is None:
        return ""
    orders = oscillation.orders.fit(run.displacement[:, None], ORDERS)
    shares = np.nanmedian(np.abs(orders.harmonics[:, 1:, 0] / orders.harmonics[:, :1, 0]), axis=0)
    if not np.max(shares) > NOTABLE:
        return ""
    order = int(np.argmax(shares)) + 2
    return (
        f"Run '{run.name}': harmonic {order} of the displacement itself is {shares[order - 2]:.0%} of the motion; "
        "the actuator adds it, so harmonics of the force are partly its own."
    )

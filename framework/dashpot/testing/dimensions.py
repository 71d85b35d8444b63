"""The declared units fit the law: in other units of force, length and time it is the same law."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from dashpot.data.drive import Drive
from dashpot.kernel.eager import simulate_eagerly
from dashpot.model.element import Element
from dashpot.testing.motion import random_drive
from dashpot.testing.specimen import Sizes, draw_sizes, draw_specimens, scaled
from dashpot.testing.verdict import Examination

TOLERANCE = 1e-9
SAMPLES = 80
# powers of two change no digit
CHANGES = {"forces": Sizes(4.0, 1.0, 1.0), "lengths": Sizes(1.0, 0.5, 1.0), "times": Sizes(1.0, 1.0, 8.0)}


def check_dimensions(element: type[Element], seed: int | None = None) -> None:
    """Measuring forces, lengths or times in other units changes the force by just that."""
    examination = Examination.begin(element, "dimensions", seed)
    rng = examination.rng()
    sizes = draw_sizes(rng)
    drive = random_drive(rng, "multisine", sizes.length, sizes.time, SAMPLES)
    for specimen in draw_specimens(element, rng, sizes)[: max(1, 3 * len(element.declares.curves))]:
        force = simulate_eagerly(specimen.spec, drive, specimen.values)
        for what, change in CHANGES.items():
            other = scaled(specimen, change)
            found = simulate_eagerly(other.spec, _rescaled(drive, change), other.values)
            expected = change.force * force
            same = np.max(np.abs(found - expected)) <= TOLERANCE * np.max(np.abs(expected))
            examination.demand(
                bool(same),
                f"with {specimen.form}, the force is another one when {what} are measured in another unit",
                "Correct the declared units, or the law.",
            )


def _rescaled(drive: Drive, change: Sizes) -> Drive:
    length, time = change.length, change.time
    return replace(
        drive,
        dt=drive.dt * time,
        displacement=drive.displacement * length,
        velocity=drive.velocity * (length / time),
        acceleration=drive.acceleration * (length / time**2),
        turn_displacement=drive.turn_displacement * length,
    )

"""Lanes do not feel each other: a lane alone gives what it gives among others."""

from __future__ import annotations

import numpy as np

from dashpot.kernel.eager import simulate_eagerly
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element
from dashpot.testing.motion import random_drive
from dashpot.testing.specimen import draw_sizes, draw_specimens
from dashpot.testing.verdict import Examination

LANES = 64
CHOSEN = (0, 5, 37, 63)
SAMPLES = 60
TOLERANCE = 1e-13
KERNEL = "Tell the authors of dashpot: the kernel should keep lanes apart."
OWN = "A step may not mix lanes: no sums, means or maxima over arrays."


def check_separation(element: type[Element], seed: int | None = None) -> None:
    """Compiled, a lane alone is bitwise the lane among 63 others; in the element's own code to rounding."""
    examination = Examination.begin(element, "separation", seed)
    rng = examination.rng()
    sizes = draw_sizes(rng)
    drive = random_drive(rng, "multisine", sizes.length, sizes.time, SAMPLES)
    for specimen in draw_specimens(element, rng, sizes, LANES):
        simulate = compile_network(specimen.spec).along(drive)
        together = simulate(specimen.values)
        eager = simulate_eagerly(specimen.spec, drive, specimen.values)
        for lane in CHOSEN:
            alone = simulate(specimen.values[lane])
            examination.demand(
                np.array_equal(alone, together[lane], equal_nan=True),
                f"with {specimen.form}, the compiled lane {lane} alone differs from itself among {LANES}",
                KERNEL,
            )
            own = simulate_eagerly(specimen.spec, drive, specimen.values[lane])
            near = np.allclose(own, eager[lane], rtol=0.0, atol=TOLERANCE * np.max(np.abs(own)))
            examination.demand(
                near,
                f"with {specimen.form}, the element's own code gives lane {lane} alone another "
                f"force than among {LANES}",
                OWN,
            )

"""Sizes of specimens and what the rigs drive them with."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Rig:
    """A specimen of `stiffness` [N/m] and `damping` [N s/m], driven at `amplitudes` around `preloads` [m].

    `band` [Hz] is driven for `duration` [s], sampled at `rate` [Hz].
    """

    stiffness: float
    damping: float
    amplitudes: tuple[float, ...]
    preloads: tuple[float, ...]
    band: tuple[float, float]
    rate: float
    duration: float

    @property
    def amplitude(self) -> float:
        """The middle amplitude [m]."""
        return float(np.median(self.amplitudes))

    @property
    def pulsation(self) -> float:
        """The middle of the band [rad/s]."""
        return float(2 * np.pi * np.sqrt(self.band[0] * self.band[1]))

    @property
    def speed(self) -> float:
        """Velocity of the middle amplitude in the middle of the band [m/s]."""
        return self.amplitude * self.pulsation

    @property
    def farthest(self) -> float:
        """The largest deflection of a sweep [m]."""
        return max(self.preloads) + max(self.amplitudes)


MM = 1e-3
RIGS: dict[str, Rig] = {
    "bushing": Rig(
        6e5, 150.0, (0.05 * MM, 0.2 * MM, 0.5 * MM, 1 * MM), (0.3 * MM, 0.8 * MM, 1.5 * MM), (0.5, 40.0), 1000.0, 5.0
    ),
    "mount": Rig(2.5e5, 200.0, (0.1 * MM, 0.3 * MM, 1 * MM, 2 * MM), (2 * MM, 4 * MM, 6 * MM), (1.0, 30.0), 800.0, 6.0),
    "tread": Rig(
        2.1e5, 90.0, (0.5 * MM, 1 * MM, 2 * MM, 5 * MM), (10 * MM, 20 * MM, 30 * MM), (1.0, 25.0), 1000.0, 5.0
    ),
    "strut": Rig(3e4, 1500.0, (2 * MM, 5 * MM, 10 * MM, 20 * MM), (-20 * MM, 0.0, 20 * MM), (0.3, 12.0), 500.0, 10.0),
}

"""Sensor noise of a given size and colour."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.signal import lfilter


@dataclass(frozen=True)
class Noise:
    """White noise and first-order autoregressive noise, mixed by power.

    `rms` [N]; `memory` is the autoregressive coefficient per sample; `white` the share of the power that is white.
    """

    rms: float
    memory: float
    white: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls(rng.uniform(5.0, 20.0), rng.uniform(0.0, 0.98), rng.uniform(0.05, 1.0))

    def sample(self, rng: np.random.Generator, samples: int) -> np.ndarray:
        """A stationary stretch, shape (samples,)."""
        white, driven = rng.standard_normal((2, samples))
        driven[1:] *= np.sqrt(1 - self.memory**2)
        coloured = lfilter([1.0], [1.0, -self.memory], driven)
        return self.rms * (np.sqrt(self.white) * white + np.sqrt(1 - self.white) * coloured)

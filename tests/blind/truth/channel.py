"""A late force channel: shifted in time, or lagging by a low-pass of first order."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import lfilter

from .form import Forces, Form, alternating_rms
from .motion import STEP, Motion


class Late(Form):
    """Either form; the size is the delay at low frequency."""

    kind = "delay"
    unit = "s"

    @abstractmethod
    def late(self, time: np.ndarray, force: np.ndarray, delay: float) -> np.ndarray:
        """The force as the late channel shows it."""

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Self:
        return cls()

    def at_rms(self, motions: list[Motion], carried: Forces, dynamic: list[bool], rms: float) -> tuple[float, Forces]:
        """Nearly proportional to the delay, so a few corrections suffice."""
        delay = 1e-4
        for _ in range(20):
            added = [self.late(m.time, force, delay) - force for m, force in zip(motions, carried, strict=True)]
            ratio = rms / alternating_rms([force for force, counts in zip(added, dynamic, strict=True) if counts])
            if abs(ratio - 1) < 1e-6:
                return delay, added
            delay *= ratio
        raise ValueError(f"no delay gives an effect of {rms:.4g} N")


@dataclass(frozen=True)
class PureDelay(Late):
    """F(t - delay); the specimen rested before the run."""

    def late(self, time: np.ndarray, force: np.ndarray, delay: float) -> np.ndarray:
        return CubicSpline(time, force)(np.maximum(time - delay, 0.0))


@dataclass(frozen=True)
class FirstOrderLag(Late):
    """delay y' + y = F, by the trapezoidal rule."""

    def late(self, time: np.ndarray, force: np.ndarray, delay: float) -> np.ndarray:
        half = 0.5 * STEP / delay
        gain, pole = half / (1 + half), (1 - half) / (1 + half)
        rise = force - force[0]
        return force[0] + lfilter([gain, gain], [1.0, -pole], rise)


FORMS = (PureDelay, FirstOrderLag)

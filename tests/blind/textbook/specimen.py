"""What is measured before anything is hidden, and the network that describes it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .memory import maxwell, slider
from .record import Record
from .rig import Rig

POWERS = range(9)  # of the deflection, for a spring curve that is free to bend
NUDGE = 0.01

_SPRING = {
    "linear": "stiffness: {{start: {stiffness:g} N/m}}",
    "curved": "stiffness: {{from: quasi_static}}",
    "rubber": "stiffness: {{from: quasi_static}}",
}
_NETWORK = """\
format: dashpot-network/1
name: {name}
branches:
  stiffness: {{{{element: spring, {spring}}}}}
  damping: {{{{element: damper, damping: {{{{start: {{damping:g}} N*s/m}}}}}}}}
"""
_RUBBER = """\
  relaxation: {{element: maxwell, stiffness: {{start: {stiffness_3:g} N/m}}, relaxation_time: {{start: 20 ms}}}}
  joint: {{element: dahl, exponent: 0, stiffness: {{start: {stiffness_10:g} N/m}}, limit: {{start: {limit:g} N}}}}
"""
NETWORKS = tuple(_SPRING)


@dataclass(frozen=True)
class Specimen:
    """A spring (linear, or with a quadratic and a cubic share) and a damper; rubber also has a Maxwell and a slider.

    `quadratic` and `cubic` are shares of the stiffness at the farthest deflection; `stiffness` [N/m], `damping`
    [N s/m]; the relaxation time [s] and the reach of the slider [m] are zero where there is none.
    """

    network: str
    stiffness: float
    damping: float
    quadratic: float
    cubic: float
    relaxation_time: float
    reach: float

    @classmethod
    def draw(cls, network: str, rig: Rig, rng: np.random.Generator) -> Specimen:
        """Sizes within a factor of two of those of the rig."""
        bent, rubber = network != "linear", network == "rubber"
        return cls(
            network,
            rig.stiffness * float(rng.uniform(0.7, 1.4)),
            rig.damping * float(rng.uniform(0.5, 2.0)),
            float(rng.uniform(-0.1, 0.2)) * bent,
            float(rng.uniform(0.0, 0.3)) * bent,
            float(rng.uniform(0.5, 1.5)) / rig.pulsation * rubber,
            float(rng.uniform(0.2, 0.6)) * rig.amplitude * rubber,
        )

    def force(self, displacement: np.ndarray, velocity: np.ndarray, rig: Rig) -> np.ndarray:
        """Its force [N] on a path."""
        u = displacement / rig.farthest
        force = self.stiffness * displacement * (1.0 + self.quadratic * u + self.cubic * u**2) + self.damping * velocity
        return force + (self._rubber(displacement, rig) if self.reach else 0.0)

    def tangents(self, record: Record, rig: Rig) -> np.ndarray:
        """What a refit of the network can follow, to first order: (samples, columns)."""
        powers = range(2) if self.network == "linear" else POWERS
        columns = [(record.displacement / rig.farthest) ** power for power in powers] + [record.velocity]
        return np.column_stack(columns + (self._tangents_of_rubber(record, rig) if self.reach else []))

    def write_network(self, name: str, rig: Rig) -> str:
        """The network as a file, with starts that are not its numbers."""
        text = _NETWORK.format(name=name, spring=_SPRING[self.network]) + (_RUBBER if self.reach else "")
        sizes = {"stiffness": rig.stiffness, "damping": rig.damping, "stiffness_3": 0.3 * rig.stiffness}
        sizes |= {"stiffness_10": 0.1 * rig.stiffness, "limit": 0.05 * rig.stiffness * rig.amplitude}
        return text.format(**sizes)

    def _rubber(self, path: np.ndarray, rig: Rig) -> np.ndarray:
        return self.stiffness * (0.2 * maxwell(path, self.relaxation_time, rig.rate) + 0.15 * slider(path, self.reach))

    def _tangents_of_rubber(self, record: Record, rig: Rig) -> list[np.ndarray]:
        path, factors = record.displacement, (1.0, 1.0 + NUDGE)
        stretches = [maxwell(path, factor * self.relaxation_time, rig.rate) for factor in factors]
        slipping = [slider(path, factor * self.reach) for factor in factors]
        return [stretches[0], stretches[1] - stretches[0], slipping[0], slipping[1] - slipping[0]]

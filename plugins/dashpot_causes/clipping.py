"""A force channel at the end of its range."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Atom, Cause, Suspect, View
from dashpot.model.network import NetworkSpec
from dashpot.model.patch import add_measurement
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]
SHARES = tuple(float(share) for share in 0.002 + 0.36 * np.linspace(0.0, 1.0, 31) ** 1.5)  # of the span, below its end
KEYS = {1: "largest", -1: "least"}


class Clipping(Cause):
    """Beyond a level the force channel shows less than there is. Flat tops are found in reading already."""

    word = "clipping"
    kind = "measurement"
    about = "clipping of the force channel"
    shows = "peaks are cut at one and the same force, at every amplitude, preload and frequency"
    cure = "measure again with a larger range; leave out what lies beyond the level"
    evidence_of = "range"
    faults = ("clipping",)
    confused_with = {
        "end_stop": "another frequency: clipping comes at one force, a stop at one deflection",
        "stiffness_curve": "a hold above the level: clipping depends on the force with its damping, a curve does not",
        "lift_off": "a higher preload: lift-off vanishes; or a known steel spring: clipping stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Levels near the largest or the smallest force, above or below which part of the force is missing."""
        forces = [view.force(run) for run in view.runs]
        low, high = min(force.min() for force in forces), max(force.max() for force in forces)
        ends: dict[Literal[1, -1], float] = {1: high, -1: low}
        for side, end in ends.items():
            if f"force.{KEYS[side]}" not in network.measurement:
                levels = tuple(float(end - side * share * (high - low)) for share in SHARES)
                cut = _Cut(side, levels, (low, high))
                yield Suspect(
                    "upper level" if side > 0 else "lower level",
                    levels,
                    cut,
                    cut.extend,
                    measured=True,
                    quantity="share that is missing",
                    unit="1",
                    largest=1.0,
                )


@dataclass(frozen=True)
class _Cut:
    side: Literal[1, -1]
    levels: tuple[float, ...]
    reach: tuple[float, float]

    def __call__(self, view: View, run: str) -> Array:
        beyond = np.maximum(self.side * (view.force(run) - np.array(self.levels)[:, None]), 0.0)
        return -self.side * beyond

    def extend(self, text: str, atoms: Sequence[Atom]) -> str:
        low, high = (pretty(end, "N", 6) for end in self.reach)
        entry = f"{{start: {pretty(atoms[0][1], 'N', 6)}, bounds: [{low}, {high}]}}"
        return add_measurement(text, KEYS[self.side], entry)

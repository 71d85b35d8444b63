"""Mains in the force channel."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause, Suspect, View, unchanged
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]
MAINS = (50.0, 60.0, 100.0, 120.0)
HIGHEST = 0.4  # of the sampling rate


class Hum(Cause):
    """A line of the mains, of its own phase in every run."""

    word = "hum"
    kind = "measurement"
    about = "mains hum in the force channel"
    shows = (
        "a line at a frequency of the mains that is no harmonic of the motion; repeated runs disagree about its phase"
    )
    cure = "shield and ground the channel; take the line out by a notch filter on both channels alike"
    confused_with = {
        "resonance": "a run at rest: hum stays",
    }

    def suspects(self, view: View, network: NetworkSpec) -> Iterable[Suspect]:
        """Sine and cosine of a frequency of the mains in every run."""
        for frequency in MAINS:
            if frequency * max(view.step(run) for run in view.runs) < HIGHEST:
                lines = _Lines(frequency, tuple(view.runs))
                grid = tuple(float(k) for k in range(2 * len(lines.runs)))
                yield Suspect(f"{frequency:g} Hz", grid, lines, unchanged, joint=True, sign=0, unknowns=0,
                              mends=True, local=True, tell=lines.tell)  # fmt: skip


@dataclass(frozen=True)
class _Lines:
    frequency: float
    runs: tuple[str, ...]

    def __call__(self, view: View, run: str) -> Array:
        rows = np.zeros((2 * len(self.runs), view.force(run).size))
        if run in self.runs:
            angle = 2.0 * np.pi * self.frequency * view.step(run) * np.arange(rows.shape[1])
            place = 2 * self.runs.index(run)
            rows[place : place + 2] = np.sin(angle), np.cos(angle)
        return rows

    def tell(self, strengths: Sequence[float]) -> Mapping[str, tuple[float, str]]:
        return {"amplitude": (float(np.sqrt(2.0 * np.mean(np.square(strengths)))), "N")}

"""Mains in the force channel."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause, Suspect, View, unchanged
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]
MAINS = ((50.0,), (50.0, 150.0), (60.0,), (60.0, 180.0), (100.0,), (120.0,))  # Hz, some with a third harmonic
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
        """Sine and cosine of a frequency of the mains, alone or with its third harmonic, in every run."""
        highest = HIGHEST / max(view.step(run) for run in view.runs)
        for frequencies in (mains for mains in MAINS if max(mains) < highest):
            lines = _Lines(frequencies, tuple(view.runs))
            grid = tuple(float(k) for k in range(2 * len(frequencies) * len(lines.runs)))
            yield Suspect(" and ".join(f"{frequency:g} Hz" for frequency in frequencies), grid, lines, unchanged,
                          joint=True, sign=0, unknowns=0, mends=True, local=True, quantity="amplitude", unit="N",
                          tell=lines.tell)  # fmt: skip


@dataclass(frozen=True)
class _Lines:
    frequencies: Sequence[float]
    runs: tuple[str, ...]

    def __call__(self, view: View, run: str) -> Array:
        samples, each = view.force(run).size, 2 * len(self.frequencies)
        rows = np.zeros((each * len(self.runs), samples))
        if run in self.runs:
            angles = 2.0 * np.pi * np.outer(self.frequencies, view.step(run) * np.arange(samples))
            place = each * self.runs.index(run)
            rows[place : place + each] = np.concatenate([np.sin(angles), np.cos(angles)])
        return rows

    def tell(self, strengths: Sequence[float]) -> Mapping[str, tuple[float, str]]:
        squares = np.square(strengths).reshape(len(self.runs), 2, len(self.frequencies))
        amplitudes = np.sqrt(squares.sum(axis=1).mean(axis=0))
        names = ["amplitude", *(f"amplitude at {frequency:g} Hz" for frequency in self.frequencies[1:])]
        return {name: (float(amplitude), "N") for name, amplitude in zip(names, amplitudes, strict=True)}

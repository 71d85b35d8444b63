"""Sines of one frequency after the other."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Annotated

from dashpot.contract.rig import PORT, PlannedRun, Rig
from dashpot_rigs.waves import around, millimetres, require_sampling, sine_blocks


class SteppedSine(Rig):
    """Sines of one frequency after the other, each until it is steady; every amplitude at every preload.

    frequencies: in this order; amplitudes: zero to peak; preloads: mean deflections; cycles: at full amplitude, before
    and after which one fades in and out; sampling: of all channels.
    """

    word = "stepped_sine"

    def __init__(
        self,
        frequencies: Annotated[tuple[float, ...], "Hz"] = (1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 25.0),
        amplitudes: Annotated[tuple[float, ...], "m"] = (0.5e-3, 2e-3),
        preloads: Annotated[tuple[float, ...], "m"] = (10e-3, 20e-3),
        cycles: int = 10,
        sampling: Annotated[float, "Hz"] = 1000.0,
    ):
        if min(*frequencies, *amplitudes, cycles) <= 0.0:
            raise ValueError("frequencies, amplitudes and cycles: expected more than 0")
        require_sampling(max(frequencies), sampling)
        self.frequencies, self.cycles, self.sampling = frequencies, cycles, sampling
        self.plans = list(product(preloads, amplitudes))

    def runs(self) -> Sequence[PlannedRun]:
        """A run for each amplitude and preload; the amplitudes in one round at each preload."""
        return [self._run(*plan) for plan in self.plans]

    def _run(self, preload: float, amplitude: float) -> PlannedRun:
        path = sine_blocks([(amplitude, frequency, self.cycles) for frequency in self.frequencies], 1.0 / self.sampling)
        settings = {
            "amplitude": amplitude,
            "preload": preload,
            "start": self.frequencies[0],
            "stop": self.frequencies[-1],
        }
        name = f"steps_a{millimetres(amplitude)}_p{millimetres(preload)}"
        return PlannedRun(name, "sweep", 1.0 / self.sampling, {PORT: around(path, preload)}, settings)

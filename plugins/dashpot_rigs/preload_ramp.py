"""A sine on a preload that moves on."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Annotated

import numpy as np

from dashpot.contract.rig import PORT, PlannedRun, PrescribedPath, Rig
from dashpot_rigs.smooth_step import smooth_step
from dashpot_rigs.waves import around, millimetres, plain, require_sampling, sine_blocks


class PreloadRamp(Rig):
    """A sine whose mean deflection goes slowly from one end to the other: stiffness and damping over the preload.

    frequencies, amplitudes: one run for each pair; low, high: mean deflection at the beginning and at the end;
    duration: of the run; sampling: of all channels.
    """

    word = "preload_ramp"

    def __init__(
        self,
        frequencies: Annotated[tuple[float, ...], "Hz"] = (10.0,),
        amplitudes: Annotated[tuple[float, ...], "m"] = (1e-3,),
        low: Annotated[float, "m"] = 5e-3,
        high: Annotated[float, "m"] = 25e-3,
        duration: Annotated[float, "s"] = 30.0,
        sampling: Annotated[float, "Hz"] = 1000.0,
    ):
        if min(*frequencies, *amplitudes) <= 0.0 or duration * min(frequencies) < 10.0 or low == high:
            raise ValueError(
                "expected frequencies and amplitudes of more than 0, ten cycles and more within the "
                "duration, and two different preloads"
            )
        require_sampling(max(frequencies), sampling)
        self.plans = list(product(frequencies, amplitudes))
        self.low, self.high, self.duration, self.sampling = low, high, duration, sampling

    def runs(self) -> Sequence[PlannedRun]:
        """A run for each frequency and amplitude."""
        return [self._run(*plan) for plan in self.plans]

    def _run(self, frequency: float, amplitude: float) -> PlannedRun:
        cycles = np.floor(self.duration * frequency) - 2.0
        sine = sine_blocks([(amplitude, frequency, cycles)], 1.0 / self.sampling)
        time = np.arange(sine.displacement.size) / self.sampling
        level, rate, second = (self.high - self.low) * np.stack(smooth_step(time, float(time[-1])))
        settings = {"amplitude": amplitude, "frequency": frequency, "low": self.low, "high": self.high}
        path = around(sine, PrescribedPath(self.low + level, rate, second))
        name = f"ramp_a{millimetres(amplitude)}_f{plain(frequency)}"
        return PlannedRun(name, "transient", 1.0 / self.sampling, {PORT: path}, settings)

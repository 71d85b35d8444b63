"""Sines of one stroke and rising velocity, as dampers are measured."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

import numpy as np

from dashpot.contract.rig import PORT, PlannedRun, Rig
from dashpot_rigs.waves import around, plain, sine_blocks


class DamperLadder(Rig):
    """Sines of one stroke and rising largest velocity: force over velocity of a shock absorber.

    amplitude: half of the stroke; velocities: largest of each run, by default those that are usual for dampers of cars;
    preload: the middle of the stroke; cycles: at full amplitude; samples: of each cycle.
    """

    word = "damper_ladder"

    def __init__(
        self,
        amplitude: Annotated[float, "m"] = 50e-3,
        velocities: Annotated[tuple[float, ...], "m/s"] = (0.052, 0.131, 0.262, 0.393, 0.524, 1.047),
        preload: Annotated[float, "m"] = 0.0,
        cycles: int = 3,
        samples: int = 1000,
    ):
        if min(amplitude, *velocities, cycles) <= 0.0 or samples < 100:
            raise ValueError("amplitude, velocities and cycles: expected more than 0; samples: expected at least 100")
        self.amplitude, self.velocities, self.preload = amplitude, velocities, preload
        self.cycles, self.samples = cycles, samples

    def runs(self) -> Sequence[PlannedRun]:
        """A run for each velocity."""
        return [self._run(velocity) for velocity in self.velocities]

    def _run(self, velocity: float) -> PlannedRun:
        frequency = velocity / (2.0 * np.pi * self.amplitude)
        sample_time = 1.0 / frequency / self.samples
        path = around(sine_blocks([(self.amplitude, frequency, self.cycles)], sample_time), self.preload)
        settings = {"amplitude": self.amplitude, "frequency": frequency, "velocity": velocity, "preload": self.preload}
        return PlannedRun(f"v{plain(round(1e3 * velocity, 3))}", "harmonic", sample_time, {PORT: path}, settings)

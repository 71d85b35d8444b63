"""A programme of blocks of sines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from dashpot.contract.rig import PORT, PlannedRun, Rig
from dashpot_rigs.waves import around, require_sampling, sine_blocks


class Blocks(Rig):
    """A programme of blocks, each with an amplitude, a frequency and a number of cycles of its own, some times over.

    amplitudes: zero to peak; frequencies and cycles: one for each amplitude; rounds: of the whole programme; preload:
    mean deflection; sampling: of all channels.
    """

    word = "blocks"

    def __init__(
        self,
        amplitudes: Annotated[tuple[float, ...], "m"] = (0.2e-3, 1e-3, 3e-3, 1e-3),
        frequencies: Annotated[tuple[float, ...], "Hz"] = (20.0, 10.0, 3.0, 10.0),
        cycles: tuple[float, ...] = (40.0, 20.0, 10.0, 20.0),
        rounds: int = 2,
        preload: Annotated[float, "m"] = 15e-3,
        sampling: Annotated[float, "Hz"] = 1000.0,
    ):
        if not len(amplitudes) == len(frequencies) == len(cycles):
            raise ValueError(
                f"expected as many frequencies and cycles as the {len(amplitudes)} amplitudes, "
                f"got {len(frequencies)} and {len(cycles)}"
            )
        if min(*amplitudes, *frequencies, *cycles, rounds) <= 0.0:
            raise ValueError("amplitudes, frequencies, cycles and rounds: expected more than 0")
        require_sampling(max(frequencies), sampling)
        self.blocks = list(zip(amplitudes, frequencies, cycles, strict=True)) * rounds
        self.preload, self.sampling = preload, sampling

    def runs(self) -> Sequence[PlannedRun]:
        """One run."""
        path = around(sine_blocks(self.blocks, 1.0 / self.sampling), self.preload)
        settings = {"amplitude": max(amplitude for amplitude, _, _ in self.blocks), "preload": self.preload}
        return [PlannedRun("blocks", "transient", 1.0 / self.sampling, {PORT: path}, settings)]

"""A single-axis hydropulser."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Annotated

from dashpot.contract.rig import PORT, PlannedRun, Rig
from dashpot_rigs.sweep_path import Sweep, require_sweep
from dashpot_rigs.waves import millimetres

DIRECTIONS = ("up", "down", "both")


class Hydropulser(Rig):
    """Sweeps of one specimen, every amplitude at every preload.

    amplitudes: zero to peak; preloads: mean deflections; start, stop, duration: of a sweep; spacing: `linear` or `log`;
    direction: `up`, `down` or `both`; fade: time in which the amplitude fades in; sampling: of all channels.
    """

    word = "hydropulser"

    def __init__(
        self,
        amplitudes: Annotated[tuple[float, ...], "m"] = (0.5e-3, 2e-3, 5e-3),
        preloads: Annotated[tuple[float, ...], "m"] = (10e-3, 17e-3, 25e-3),
        start: Annotated[float, "Hz"] = 1.0,
        stop: Annotated[float, "Hz"] = 25.0,
        duration: Annotated[float, "s"] = 20.0,
        spacing: str = "linear",
        direction: str = "both",
        fade: Annotated[float, "s"] = 0.5,
        sampling: Annotated[float, "Hz"] = 1000.0,
    ):
        require_sweep(start, stop, duration, spacing, sampling)
        if direction not in DIRECTIONS:
            raise ValueError(f"direction: expected up, down or both, got '{direction}'")
        if min(amplitudes) <= 0.0 or fade < 0.0:
            raise ValueError("amplitudes: expected more than 0; fade: expected 0 or more")
        self.amplitudes, self.preloads, self.fade = amplitudes, preloads, fade
        up = Sweep(min(start, stop), max(start, stop), duration, spacing, 1.0 / sampling)
        down = Sweep(up.stop, up.start, duration, spacing, up.sample_time)
        self.sweeps = {name: s for name, s in (("up", up), ("down", down)) if direction in (name, "both")}

    def runs(self) -> Sequence[PlannedRun]:
        """A run for each amplitude, preload and direction; the amplitudes in one round at each preload."""
        return [self._run(*plan) for plan in product(self.preloads, self.amplitudes, self.sweeps)]

    def _run(self, preload: float, amplitude: float, direction: str) -> PlannedRun:
        sweep = self.sweeps[direction]
        settings = {"amplitude": amplitude, "preload": preload, "start": sweep.start, "stop": sweep.stop}
        path = sweep.path(amplitude, preload, self.fade)
        name = f"a{millimetres(amplitude)}_p{millimetres(preload)}_{direction}"
        return PlannedRun(name, "sweep", sweep.sample_time, {PORT: path}, settings)

"""Random motions."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Annotated

from dashpot.contract.rig import PORT, PlannedRun, Rig
from dashpot_rigs.waves import around, faded, millimetres, random_profile, require_sampling

FALL = {"road": 2.0, "pink": 1.0, "white": 0.0}


class Random(Rig):
    """A random deflection whose power density falls with frequency as that of a road, as pink noise, or not at all.

    spectrum: `road` (ISO 8608: with the square of frequency), `pink` (with frequency) or `white`; rms: root mean square
    of the deflection around each of the preloads; low, high: ends of the band; duration: of a run; fade: time in which
    the motion fades in and out; seed: of the random phases, counted up from run to run; sampling: of all channels.
    """

    word = "random"

    def __init__(
        self,
        spectrum: str = "road",
        rms: Annotated[tuple[float, ...], "m"] = (1e-3, 3e-3),
        preloads: Annotated[tuple[float, ...], "m"] = (15e-3,),
        low: Annotated[float, "Hz"] = 0.5,
        high: Annotated[float, "Hz"] = 25.0,
        duration: Annotated[float, "s"] = 30.0,
        fade: Annotated[float, "s"] = 1.0,
        seed: int = 0,
        sampling: Annotated[float, "Hz"] = 1000.0,
    ):
        if spectrum not in FALL:
            raise ValueError(f"spectrum: expected {', '.join(FALL)}, got '{spectrum}'")
        if min(rms) <= 0.0 or not 0.0 < low < high or not 0.0 < 2.0 * fade <= duration or duration * low < 2.0:
            raise ValueError(
                "expected an rms of more than 0, low below high, two cycles of low and more in the "
                "duration, and a fade for which there is room at both ends"
            )
        require_sampling(high, sampling)
        self.spectrum, self.band, self.duration, self.fade = spectrum, (low, high), duration, fade
        self.plans, self.seed, self.sampling = list(product(preloads, rms)), seed, sampling

    def runs(self) -> Sequence[PlannedRun]:
        """A run for each root mean square and preload."""
        return [self._run(self.seed + number, *plan) for number, plan in enumerate(self.plans)]

    def _run(self, seed: int, preload: float, rms: float) -> PlannedRun:
        sample_time = 1.0 / self.sampling
        profile = random_profile(FALL[self.spectrum], self.band, self.duration, sample_time, seed)
        path = around(faded(profile, self.fade, sample_time), preload, rms)
        settings = {"rms": rms, "preload": preload, "start": self.band[0], "stop": self.band[1]}
        name = f"{self.spectrum}_r{millimetres(rms)}_p{millimetres(preload)}"
        return PlannedRun(name, "random", sample_time, {PORT: path}, settings, {"spectrum": self.spectrum})

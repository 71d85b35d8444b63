"""Steps of the deflection, each held."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from dashpot.contract.rig import PORT, PlannedRun, Rig
from dashpot_rigs.waves import stations


class Hold(Rig):
    """Steps of the deflection, each held: relaxation and creep, on the way in and on the way out.

    places: deflections, in this order; ramp: time of each way; dwell: at each place; sampling: of all channels.
    """

    word = "hold"

    def __init__(
        self,
        places: Annotated[tuple[float, ...], "m"] = (0.0, 10e-3, 20e-3, 10e-3, 0.0),
        ramp: Annotated[float, "s"] = 0.05,
        dwell: Annotated[float, "s"] = 20.0,
        sampling: Annotated[float, "Hz"] = 1000.0,
    ):
        if len(places) < 2 or min(ramp, dwell, sampling) <= 0.0:
            raise ValueError("expected two places or more, and a ramp, a dwell and a sampling of more than 0")
        if ramp * sampling < 20.0:
            raise ValueError(f"sampling: expected at least 20 samples within a ramp of {ramp:g} s, got {sampling:g} Hz")
        self.places, self.ramp, self.dwell, self.sampling = places, ramp, dwell, sampling

    def runs(self) -> Sequence[PlannedRun]:
        """One run."""
        path = stations(self.places, self.ramp, self.dwell, 1.0 / self.sampling)
        settings = {"ramp": self.ramp, "dwell": self.dwell}
        return [PlannedRun("hold", "hold", 1.0 / self.sampling, {PORT: path}, settings)]

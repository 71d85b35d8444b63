"""The phase shift test of a suspension: a wheel on a platform that shakes it slower and slower."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from dashpot.contract.rig import PlannedRun, Rig
from dashpot_rigs.inspection import inspection_runs


class PhaseShift(Rig):
    """The phase shift test of a car that is free to move, such as `quarter_car`: from 25 Hz down by 1.25 Hz a second.

    The least angle between platform and contact force is the metric `phase_shift`.
    amplitude: of the platform; start, stop, duration: of the falling sweep; rest: before it, for the static force;
    steady: at the highest frequency; added_masses: on the wheel, one run each; node: the one that the platform drives,
    where there are several; sampling: of all channels.
    """

    word = "phase_shift"

    def __init__(
        self,
        amplitude: Annotated[float, "m"] = 3e-3,
        start: Annotated[float, "Hz"] = 25.0,
        stop: Annotated[float, "Hz"] = 5.0,
        duration: Annotated[float, "s"] = 16.0,
        rest: Annotated[float, "s"] = 1.0,
        steady: Annotated[float, "s"] = 2.0,
        added_masses: Annotated[tuple[float, ...], "kg"] = (0.0,),
        node: str = "",
        sampling: Annotated[float, "Hz"] = 1000.0,
    ):
        self.planned = inspection_runs(
            self.word, amplitude, start, stop, duration, rest, steady, added_masses, node, sampling
        )

    def runs(self) -> Sequence[PlannedRun]:
        """A run for each added mass."""
        return self.planned

"""Both wheels of an axle on their platforms, the body held."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from typing import Annotated

from dashpot.contract.rig import PlannedRun, PrescribedPath, Rig
from dashpot_rigs.sweep_path import Sweep, require_sweep

PHASES = {"in_phase": 1.0, "anti_phase": -1.0}


class AxleSweep(Rig):
    """A sweep of both platforms, in phase and in anti-phase, for each mass added to the wheels; the body is held.

    The motion is around the design position, deflection 0. amplitude: of each platform; start, stop, duration,
    spacing: of a sweep; added_masses: on each wheel, one variant each; phases: `in_phase`, `anti_phase` or `both`;
    left, right: the nodes that the platforms drive; fade: time in which the amplitude fades in; sampling: of all
    channels.
    """

    word = "axle_sweep"

    def __init__(
        self,
        amplitude: Annotated[float, "m"] = 3e-3,
        start: Annotated[float, "Hz"] = 5.0,
        stop: Annotated[float, "Hz"] = 20.0,
        duration: Annotated[float, "s"] = 60.0,
        spacing: str = "linear",
        added_masses: Annotated[tuple[float, ...], "kg"] = (0.0, 5.0, 10.0, 15.0),
        phases: str = "both",
        left: str = "platform_left",
        right: str = "platform_right",
        fade: Annotated[float, "s"] = 0.5,
        sampling: Annotated[float, "Hz"] = 1000.0,
    ):
        require_sweep(start, stop, duration, spacing, sampling)
        if phases not in (*PHASES, "both"):
            raise ValueError(f"phases: expected in_phase, anti_phase or both, got '{phases}'")
        if amplitude <= 0.0 or fade < 0.0 or left == right:
            raise ValueError("expected an amplitude of more than 0, a fade of 0 or more, and two different nodes")
        self.amplitude, self.added_masses, self.fade = amplitude, added_masses, fade
        self.sweep = Sweep(start, stop, duration, spacing, 1.0 / sampling)
        self.phases = tuple(PHASES) if phases == "both" else (phases,)
        self.left, self.right = left, right

    def runs(self) -> Sequence[PlannedRun]:
        """A run for each added mass and phase."""
        path = self.sweep.path(self.amplitude, 0.0, self.fade)
        return [self._run(path, *plan) for plan in product(self.added_masses, self.phases)]

    def _run(self, path: PrescribedPath, added_mass: float, phase: str) -> PlannedRun:
        settings = {
            "amplitude": self.amplitude,
            "start": self.sweep.start,
            "stop": self.sweep.stop,
            "added_mass": added_mass,
        }
        motion = {self.left: path, self.right: path if PHASES[phase] > 0.0 else opposite(path)}
        name = f"{phase}_m{added_mass:.6g}".replace(".", "p")
        return PlannedRun(name, "sweep", self.sweep.sample_time, motion, settings, {"phase": phase})


def opposite(path: PrescribedPath) -> PrescribedPath:
    """The path mirrored at deflection 0."""
    return replace(path, displacement=-path.displacement, velocity=-path.velocity, acceleration=-path.acceleration)

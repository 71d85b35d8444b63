"""Platforms under all wheels of a car."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from dashpot.contract.rig import PlannedRun, PrescribedPath, Rig
from dashpot_rigs.sweep_path import Sweep, require_sweep
from dashpot_rigs.waves import around, millimetres

MODES = {"heave": (1, 1, 1, 1), "roll": (1, -1, 1, -1), "pitch": (1, 1, -1, -1), "warp": (1, -1, -1, 1)}


class FourPost(Rig):
    """Sweeps of the platforms under an axle or a car: heave and roll, with a rear axle also pitch and warp.

    amplitude: of each platform; start, stop, duration, spacing: of a sweep; front_left, front_right, rear_left,
    rear_right: the nodes that the platforms drive, the rear ones being left out for an axle; fade: time in which the
    amplitude fades in; sampling: of all channels.
    """

    word = "four_post"

    def __init__(
        self,
        amplitude: Annotated[float, "m"] = 3e-3,
        start: Annotated[float, "Hz"] = 0.5,
        stop: Annotated[float, "Hz"] = 25.0,
        duration: Annotated[float, "s"] = 60.0,
        spacing: str = "log",
        front_left: str = "platform_left",
        front_right: str = "platform_right",
        rear_left: str = "",
        rear_right: str = "",
        fade: Annotated[float, "s"] = 0.5,
        sampling: Annotated[float, "Hz"] = 1000.0,
    ):
        require_sweep(start, stop, duration, spacing, sampling)
        self.nodes = [node for node in (front_left, front_right, rear_left, rear_right) if node]
        if len(self.nodes) not in (2, 4) or len(set(self.nodes)) < len(self.nodes) or not (front_left and front_right):
            raise ValueError(f"expected the two front nodes, or four different ones, got {', '.join(self.nodes)}")
        if amplitude <= 0.0 or fade < 0.0:
            raise ValueError("expected an amplitude of more than 0 and a fade of 0 or more")
        self.amplitude, self.fade = amplitude, fade
        self.sweep = Sweep(start, stop, duration, spacing, 1.0 / sampling)

    def runs(self) -> Sequence[PlannedRun]:
        """A run for each mode."""
        path = self.sweep.path(self.amplitude, 0.0, self.fade)
        modes = list(MODES)[: len(self.nodes)]
        return [self._run(path, mode) for mode in modes]

    def _run(self, path: PrescribedPath, mode: str) -> PlannedRun:
        settings = {"amplitude": self.amplitude, "start": self.sweep.start, "stop": self.sweep.stop}
        motion = {node: around(path, 0.0, float(sign)) for node, sign in zip(self.nodes, MODES[mode], strict=False)}
        name = f"{mode}_a{millimetres(self.amplitude)}"
        return PlannedRun(name, "sweep", self.sweep.sample_time, motion, settings, {"phase": mode})

"""A quasi-static triangle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from dashpot.contract.rig import PORT, PlannedRun, Rig
from dashpot_rigs.triangle_path import triangle_path


class Triangle(Rig):
    """Slow loops from first contact to `depth` and back, for the elastic curve and the width of dry friction.

    depth: deepest deflection; speed: of the actuator, at most 1 mm/s so that relaxation and damping keep out; loops:
    how many, of which the first beds in; corner: time before and after a turn in which the speed fades; sampling: of
    all channels.
    """

    word = "triangle"

    def __init__(
        self,
        depth: Annotated[float, "m"] = 30e-3,
        speed: Annotated[float, "m/s"] = 1e-3,
        loops: int = 3,
        corner: Annotated[float, "s"] = 0.2,
        sampling: Annotated[float, "Hz"] = 100.0,
    ):
        if min(depth, speed, corner, sampling, loops) <= 0.0:
            raise ValueError("depth, speed, corner, sampling and loops: expected more than 0")
        if corner > depth / speed:
            raise ValueError(f"corner: expected at most the {depth / speed:g} s of a climb, got {corner:g} s")
        self.depth, self.speed, self.loops, self.corner, self.sampling = depth, speed, loops, corner, sampling

    def runs(self) -> Sequence[PlannedRun]:
        """One run."""
        path = triangle_path(self.depth, self.speed, self.loops, self.corner, 1.0 / self.sampling)
        settings = {"speed": self.speed, "depth": self.depth}
        return [PlannedRun("quasi_static", "quasi_static", 1.0 / self.sampling, {PORT: path}, settings)]

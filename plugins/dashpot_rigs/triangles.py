"""Triangles of several speeds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from dashpot.contract.rig import PORT, PlannedRun, Rig
from dashpot_rigs.triangle_path import triangle_path
from dashpot_rigs.waves import around, millimetres, plain

SLOW = 1e-3  # m/s, up to which relaxation and damping keep out
CORNER = 0.1  # of a climb, before and after a turn


class Triangles(Rig):
    """Triangles of several speeds around one place: what of the width of the loop is friction, and what damping.

    amplitude: from the middle to a turn; preload: the middle; speeds: one run each, up to 1 mm/s a quasi-static one;
    loops: of each run; samples: of each loop.
    """

    word = "triangles"

    def __init__(
        self,
        amplitude: Annotated[float, "m"] = 5e-3,
        preload: Annotated[float, "m"] = 15e-3,
        speeds: Annotated[tuple[float, ...], "m/s"] = (0.1e-3, 1e-3, 10e-3, 100e-3),
        loops: int = 3,
        samples: int = 2000,
    ):
        if min(amplitude, *speeds, loops) <= 0.0 or samples < 100:
            raise ValueError("amplitude, speeds and loops: expected more than 0; samples: expected at least 100")
        self.amplitude, self.preload, self.speeds = amplitude, preload, speeds
        self.loops, self.samples = loops, samples

    def runs(self) -> Sequence[PlannedRun]:
        """A run for each speed."""
        return [self._run(speed) for speed in self.speeds]

    def _run(self, speed: float) -> PlannedRun:
        depth = 2.0 * self.amplitude
        sample_time = 2.0 * depth / speed / self.samples
        path = triangle_path(depth, speed, self.loops, CORNER * depth / speed, sample_time)
        settings = {"speed": speed, "amplitude": self.amplitude, "preload": self.preload}
        name = f"triangle_v{plain(1e3 * speed)}_a{millimetres(self.amplitude)}"
        return PlannedRun(
            name,
            "quasi_static" if speed <= SLOW else "transient",
            sample_time,
            {PORT: around(path, self.preload - self.amplitude)},
            settings,
        )

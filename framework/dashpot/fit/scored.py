"""A run as a fit sees it: its drive, its measured force, and the samples that count."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.data.excitation import Excitation
from dashpot.data.reversals import noise_threshold, turning_points
from dashpot.data.run import Run
from dashpot.data.steady import SAMPLES, STEADY, fundamental_of

Array = NDArray[np.float64]

LARGEST_WARM_UP = 0.15


@dataclass(frozen=True, eq=False)
class ScoredRun:
    """``force`` (n,) in N is measured; samples before ``first`` are the warm-up, in which friction finds its state.

    It is measured at the node ``end``, which moves by ``drive``; ``whole`` holds the motions of all nodes, and runs of
    one ``record`` were measured together. ``weight`` is what it counts beside others.
    """

    name: str
    kind: str
    drive: Drive
    force: Array
    first: int
    end: str = ""
    record: str = ""
    whole: Excitation | None = None
    weight: float = 1.0

    def seen(self, force: Array) -> Array:
        """Simulated forces (..., n) as the measurement would know them: of a steady sine the fundamental alone."""
        return fundamental_of(force) if self.kind == STEADY else force

    @cached_property
    def excitation(self) -> Excitation:
        """What drives the specimen."""
        return Excitation.of_drive(self.drive) if self.whole is None else replace(self.whole, motions=self.motions)

    @property
    def motions(self) -> dict[str, Drive]:
        """The motions of all nodes."""
        return {**(self.whole.motions if self.whole else {}), self.end: self.drive}

    @property
    def samples(self) -> int:
        """How many samples count."""
        return self.force.size - self.first


def score_run(run: Run) -> ScoredRun:
    """The run with its path; the first whole cycle warms up, but never more than 15 % of the record."""
    whole = Excitation.of_run(run)
    return ScoredRun(run.name, run.kind, whole.motions[run.end], run.force, warm_up(run), run.end, run.record, whole)


def weighted(runs: Sequence[Run]) -> list[ScoredRun]:
    """The runs as a fit sees them; rows of tables count by the scatter stated of them, on average as one run."""
    noises = {
        run.name: run.sensors["force"]["noise"]
        for run in runs
        if run.kind == STEADY and "noise" in run.sensors.get("force", {})
    }
    mean = np.mean([noise**-2 for noise in noises.values()]) if noises else 1.0
    return [
        replace(score_run(run), weight=float(noises[run.name] ** -2 / mean) if run.name in noises else 1.0)
        for run in runs
    ]


def warm_up(run: Run) -> int:
    """Samples until the motion has been through one cycle; ``settings: {warm_up: 2 s}`` decides it by hand."""
    if run.kind == STEADY:
        return run.displacement.size - SAMPLES
    if "warm_up" in run.settings:
        return min(int(run.settings["warm_up"] / run.sample_time), run.displacement.size // 2)
    points = turning_points(run.displacement, max(noise_threshold(run.displacement), 1e-2 * np.ptp(run.displacement)))
    cycle = int(points[1]) if points.size > 1 else 0
    return min(cycle, int(LARGEST_WARM_UP * run.displacement.size))

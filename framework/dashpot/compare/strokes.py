"""A run cut at its reversals: strokes, closed cycles, and the work that a cycle takes up."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.data.excitation import Excitation
from dashpot.data.reversals import noise_threshold, stroke_edges
from dashpot.data.run import Run
from dashpot.fit.scored import warm_up

Array = NDArray[np.float64]

SMALLEST_STROKE = 0.05  # of the range of the deflection: smaller wiggles are no reversals
FEWEST = 8  # samples of a stroke and of a cycle
CLOSED = 0.1  # of the stroke: so far apart may the ends of a closed cycle be


@dataclass(frozen=True, eq=False)
class CycleValues:
    """Of k closed cycles: ``time`` (k,) s of their middle, ``energy`` J taken up, ``stiffness`` and ``loss`` in N/m.

    Stiffness is the slope of the regression of force over deflection, loss that of the ellipse with the same area:
    energy / (pi amplitude^2).
    """

    time: Array
    energy: Array
    stiffness: Array
    loss: Array


@dataclass(frozen=True, eq=False)
class Seen:
    """A run as its pictures show it: the measured force and simulated ones (n,) N by label, over one motion.

    ``displacement`` m, ``velocity`` m/s; ``first`` is the sample at which the warm-up ends; ``edges`` are the samples
    of start, reversals and end.
    """

    run: Run
    displacement: Array
    velocity: Array
    forces: Mapping[str, Array]
    first: int
    edges: NDArray[np.intp]

    @property
    def name(self) -> str:
        """The name of the run."""
        return self.run.name

    @property
    def amplitude(self) -> float:
        """Half the range of the deflection after the warm-up, m."""
        return 0.5 * float(np.ptp(self.displacement[self.first :]))

    @property
    def preload(self) -> float:
        """The middle of the deflection after the warm-up, m."""
        after = self.displacement[self.first :]
        return 0.5 * float(after.min() + after.max())

    @property
    def peak_speed(self) -> float:
        """The largest speed after the warm-up, m/s."""
        return float(np.abs(self.velocity[self.first :]).max())

    def strokes(self, share: float = 0.2) -> list[tuple[int, int]]:
        """First and last sample of the strokes over this share of the range, without the last one, which is cut off."""
        least = share * 2.0 * self.amplitude
        last = -1 if self.edges.size > 3 else None
        pairs = zip(self.edges[:last].tolist(), self.edges[1:last].tolist(), strict=False)
        return [
            (a, b)
            for a, b in pairs
            if a >= self.first and b - a >= FEWEST and abs(self.displacement[b] - self.displacement[a]) >= least
        ]

    def cycles(self) -> list[tuple[int, int]]:
        """First and last sample of the closed cycles, each from a reversal to the next but one."""
        points = self.edges[1:-1]
        points = points[points >= self.first].tolist()
        x = self.displacement
        if len(points) < 3 and self.edges.size > 2:
            points = self.edges[:3].tolist()  # a single loop from the start
        return [
            (a, c)
            for a, b, c in zip(points[::2], points[1::2], points[2::2], strict=False)
            if c - a >= FEWEST and abs(x[c] - x[a]) <= CLOSED * abs(x[b] - x[a])
        ]

    @cached_property
    def cycle_values(self) -> dict[str, CycleValues]:
        """What the closed cycles say, with each of the forces."""
        cycles = self.cycles()
        time = np.array([self.run.sample_time * 0.5 * (a + c) for a, c in cycles])
        rows = {
            label: [_cycle(self.displacement[a : c + 1], force[a : c + 1]) for a, c in cycles]
            for label, force in self.forces.items()
        }
        return {label: CycleValues(time, *np.reshape(values, (-1, 3)).T) for label, values in rows.items()}


def see(run: Run, simulated: Mapping[str, Mapping[str, Array]] | None = None) -> Seen:
    """The run with its measured force and with those of ``simulated[label][run]`` (n,) N that there are."""
    path = Excitation.of_run(run).motions[""]
    forces = {"measured": np.asarray(run.force, dtype=float)}
    forces |= {label: found[run.name] for label, found in (simulated or {}).items() if run.name in found}
    least = max(noise_threshold(run.displacement), SMALLEST_STROKE * float(np.ptp(run.displacement)))
    edges = stroke_edges(path.displacement, least)
    return Seen(run, path.displacement, path.velocity, forces, warm_up(run), edges)


def work(x: Array, force: Array) -> float:
    """The work in J done on a path that is closed by the straight line back to its start."""
    steps, mean = np.diff(x), 0.5 * (force[1:] + force[:-1])
    return float(mean @ steps + 0.5 * (force[0] + force[-1]) * (x[0] - x[-1]))


def _cycle(x: Array, force: Array) -> tuple[float, float, float]:
    energy, about = work(x, force), x - x.mean()
    amplitude = 0.5 * float(np.ptp(x))
    return energy, float(about @ force / (about @ about)), energy / (np.pi * amplitude**2)

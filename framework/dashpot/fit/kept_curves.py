"""Refining parameters beside a curve that is kept as the slow loop gives it.

The force of a slow loop is that of the whole network: where slow relaxation or friction takes another share of it, the
curve has to take another one, too. So the knots are refined with the other numbers, while the mid line of the simulated
loop is held at that of the measured one, as closely as the loop tells it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from dashpot.data.loop import middle_of_loop
from dashpot.fit.coordinates import Coordinates, search_coordinates, with_point
from dashpot.fit.grounding import free_curves, moved_curve, widest
from dashpot.fit.linear import Loss
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.model.network import Characteristic, NetworkSpec, Slot

Array = NDArray[np.float64]
Result = TypeVar("Result")

FINEST = 1e-2  # of the loss: a mid line is not taken as better known


class BesideMidLine:
    """The loss of an objective, and beside it the misfit of the mid line of a slow loop, times ``weight``.

    The loss is the root of the sum of both squares. The ``weight`` is the loss over the scatter of the mid line: the
    line counts by how well it is known, however large the residual is elsewhere.
    """

    def __init__(self, objective: Objective, slow: ScoredRun, loss: float) -> None:
        self.objective = objective
        self.slow = Objective(objective.network, [replace(slow, first=0)], objective.jobs)
        self.middle = middle_of_loop(slow.drive.displacement)
        scatter = float(np.sqrt(np.mean(self._misfit(objective.network.start) ** 2)))
        self.weight = loss / np.clip(scatter, FINEST * loss, loss) if loss > 0.0 else 1.0

    def losses(self, values: Array) -> Array:
        """The loss of every lane (lanes,) of slots in SI; a lane that fails costs infinity."""
        return np.hypot(self.objective.losses(values), self.beside(values))

    def beside(self, values: Array) -> Array:
        """What the mid line adds to the loss of every lane (lanes,), in its square."""
        squares = np.mean(self._misfit(values) ** 2, axis=1)
        return np.asarray(self.weight * np.sqrt(np.where(squares >= 0.0, squares, np.inf)))

    def linearise(self, values: Array, moves: Array, reduce: Callable[[int, Array], Result]) -> Iterator[Result]:
        """As that of an objective; the mid line (1 + k, m) comes behind all runs."""
        factor = self.weight * np.sqrt(self.objective.total / self.middle.shape[0])

        def of_middle(_: int, rows: Array) -> Result:
            return reduce(len(self.objective.runs), factor * (self.middle @ rows.T).T)

        yield from self.objective.linearise(values, moves, reduce)
        yield from self.slow.linearise(values, moves, of_middle)

    def _misfit(self, values: Array) -> Array:
        """The mid line (lanes, m) of simulated minus measured force, N."""
        return np.asarray((self.middle @ self.slow.misfits(values).T).T)


@dataclass(frozen=True, eq=False)
class Refinement:
    """What a refinement of a network works on: coordinates, those of knots of kept curves among them, and a loss."""

    spec: NetworkSpec
    free: NetworkSpec
    coordinates: Coordinates
    loss: Loss

    def of_data(self, point: Array, loss: float) -> float:
        """The loss of the objective alone at a point (p,) with this ``loss``."""
        if not isinstance(self.loss, BesideMidLine):
            return loss
        beside = float(self.loss.beside(self.coordinates.to_values(point))[0])
        return float(np.sqrt(max(loss**2 - beside**2, 0.0)))

    def at(self, point: Array) -> NetworkSpec:
        """The network with the parameters of a point (p,); a kept curve goes on being one."""
        found = with_point(self.free, self.coordinates, point)
        for path, curve in kept_curves(self.spec).items():
            force = np.array([value.number for value in found.curves()[path].values])
            found = found.with_curve(path, moved_curve(curve, force))
        return found


def refinement(spec: NetworkSpec, objective: Objective, chosen: Callable[[Slot], bool]) -> Refinement:
    """The refinement of the parameters that are ``chosen`` on an objective of the network.

    A kept curve of which knots are chosen follows the other numbers, as the widest slow loop among the runs wants it;
    without such a loop it stays as it is.
    """
    kept, slow, free = kept_curves(spec), widest(objective.runs), free_curves(spec)
    coordinates = search_coordinates(free, chosen)
    if slow is None or not any(path.partition("[")[0] in kept for path in coordinates.paths):
        return Refinement(spec, spec, search_coordinates(spec, chosen), objective)
    error = float(objective.losses(objective.network.start)[0])
    return Refinement(spec, free, coordinates, BesideMidLine(objective, slow, error))


def kept_curves(spec: NetworkSpec) -> dict[str, Characteristic]:
    """The curves, by path, that have been taken from data and are not to be refined freely."""
    return {path: curve for path, curve in spec.data_curves().items() if not curve.refine}

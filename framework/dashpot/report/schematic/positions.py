"""Where everything stands across the force: the shortest nodes and straightest chains that leave room for all.

A mixed-integer linear program: what stands side by side keeps its distance, each node reaches over its branches.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import coo_array

STRAIGHT, SHORT, CENTRED = 1.0, 0.1, 0.05  # what the program weighs against each other


@dataclass
class Program:
    """Unknown places, at least 0, with lower bounds on sums of them, and the costs of distances."""

    whole: bool
    costs: list[float] = field(default_factory=list)
    rows: list[tuple[Mapping[int, float], float]] = field(default_factory=list)

    def unknown(self, cost: float = 0.0) -> int:
        """A new place."""
        self.costs.append(cost)
        return len(self.costs) - 1

    def demand(self, terms: Mapping[int, float], least: float) -> None:
        """The weighted sum of places is at least this."""
        self.rows.append((terms, least))

    def apart(self, left: int, right: int, distance: float) -> None:
        """One place is so far to the right of another."""
        self.demand({left: -1.0, right: 1.0}, distance)

    def near(self, terms: Mapping[int, float], weight: float) -> None:
        """The weighted sum of places costs its magnitude."""
        size = self.unknown(weight)
        self.demand({**terms, size: 1.0}, 0.0)
        self.demand({**{place: -factor for place, factor in terms.items()}, size: 1.0}, 0.0)

    def solve(self) -> list[float]:
        """The places. RuntimeError when the demands contradict each other, which those of a drawing never do."""
        entries = [(row, place, factor) for row, (terms, _) in enumerate(self.rows) for place, factor in terms.items()]
        rows, places, factors = zip(*entries, strict=True)
        matrix = coo_array((factors, (rows, places)), shape=(len(self.rows), len(self.costs))).tocsr()
        found = milp(
            np.array(self.costs),
            constraints=LinearConstraint(matrix, lb=[least for _, least in self.rows]),
            integrality=np.full(len(self.costs), int(self.whole)),
            bounds=Bounds(0.0, np.inf),
        )
        if found.x is None:
            raise RuntimeError(f"the places of the drawing cannot be found: {found.message}")
        return [float(np.round(place, 0 if self.whole else 3)) for place in found.x]

"""Optimizers one after the other, as in `pso+least_squares`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from dashpot.contract.optimizer import Blocks, Optimizer, Search, Space, losses_of


class Chain(Search):
    """Each part starts from the best point of all parts before it."""

    word = "chain"

    def __init__(self, parts: Sequence[Optimizer]):
        self._parts = tuple(parts)

    def search(self, space: Space, rng: np.random.Generator) -> Blocks:
        """Run the parts in turn and pass the best point on."""
        best = np.inf
        for part in self._parts:
            part.begin(space, int(rng.integers(2**32)))
            try:
                while (points := part.ask()) is not None:
                    self.needs = part.needs
                    values = yield points
                    losses = losses_of(values)
                    if losses.min() < best:
                        best, space = losses.min(), replace(space, start=points[np.argmin(losses)])
                    part.tell(points, values)
            finally:
                part.close()
        return "; ".join(filter(None, (part.conclusion for part in self._parts)))

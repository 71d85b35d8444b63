"""Any optimizer from several starts at once."""

from __future__ import annotations

import numpy as np

from dashpot.contract.chain import make_optimizer
from dashpot.contract.optimizer import Blocks, Search, Space
from dashpot.contract.registry import load_registry
from dashpot.contract.side_by_side import agreement, side_by_side
from dashpot_optimizers.latin_hypercube import scatter
from dashpot_optimizers.option import require


class Multistart(Search):
    """An optimizer with its default options from the start and from a Latin hypercube of others, all in step.

    of: word of the optimizer, or a chain `A+B`; starts: how many.
    """

    word = "multistart"

    def __init__(self, of: str = "least_squares", starts: int = 8):
        require("starts", starts, 1)
        self.of, self.starts = of, starts

    def search(self, space: Space, rng: np.random.Generator) -> Blocks:
        """Run one search from each start."""
        spaces = [Space(space.names, start) for start in scatter(rng, self.starts, space.start)]
        seeds = [int(seed) for seed in rng.integers(2**32, size=self.starts)]
        known = load_registry().optimizers
        members = [make_optimizer(self.of, known) for _ in spaces]
        return agreement((yield from side_by_side(self, members, spaces, seeds)))

"""The optimizers of the library nevergrad."""

from __future__ import annotations

import numpy as np

from dashpot.contract.optimizer import Blocks, Search, Space
from dashpot_optimizers.option import require


class Nevergrad(Search):
    """A method of the library nevergrad, asked for a block of points at a time.

    method: its name in nevergrad's registry (such as `TwoPointsDE`, `PSO`, `CMA`); block: points of a block;
    evaluations: after which the search ends, unless the budget of the study is smaller.

    Bennet et al., SIGEVOlution 14 (2021) 8.
    """

    word = "nevergrad"
    needs = "losses"
    library = "nevergrad"

    def __init__(self, method: str = "TwoPointsDE", block: int = 32, evaluations: int = 10000):
        require("block", block, 1)
        require("evaluations", evaluations, block)
        self.method, self.block, self.evaluations = method, block, evaluations

    def search(self, space: Space, rng: np.random.Generator) -> Blocks:
        """Ask block by block until the evaluations are spent."""
        import nevergrad

        if self.method not in nevergrad.optimizers.registry:
            raise ValueError(f"method: expected a name of nevergrad's registry, got '{self.method}'")
        total = min(self.evaluations, self.allowance or self.evaluations)
        cube = nevergrad.p.Array(init=np.array(space.start), lower=0.0, upper=1.0)
        cube.random_state.seed(int(rng.integers(2**32)))
        library = nevergrad.optimizers.registry[self.method](cube, budget=total, num_workers=self.block)
        library.suggest(np.array(space.start))
        for _ in range(total // self.block):
            candidates = [library.ask() for _ in range(self.block)]
            losses = yield np.clip([candidate.value for candidate in candidates], 0.0, 1.0)
            for candidate, loss in zip(candidates, losses, strict=True):
                library.tell(candidate, float(loss) if np.isfinite(loss) else 1e300)
        return f"{total} evaluations done"

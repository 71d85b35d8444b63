"""The samplers of the library optuna."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.contract.optimizer import Blocks, Search, Space
from dashpot_optimizers.option import require


class Optuna(Search):
    """A sampler of the library optuna, asked for a block of points at a time.

    sampler: `tpe`, `cmaes`, `gp` or `random`; block: points of a block; evaluations: after which the search ends.
    Its samplers look at every earlier point, so they are for few and expensive evaluations.

    Akiba et al., Proc. KDD (2019) 2623.
    """

    word = "optuna"
    needs = "losses"
    library = "optuna"

    def __init__(self, sampler: str = "tpe", block: int = 16, evaluations: int = 1000):
        if sampler not in ("tpe", "cmaes", "gp", "random"):
            raise ValueError(f"sampler: expected tpe, cmaes, gp or random, got '{sampler}'")
        require("block", block, 1)
        require("evaluations", evaluations, block)
        self.sampler, self.block, self.evaluations = sampler, block, evaluations

    def search(self, space: Space, rng: np.random.Generator) -> Blocks:
        """Ask block by block until the evaluations are spent."""
        import optuna

        optuna.logging.set_verbosity(optuna.logging.ERROR)
        study = optuna.create_study(sampler=self._sampler(int(rng.integers(2**31))))
        names = [f"p{number}" for number in range(space.size)]
        study.enqueue_trial(dict(zip(names, space.start.tolist(), strict=True)))
        ranges = {name: optuna.distributions.FloatDistribution(0.0, 1.0) for name in names}
        for _ in range(-(-self.evaluations // self.block)):
            trials = [study.ask(ranges) for _ in range(self.block)]
            losses = yield np.array([[trial.params[name] for name in names] for trial in trials])
            for trial, loss in zip(trials, losses, strict=True):
                study.tell(trial, float(loss) if np.isfinite(loss) else 1e300)
        return f"{self.evaluations} evaluations done"

    def _sampler(self, seed: int) -> Any:
        from optuna import samplers

        kinds = {
            "tpe": lambda: samplers.TPESampler(seed=seed, constant_liar=True),
            "cmaes": lambda: samplers.CmaEsSampler(seed=seed),
            "gp": lambda: samplers.GPSampler(seed=seed),
            "random": lambda: samplers.RandomSampler(seed=seed),
        }
        return kinds[self.sampler]()

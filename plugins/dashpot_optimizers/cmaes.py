"""Covariance matrix adaptation."""

from __future__ import annotations

from typing import Any

import numpy as np

from dashpot.contract.optimizer import Blocks, Search, Space
from dashpot_optimizers.option import require

MEMORY = 20


class CovarianceMatrixAdaptation(Search):
    """CMA-ES of the library `cmaes`; whenever it has converged it begins again with twice the population (IPOP).

    population: points of a block; sigma: standard deviation of the first block, in the unit cube; restarts: new
    beginnings from random points; separable: adapt a diagonal only, for very many parameters; tolerance: relative
    gain over 20 blocks below which a run has converged; iterations: blocks of one run.

    Auger and Hansen, Proc. IEEE CEC (2005) 1769.
    """

    word = "cmaes"
    needs = "losses"

    def __init__(
        self,
        population: int = 32,
        sigma: float = 0.2,
        restarts: int = 2,
        separable: bool = False,
        tolerance: float = 1e-6,
        iterations: int = 600,
    ):
        require("population", population, 4)
        require("sigma", sigma, 1e-6, 1.0)
        require("restarts", restarts, 0)
        require("tolerance", tolerance, 0.0)
        require("iterations", iterations, 1)
        self.population, self.sigma, self.restarts = population, sigma, restarts
        self.separable, self.tolerance, self.iterations = separable, tolerance, iterations

    def search(self, space: Space, rng: np.random.Generator) -> Blocks:
        """One run from the start, the others from random points."""
        yield space.start[None, :]
        for run in range(self.restarts + 1):
            mean = space.start if run == 0 else rng.random(space.size)
            yield from self._run(self._library(mean, self.population * 2**run, int(rng.integers(2**32))))
        return f"{self.restarts + 1} runs done"

    def _library(self, mean: np.ndarray, population: int, seed: int) -> Any:
        from cmaes import CMA, SepCMA

        kind = SepCMA if self.separable and len(mean) > 1 else CMA
        cube = np.tile([0.0, 1.0], (len(mean), 1))
        return kind(mean=mean.copy(), sigma=self.sigma, bounds=cube, seed=seed, population_size=population)

    def _run(self, library: Any) -> Blocks:
        records = [np.inf]
        for _ in range(self.iterations):
            points = np.array([library.ask() for _ in range(library.population_size)])
            losses = yield points
            library.tell(list(zip(points, losses, strict=True)))
            records.append(min(records[-1], losses.min()))
            if self._settled(records) or self._degenerate(library):
                break
        return None

    def _degenerate(self, library: Any) -> bool:
        # the library subtracts losses that may be inf, and takes roots of variances that its update made negative
        with np.errstate(invalid="ignore"):
            return bool(library.should_stop())

    def _settled(self, records: list[float]) -> bool:
        return len(records) > MEMORY and records[-1] >= records[-MEMORY] * (1.0 - self.tolerance)

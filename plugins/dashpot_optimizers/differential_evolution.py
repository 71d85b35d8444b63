"""Differential evolution."""

from __future__ import annotations

import numpy as np

from dashpot.contract.bridged import Bridged, Evaluate
from dashpot.contract.optimizer import Space
from dashpot_optimizers.latin_hypercube import scatter
from dashpot_optimizers.option import require


class DifferentialEvolution(Bridged):
    """scipy's differential evolution; a generation is one block of lanes.

    population: points of a generation; generations: blocks asked, the first included; strategy: how scipy makes a
    trial point; crossover: share of its coordinates that are new; tolerance: the search ends when the losses of the
    population agree that closely (standard deviation over mean).

    Storn and Price, J. Global Optim. 11 (1997) 341.
    """

    word = "differential_evolution"
    needs = "losses"

    def __init__(
        self,
        population: int = 96,
        generations: int = 300,
        strategy: str = "best1bin",
        crossover: float = 0.9,
        tolerance: float = 1e-4,
    ):
        require("population", population, 5)
        require("generations", generations, 2)
        require("crossover", crossover, 0.0, 1.0)
        require("tolerance", tolerance, 0.0)
        self.population, self.generations = population, generations
        self.strategy, self.crossover, self.tolerance = strategy, crossover, tolerance

    def minimize(self, evaluate: Evaluate, space: Space, seed: int) -> str:
        """Run scipy on a Latin hypercube that holds the start."""
        from scipy.optimize import differential_evolution

        rng = np.random.default_rng(seed)
        solution = differential_evolution(
            lambda columns: evaluate(columns.T),
            [(0.0, 1.0)] * space.size,
            strategy=self.strategy,
            maxiter=self.generations - 1,
            init=scatter(rng, self.population, space.start),
            recombination=self.crossover,
            tol=self.tolerance,
            polish=False,
            vectorized=True,
            updating="deferred",
            rng=rng,
        )
        return str(solution.message)

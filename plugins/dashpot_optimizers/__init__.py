"""The built-in optimizers, one method per file; the name of the file is the word a user gives."""

from __future__ import annotations

from dashpot.contract.hooks import hookimpl


@hookimpl
def dashpot_optimizers() -> list[type]:
    """Every optimizer of this package."""
    from dashpot_optimizers.cmaes import CovarianceMatrixAdaptation
    from dashpot_optimizers.differential_evolution import DifferentialEvolution
    from dashpot_optimizers.least_squares import LeastSquares
    from dashpot_optimizers.multistart import Multistart
    from dashpot_optimizers.nevergrad import Nevergrad
    from dashpot_optimizers.optuna import Optuna
    from dashpot_optimizers.pso import ParticleSwarm

    own = [ParticleSwarm, LeastSquares, DifferentialEvolution, CovarianceMatrixAdaptation, Multistart]
    return [*own, Nevergrad, Optuna]

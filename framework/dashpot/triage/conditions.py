"""By how much the conditions of a test change the force of a specimen, as runs that agree show it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from dashpot.data.run import Run


def change_by_conditions(runs: Sequence[Run]) -> float:
    """The logarithm of the largest over the least ratio of force to motion, deviations from the mean, of moving runs.

    Ratios are taken to deflection and to velocity, stiffness and damping; those count that are more alike.
    """
    force = [float(np.std(run.force)) for run in runs]
    deflection = [float(np.std(run.displacement)) for run in runs]
    velocity = [float(np.std(np.gradient(run.displacement, run.sample_time))) for run in runs]
    return min(_spread(force, deflection), _spread(force, velocity))


def _spread(forces: Sequence[float], motions: Sequence[float]) -> float:
    ratios = [force / motion for force, motion in zip(forces, motions, strict=True) if force > 0.0 and motion > 0.0]
    return math.log(max(ratios) / min(ratios)) if ratios else 0.0

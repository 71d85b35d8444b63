"""By how much the conditions of a test change the force of a specimen, as runs that agree show it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.data.run import Run

Array = NDArray[np.float64]

FRICTION = 2  # its row among the ratios; those before it are to a motion
_TINY = 1e-300


def change_by_conditions(runs: Sequence[Run]) -> float:
    """The logarithm of the largest over the least ratio of force to motion, deviations from the mean, of moving runs.

    Ratios are taken to deflection and to velocity, stiffness and damping; those count that are more alike.
    """
    return float(np.min(np.ptp(ratios(runs)[:FRICTION], axis=1)))


def ratios(runs: Sequence[Run]) -> Array:
    """The logarithms (3, runs) of force over deflection, force over velocity, and force, deviations from the mean.

    They are what is alike in a spring, in a dashpot, and in a slider.
    """
    force = np.array([np.std(run.force) for run in runs])
    deflection = np.array([np.std(run.displacement) for run in runs])
    velocity = np.array([np.std(np.gradient(run.displacement, run.sample_time)) for run in runs])
    force, deflection, velocity = np.log(np.maximum([force, deflection, velocity], _TINY))
    return np.array([force - deflection, force - velocity, force])

"""The contact force of a wheel on a platform that shakes it, slower and slower."""

from __future__ import annotations

import numpy as np

from dashpot.data.run import Run

HIGHEST, LOWEST = 18.0, 6.0  # Hz; a test goes down at least from the one to the other
LEAST_REST = 0.2  # s
STILL = 0.02  # of the amplitude


def is_inspection(run: Run) -> bool:
    """Whether a run is a falling sweep under a wheel that stands on its platform."""
    start, stop = run.settings.get("start", 0.0), run.settings.get("stop", np.inf)
    return bool(run.kind == "sweep" and start >= HIGHEST and stop <= LOWEST and static_force(run) > 0.0)


def static_force(run: Run) -> float:
    """The mean force (N) while the platform rests at the beginning; that of the whole run where it does not."""
    away = np.abs(run.displacement - run.displacement[0])
    moving = int(np.argmax(away > STILL * 0.5 * np.ptp(run.displacement)))
    rest = moving if moving * run.sample_time >= LEAST_REST else run.force.size
    return float(np.mean(run.force[:rest]))

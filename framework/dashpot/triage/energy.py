"""Which runs give work back over closed cycles beyond doubt, which no passive specimen does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from dashpot.data.run import Run
from dashpot.triage.scatter import moderated
from dashpot.triage.work import CycleWork, work_of_cycles

# of datasets without a fault, one in so many may have a run accused by chance
ONE_IN = 1000


def runs_that_give_back(runs: Sequence[Run]) -> frozenset[str]:
    """The names of the runs, each with force and displacement, that give work back beyond doubt."""
    return giving_back(runs, works_of(runs))


def works_of(runs: Sequence[Run]) -> dict[str, CycleWork]:
    """The work over closed cycles of each run that has them, by its name."""
    return {run.name: work for run in runs if (work := work_of_cycles(run)) is not None}


def giving_back(runs: Sequence[Run], works: Mapping[str, CycleWork]) -> frozenset[str]:
    """The names of the runs whose mean work is below what an elastic specimen may seem to give back.

    Judged by the scatter of half cycles as a share of what each run moves (Student's t), so that of 1000 datasets one
    has a passive run accused. What the others say of the scatter counts as well: a run of a single cycle is judged by
    them alone.
    """
    from scipy.special import stdtr

    judged = [run for run in runs if run.name in works]
    seen = [works[run.name] for run in judged]
    variances, freedoms = moderated(
        np.array([work.variance / work.moved**2 for work in seen]), np.array([float(work.freedom) for work in seen])
    )
    found = []
    for run, work, variance, freedom in zip(judged, seen, variances, freedoms, strict=True):
        below = (work.mean + work.explicable(delay_of(run))) / work.moved
        if not (below < 0.0 and freedom > 0.0):
            continue
        scatter = float(np.sqrt(variance * work.share))
        if scatter == 0.0 or stdtr(freedom, below / scatter) < 1.0 / (ONE_IN * len(judged)):
            found.append(run.name)
    return frozenset(found)


def turned(run: Run) -> Run:
    """A run with its force turned round."""
    return replace(run, channels={**run.channels, "force": -run.force})


def delay_of(run: Run) -> float:
    """By how much the channels of a run may be apart in s: a sample, and what the data sheets of the sensors admit."""
    stated = (run.sensors.get(channel, {}).get("delay", 0.0) for channel in ("force", "displacement"))
    return run.sample_time + sum(stated)

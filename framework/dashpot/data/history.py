"""What a specimen has gone through before a run: the runs of a dataset stand in the order in which they were made."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from dashpot.data.run import Run

# settings that every run of a dataset with one displacement has: the largest deflection before it in m, and the
# integral of the squared velocity over the last run before it in m^2/s
REACHED, MOVED = "reached", "moved"
NOTHING = {REACHED: 0.0, MOVED: 0.0}


def with_history(made: Iterable[tuple[Run, bool]]) -> Iterator[Run]:
    """The runs that count, of (run, whether it counts), knowing how far and how fast the specimen was moved before.

    What a run itself states as the setting ``reached`` counts from there on.
    """
    reached = moved = 0.0
    for run, counts in made:
        reached = max(reached, run.settings.get(REACHED, 0.0))
        if counts:
            yield replace(run, history={REACHED: reached, MOVED: moved})
        if "displacement" in run.channels:
            reached = max(reached, float(np.max(np.abs(run.displacement))))
            moved = float(np.sum(np.gradient(run.displacement) ** 2)) / run.sample_time

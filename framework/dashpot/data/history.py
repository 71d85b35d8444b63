"""What a specimen has gone through before a run: the runs of a dataset stand in the order in which they were made."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from dashpot.data.run import Run

# the setting that every run of a dataset with one displacement has: the largest deflection before it, in m
REACHED = "reached"


def with_history(made: Iterable[tuple[Run, bool]]) -> Iterator[Run]:
    """The runs that count, of (run, whether it counts), knowing how far the specimen was deflected in all before them.

    What a run itself states as the setting ``reached`` counts from there on.
    """
    reached = 0.0
    for run, counts in made:
        reached = max(reached, run.settings.get(REACHED, 0.0))
        if counts:
            yield replace(run, reached=reached)
        if "displacement" in run.channels:
            reached = max(reached, float(np.max(np.abs(run.displacement))))

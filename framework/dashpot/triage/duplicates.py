"""The same record under two names."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from dashpot.data.repeats import is_same_to_the_last_digit
from dashpot.data.run import Run
from dashpot.data.white_noise import white_noise
from dashpot.triage.fault import Fault

NOISELESS = 1e-7  # of the deviation: a computed force, which repeats itself exactly


def duplicate_runs(runs: Sequence[Run]) -> list[Fault]:
    """Runs whose motion and force are those of an earlier one to the last digit; computed ones without noise may be.

    A force alone may come back to the last digit where a test prescribes it, which ``one_test`` tells, and so may the
    forces of one record on a symmetric specimen.
    """
    found: dict[str, Fault] = {}
    for first, second in combinations(runs, 2):
        if first.record == second.record or first.name in found or second.name in found:
            continue
        if _is_measured(first) and _same(first, second):
            found[second.name] = Fault(
                second.name,
                "duplicate",
                f"it is run '{first.name}' to the last digit",
                "A copy is no repeat: measure again, or remove it",
            )
    return list(found.values())


def _same(first: Run, second: Run) -> bool:
    pairs = (first.force, second.force), (first.displacement, second.displacement)
    return all(is_same_to_the_last_digit(*pair) for pair in pairs)


def _is_measured(run: Run) -> bool:
    """Whether there is noise on the force, which no second measurement repeats."""
    return white_noise(run.force) >= NOISELESS * float(np.std(run.force)) > 0.0

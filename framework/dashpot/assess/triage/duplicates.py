"""The same record under two names."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from dashpot.assess.triage.fault import Fault
from dashpot.data.run import Run
from dashpot.data.white_noise import white_noise

ROUNDING = 1e-9
NOISELESS = 1e-7  # of the deviation: a computed force, which repeats itself exactly


def duplicate_runs(runs: Sequence[Run]) -> list[Fault]:
    """Runs whose force is that of an earlier one to the last digit; computed forces without noise may be that.

    The forces of one record may be, on a symmetric specimen.
    """
    found: dict[str, Fault] = {}
    for first, second in combinations(runs, 2):
        if first.record == second.record or first.name in found or second.name in found:
            continue
        if _same(first, second):
            found[second.name] = Fault(
                second.name, "duplicate", f"its force is that of run '{first.name}' to the last digit",
                "A copy is no repeat: measure again, or remove it",
            )  # fmt: skip
    return list(found.values())


def _same(first: Run, second: Run) -> bool:
    one, other = first.force, second.force
    if one.size != other.size or not np.allclose(one[:64], other[:64], rtol=ROUNDING, atol=0.0):
        return False
    deviation = float(np.std(one))
    if deviation == 0.0 or white_noise(one) < NOISELESS * deviation:
        return False
    return bool(np.max(np.abs(one - other)) <= ROUNDING * deviation)

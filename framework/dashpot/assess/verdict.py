"""What is said in the end."""

from __future__ import annotations

from collections.abc import Sequence

from dashpot.assess.leftover import Leftover
from dashpot.assess.pursuit import Pursuit
from dashpot.assess.triage.fault import Fault


def give_verdict(faults: Sequence[Fault], pursuit: Pursuit, leftover: Leftover) -> str:
    """One of the verdict words of the result file.

    ``bad_data`` where triage found faults of the measurement; ``ambiguous`` when an accepted cause has a rival that
    fits alike; ``partly_explained`` and ``unexplained`` when structure is left that no suspect explains.
    """
    if faults:
        return "bad_data"
    if any(entry.rivals for entry in pursuit.accepted):
        return "ambiguous"
    if pursuit.accepted:
        return "partly_explained" if leftover.notable(pursuit.explained) else "explained"
    return "unexplained" if leftover.notable() else "nothing_missing"

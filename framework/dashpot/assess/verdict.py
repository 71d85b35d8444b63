"""What is said in the end."""

from __future__ import annotations

from collections.abc import Sequence

from dashpot.assess.accepted import Accepted
from dashpot.assess.leftover import Leftover
from dashpot.assess.pursuit import Pursuit, needed_twice
from dashpot.assess.triage.fault import Fault


def give_verdict(faults: Sequence[Fault], pursuit: Pursuit, leftover: Leftover) -> str:
    """One of the verdict words of the result file.

    ``bad_data`` where triage found faults of the measurement; ``ambiguous`` when an accepted cause has a rival that
    fits alike; ``partly_explained`` and ``unexplained`` when structure is left that no suspect explains, the former
    also where a cause in the specimen was needed twice: its law is hardly the one that is hidden, and where the search
    was cut short.
    """
    if faults:
        return "bad_data"
    if any(entry.rivals for entry in pursuit.accepted):
        return "ambiguous"
    if pursuit.accepted:
        incomplete = leftover.notable(pursuit.explained) or stands_in(pursuit.accepted) or pursuit.cut_short
        return "partly_explained" if incomplete else "explained"
    return "unexplained" if leftover.notable() else "nothing_missing"


def stands_in(accepted: Sequence[Accepted]) -> set[tuple[str, str]]:
    """The names of causes in the specimen that were needed twice, and so may stand in for one that nothing knows."""
    return needed_twice([entry for entry in accepted if entry.finding.candidate.cause.kind == "specimen"])

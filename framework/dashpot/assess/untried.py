"""Causes that no plugin provides: what is confused with them cannot be told from them, as they were not tried."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from dashpot.assess.accepted import Accepted
from dashpot.assess.pursuit import Pursuit
from dashpot.contract.cause import Cause


def with_untried(pursuit: Pursuit, causes: Mapping[str, type[Cause]]) -> Pursuit:
    """The pursuit, where what an accepted cause is confused with and no plugin provides is its rival."""
    accepted = [replace(entry, rivals=(*entry.rivals, *untried(entry, causes))) for entry in pursuit.accepted]
    return replace(pursuit, accepted=tuple(accepted))


def remarks_on_untried(pursuit: Pursuit, causes: Mapping[str, type[Cause]]) -> list[str]:
    """What to say of the causes that could not be tried."""
    remarks = (
        f"No plugin provides the cause '{word}', with which '{entry.finding.candidate.cause.word}' is confused: "
        f"it was not tried, and is not ruled out."
        for entry in pursuit.accepted for word in untried(entry, causes)
    )  # fmt: skip
    return list(dict.fromkeys(remarks))


def untried(entry: Accepted, causes: Mapping[str, type[Cause]]) -> list[str]:
    """The words of what a cause is confused with that are missing among the causes."""
    return [word for word in entry.finding.candidate.cause.confused_with if word not in causes]

"""The arrays and texts that a report shows as evidence."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from typing import Any

import dashpot
from dashpot.assess.accepted import Rejection
from dashpot.assess.limits import Limit, find_limits
from dashpot.assess.misfits import residuals_of
from dashpot.assess.pursuit import Pursuit
from dashpot.assess.signals import signal_evidence
from dashpot.contract.cause import Cause
from dashpot.fit.api import Setting
from dashpot.fit.floor import false_repeats
from dashpot.fit.result import FitResult

NOT_TO_BE_SEEN = {
    "quantity": "would not show beside the numbers of the model",
    "value": None,
    "unit": None,
    "force": None,
    "left": None,
}


def gather_evidence(
    setting: Setting,
    fit: FitResult,
    pursuit: Pursuit,
    causes: Mapping[str, type[Cause]],
    patch: Mapping[str, str],
    triage: Sequence[str],
) -> dict[str, Any]:
    """The evidence of a diagnosis: see ``report.evidence.Evidence``."""
    residuals = {"before": residuals_of(pursuit.ladder[0], setting.scored)}
    if pursuit.accepted:
        residuals["after"] = residuals_of(pursuit.ladder[-1], setting.scored)
    return {
        **signal_evidence(setting.dataset.runs, residuals),
        "patch": patch,
        "rejected": [_rejected(causes, rejection) for rejection in pursuit.rejected],
        "tried": pursuit.tried,
        "limits": detection_limits(pursuit),
        "warnings": [*triage, *warnings_of(setting, [fit])]
        + [f"The cause '{word}' could not be tried: {reason}" for word, reason in pursuit.last.unavailable],
        "history": {fit.declared.name: history_of(fit)},
        "provenance": provenance_of(setting, fit.seed),
    }


def provenance_of(setting: Setting, seed: int) -> dict[str, Any]:
    """Versions, seed and digests: the colophon of a report."""
    return {
        "dashpot": dashpot.__version__,
        **{library: version(library) for library in ("numpy", "scipy")},
        "Python": platform.python_version(),
        "seed": seed,
        "data": setting.dataset.digest,
        "held out": ", ".join(setting.split.held_out) or setting.split.reason,
    }


def history_of(fit: FitResult) -> dict[str, list[float]]:
    """How a fit went: parameter vectors spent and the best error so far."""
    return {"evaluations": [float(count) for count, _ in fit.history], "best": [loss for _, loss in fit.history]}


def detection_limits(pursuit: Pursuit) -> list[dict[str, Any]]:
    """The smallest strength of each cause that would have been found with 95 % power, and is of practical relevance.

    ``value`` in its own ``unit`` and ``force``, the RMS in N that it makes, are told where the cause shows best.
    Wherever a refit of the model leaves an RMS of ``left`` of it, all runs weighing the same, it would have been found.
    All three are None where these runs would not show the largest effect there can be.
    """
    last = pursuit.last
    return [
        {**candidate.told(), **(_told(limit) if limit else NOT_TO_BE_SEEN)}
        for candidate, limit in find_limits(last.columns, last.screen, pursuit.least_force)
    ]


def _told(limit: Limit) -> dict[str, Any]:
    suspect = limit.candidate.suspect
    return {
        "quantity": " as ".join(dict.fromkeys([suspect.quantity, suspect.form])),
        "value": limit.size if suspect.unit else limit.force,
        "unit": suspect.unit or "N",
        "force": limit.force,
        "left": limit.hardest,
    }


def telling_measurement(cause: type[Cause], rival: str, causes: Mapping[str, type[Cause]]) -> str:
    """The measurement that tells a cause from a rival, by its word, or an empty text when neither of them says."""
    other = causes[rival].confused_with if rival in causes else {}
    return cause.confused_with.get(rival) or other.get(cause.word, "")


def _rejected(causes: Mapping[str, type[Cause]], rejection: Rejection) -> dict[str, Any]:
    return {
        "cause": rejection.cause,
        "title": f"{causes[rejection.cause].about} ({rejection.form})",
        "place": rejection.place,
        "reason": rejection.reason,
        "expected_gain": rejection.expected_gain,
        "gain": rejection.gain,
    }


def warnings_of(setting: Setting, fits: Sequence[FitResult]) -> list[str]:
    """What a reader must know of the data and of the fits before believing the numbers."""
    found = [str(problem) for problem in setting.dataset.problems]
    found += false_repeats(setting.dataset)
    if setting.split.reason:
        found.append(f"No errors on unseen runs: {setting.split.reason}.")
    if setting.floor.source != "repeats":
        found.append("No repeated runs: the noise floor is estimated from the record itself.")
    return found + [_at_bound(fit) for fit in fits if fit.at_bound]


def _at_bound(fit: FitResult) -> str:
    where = "is at the end of its range" if len(fit.at_bound) == 1 else "are at the ends of their ranges"
    names = ", ".join(fit.at_bound)
    return f"{fit.declared.name}: {names} {where}: without influence on these data, or held by the bounds of the file."

"""Where the numbers of a report come from, and what a reader must know before believing them."""

from __future__ import annotations

import platform
from collections.abc import Iterator, Sequence
from importlib.metadata import version
from typing import Any

import dashpot
from dashpot.fit.api import Setting
from dashpot.fit.floor import false_repeats
from dashpot.fit.result import FitResult


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


def warnings_of(setting: Setting, fits: Sequence[FitResult]) -> list[str]:
    """What a reader must know of the data and of the fits before believing the numbers."""
    found = [str(problem) for problem in setting.dataset.problems]
    found += false_repeats(setting.dataset)
    if setting.split.reason:
        found.append(f"No errors on unseen runs: {setting.split.reason}.")
    if setting.floor.source != "repeats":
        found.append("No repeated runs among those that are fitted: the noise floor comes from the records themselves.")
    found += [_at_bound(fit) for fit in fits if fit.at_bound]
    return found + [told for fit in fits for told in _not_told(fit)]


def _not_told(fit: FitResult) -> Iterator[str]:
    known = fit.identifiability or {}
    for sentence in (*known.get("weak", ()), *known.get("may_go", ())):
        yield f"{fit.declared.name}: {sentence}."


def _at_bound(fit: FitResult) -> str:
    where = "is at the end of its range" if len(fit.at_bound) == 1 else "are at the ends of their ranges"
    names = ", ".join(fit.at_bound)
    return f"{fit.declared.name}: {names} {where}: without influence on these data, or held by the bounds of the file."

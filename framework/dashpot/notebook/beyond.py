"""Warnings of motions that a model was not identified with."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

from dashpot.data.excitation import Excitation
from dashpot.data.run import Run
from dashpot.fit.seen_range import beyond_range, warning_of_range
from dashpot.model.network import NetworkSpec

SHOWN = 3  # runs that are named


def warn_of_range(spec: NetworkSpec, runs: Mapping[str, Run | Excitation]) -> None:
    """One UserWarning, at the line that called a verb, for the runs beyond the range of identification; or none."""
    found = {name: beyond_range(spec, run) for name, run in runs.items()}
    told = [warning_of_range(name, words) for name, words in found.items() if words]
    if told:
        more = [f"... and {len(told) - SHOWN} more runs"] if len(told) > SHOWN else []
        warnings.warn("\n".join([*told[:SHOWN], *more]), UserWarning, stacklevel=3)

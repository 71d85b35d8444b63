"""Faults of runs in the words of a headline: each kind once, with the names of its runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from dashpot.report.readable import join

Json = Mapping[str, Any]

MOST_RUNS = 3  # that are told by name


def told_faults(faults: Sequence[Json]) -> list[tuple[str, str]]:
    """For each kind of fault the runs and the evidence; of several runs with evidence of their own that of the first.

    Each fault has ``run``, ``kind`` and ``evidence``.
    """
    kinds: dict[str, list[Json]] = {}
    for fault in faults:
        kinds.setdefault(fault["kind"], []).append(fault)
    return [_told(alike) for alike in kinds.values()]


def _told(alike: Sequence[Json]) -> tuple[str, str]:
    evidence = alike[0]["evidence"]
    same = [fault["run"] for fault in alike if fault["evidence"] == evidence]
    others = [fault["run"] for fault in alike if fault["evidence"] != evidence]
    return _named(same) + (f", likewise {_named(others)}" if others else ""), evidence


def _named(runs: Sequence[str]) -> str:
    if len(runs) > MOST_RUNS:
        return f"{len(runs)} runs"
    names = [f"'{run}'" for run in runs]
    return f"run{'s' * (len(runs) > 1)} {join(names)}"

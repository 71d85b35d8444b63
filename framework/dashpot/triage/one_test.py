"""Runs that are one test, though the dataset does not say that they repeat each other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from dashpot.data.repeats import is_same_to_the_last_digit
from dashpot.data.run import Run
from dashpot.data.white_noise import white_noise

# of the variance of what two sensors differ by: more than half is white
WHITE = 0.5
_SHOWN = 6


def joined(runs: Sequence[Run]) -> tuple[list[Run], list[str]]:
    """The runs, with those that are one test as repeats of the first of them, and a remark where there are any.

    Their forces are equal to the last digit, as a test prescribes them or as in a record to which noise was added, and
    their displacements differ by noise alone: neither predicts the other one. Where one of them is declared as held out
    and the other one is not, the dataset decides, and the remark says so.
    """
    left, told, apart = list(runs), list[str](), list[str]()
    ends: dict[str, list[Run]] = {}
    for run in runs:
        ends.setdefault(run.record, []).append(run)
    for first, second in combinations(ends, 2):
        now = {run.name: run for run in left}
        ones, others = ([now[run.name] for run in ends[record]] for record in (first, second))
        if ones[0].cluster == others[0].cluster or not _one_test(ones, others):
            continue
        pair = f"'{second}' with '{first}'"
        if bool(ones[0].held_out) != bool(others[0].held_out):
            apart.append(pair)
            continue
        told.append(pair)
        moved = {other.group: one.group for one, other in zip(ones, others, strict=True)}
        left = [
            replace(run, group=moved[run.group], repeats=moved[run.group]) if run.group in moved else run
            for run in left
        ]
    return left, [*_remark(told, _TOGETHER), *_remark(apart, _APART)]


_TOGETHER = "they stay together as repeats; declare 'repeats', or remove a copy"
_APART = "one of them is held out, and tells nothing that the other one does not; hold out both, or remove a copy"


def _remark(pairs: Sequence[str], what: str) -> list[str]:
    if not pairs:
        return []
    more = f" and {len(pairs) - _SHOWN} more" if len(pairs) > _SHOWN else ""
    return [
        f"Runs are one test, with the same force to the last digit and deflections that differ by noise alone: "
        f"{', '.join(pairs[:_SHOWN])}{more}; {what}"
    ]


def _one_test(ones: Sequence[Run], others: Sequence[Run]) -> bool:
    """Whether all forces of two records are the same, and all their motions but for noise."""
    by_end: Mapping[str, Run] = {run.end: run for run in others}
    return len(ones) == len(others) and all(one.end in by_end and _same(one, by_end[one.end]) for one in ones)


def _same(one: Run, other: Run) -> bool:
    if {"triage"} & {*one.accept, *other.accept} or not is_same_to_the_last_digit(one.force, other.force):
        return False
    difference = one.displacement - other.displacement
    variance = float(np.var(difference))
    # what is as large as the motion itself is another motion, however rough
    within = 0.0 < variance < WHITE * float(np.var(one.displacement))
    return within and float(np.std(one.force)) > 0.0 and white_noise(difference) ** 2 > WHITE * variance

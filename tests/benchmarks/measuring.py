"""Timing side by side: one round of each contestant after the other, medians of the rounds."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any


@dataclass(frozen=True)
class Contestant:
    """Work to be timed; ``units`` is how much of it there is."""

    name: str
    work: Callable[[], Any]
    units: float = 1.0


@dataclass(frozen=True)
class Timing:
    """Median nanoseconds per unit, by this thread's processor time and by the clock; ``spread`` is (max-min)/median."""

    cpu: float
    clock: float
    spread: float


def time_together(contestants: Sequence[Contestant], rounds: int) -> dict[str, Timing]:
    """The timings by name. A first round, in which things are compiled and caches fill, does not count."""
    spent: dict[str, list[tuple[float, float]]] = {contestant.name: [] for contestant in contestants}
    for number in range(rounds + 1):
        for contestant in contestants:
            gc.collect()
            cpu, clock = time.thread_time(), time.perf_counter()
            contestant.work()
            found = time.thread_time() - cpu, time.perf_counter() - clock
            if number:
                spent[contestant.name].append(found)
    return {contestant.name: _summary(spent[contestant.name], contestant.units) for contestant in contestants}


def _summary(spent: Sequence[tuple[float, float]], units: float) -> Timing:
    cpu, clock = ([1e9 * value / units for value in column] for column in zip(*spent, strict=True))
    return Timing(median(cpu), median(clock), (max(cpu) - min(cpu)) / max(median(cpu), 1e-12))

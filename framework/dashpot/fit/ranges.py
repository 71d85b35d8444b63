"""Where to search a parameter whose file gives no bounds: over what these data can feel.

A force, a length and a speed taken from each run give every unit its natural size there; a parameter is searched from
far below the smallest to well above the largest of them. So one file serves a tyre of newtons and a bearing of
meganewtons, and a slider that a run of a millimetre sees is in reach beside runs of a hand's breadth.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from dashpot.data.excitation import Excitation, mean_of
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.following import keys_of
from dashpot.model.network import NetworkSpec, Value
from dashpot.text.quantity import dimensions

BELOW, ABOVE = 1e-4, 30.0
USUALLY_LATEST = 0.1  # s: amplifiers and filters of test rigs are faster
LATEST = 4.0  # times that in which a motion goes its half span at its speed: nine tenths of the period of a sine
MOST_OVER_SETTINGS = 10.0  # times its own size a number may change over the settings


@dataclass(frozen=True)
class Size:
    """Natural sizes in one run: half spans of force (N) and displacement (m), speed (m/s, RMS)."""

    force: float
    length: float
    speed: float


@dataclass(frozen=True)
class Sizes:
    """The sizes of all runs, shortest and longest time (s) of the dataset, and how far its settings are apart."""

    runs: tuple[Size, ...]
    shortest: float
    longest: float
    spreads: Mapping[str, float] = field(default_factory=dict)

    @property
    def latest(self) -> float:
        """How late a channel may be in s: less than a period of the fastest sine, after which its phase comes round."""
        fastest = min((run.length / run.speed for run in self.runs), default=0.0)
        return max(USUALLY_LATEST, LATEST * fastest)

    def of_unit(self, unit: str) -> tuple[float, float] | None:
        """The smallest and the largest natural size of this unit; None for a pure number, or where nothing moves."""
        force, length, time = dimensions(unit)
        if (force, length, time) == (0.0, 0.0, 0.0) or not self.runs:
            return None
        if (force, length) == (0.0, 0.0):
            sizes = [self.shortest**time, self.longest**time]
        else:
            sizes = [run.force**force * run.length**length * (run.length / run.speed) ** time for run in self.runs]
        return min(sizes), max(sizes)

    def range_of(self, unit: str) -> tuple[float, float] | None:
        """Where to search a quantity of this unit; None where it has no natural size."""
        found = self.of_unit(unit)
        if found is None or dimensions(unit)[:2] == (0.0, 0.0):
            return found
        return BELOW * found[0], ABOVE * found[1]


def natural_sizes(runs: Sequence[ScoredRun]) -> Sizes:
    """The sizes of the dynamic runs, of all runs where none is dynamic."""
    dynamic = [run for run in runs if run.kind not in ("quasi_static", "hold")] or list(runs)
    return Sizes(
        runs=tuple(size for size in map(_size_of, dynamic) if size.force > 0.0 and size.speed > 0.0),
        shortest=0.5 * min(run.drive.dt for run in dynamic),
        longest=max(run.drive.dt * run.drive.samples for run in runs),
        spreads=_spreads([run.excitation for run in runs]),
    )


def _spreads(runs: Sequence[Excitation]) -> dict[str, float]:
    # where all runs have the same setting nothing can be told from it, and its size has to do
    found: dict[str, list[float]] = {}
    for run in runs:
        # a channel goes as far as it moves within runs
        ends = {mean_of(name): [float(np.min(each)), float(np.max(each))] for name, each in run.channels.items()}
        for key, value in run.settings.items():
            found.setdefault(key, []).extend(ends.get(key, [value]))
    return {key: float(np.ptp(values) or np.max(np.abs(values)) or 1.0) for key, values in found.items()}


def _size_of(run: ScoredRun) -> Size:
    return Size(
        force=0.5 * float(np.ptp(run.force)),
        length=0.5 * float(np.ptp(run.drive.displacement)),
        speed=float(np.sqrt(np.mean(run.drive.velocity**2))),
    )


def with_ranges(spec: NetworkSpec, sizes: Sizes) -> NetworkSpec:
    """The network with bounds for every searched value that has none; a start outside them moves to the next one."""
    return spec.with_values(
        {
            slot.path: _over_settings(slot.value, slot.of, sizes) if slot.of else _ranged(slot.value, sizes)
            for slot in spec.slots()
            if slot.value.searched
        }
    )


def _over_settings(value: Value, of: Value, sizes: Sizes) -> Value:
    """A slope, a rate or a factor of the number ``of``: what makes it another one over the settings of these runs."""
    assert of.over is not None
    if value.bounds is not None or of.over.way == "factor":
        return _ranged(value, sizes)
    if of.over.way not in ("slope", "rate"):
        return replace(value, bounds=value.sensible)
    spread = next((sizes.spreads[key] for key in keys_of(of.over) if key in sizes.spreads), 1.0)
    natural = sizes.of_unit(of.unit)
    size = max(abs(of.number), natural[1] if natural else 0.0) if of.over.way == "slope" else 1.0
    span = MOST_OVER_SETTINGS * max(abs(value.number), (size or 1.0) / spread)
    return replace(value, bounds=(value.number - span, value.number + span))


def _ranged(value: Value, sizes: Sizes) -> Value:
    if value.bounds is not None:
        return value
    low, high = _around(value, sizes) if value.scale == "linear" else _decades(value, sizes)
    return replace(value, bounds=(low, high), number=float(np.clip(value.number, low, high)))


def _around(value: Value, sizes: Sizes) -> tuple[float, float]:
    low, high = value.sensible
    found = sizes.of_unit(value.unit)
    if found is None and np.isfinite(value.sensible).all():
        return low, high
    if value.unit == "s":  # how late a channel is
        span = 10.0 * abs(value.number) + sizes.latest
    else:
        span = 10.0 * max(abs(value.number), found[1] if found else 1.0)
    return max(low, value.number - span), min(high, value.number + span)


def _decades(value: Value, sizes: Sizes) -> tuple[float, float]:
    low, high = value.sensible
    reach = sizes.range_of(value.unit)
    if reach:
        low, high = max(low, reach[0]), min(high, reach[1])
    return (low, high) if 0.0 < low < high < np.inf else (value.number / 300.0, value.number * 300.0)

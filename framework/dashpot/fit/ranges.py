"""Where to search a parameter whose file gives no bounds: over what these data can feel.

A force, a length and a time taken from the runs give every unit its natural size; a parameter is searched from far
below to well above it. So one file serves a tyre of newtons and a bearing of meganewtons.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from dashpot.fit.scored import ScoredRun
from dashpot.model.network import NetworkSpec, Slot, Value
from dashpot.text.quantity import dimensions

BELOW, ABOVE = 1e-4, 30.0


@dataclass(frozen=True)
class Sizes:
    """Natural sizes of a dataset: half spans of force (N) and displacement (m), shortest and longest time (s)."""

    force: float
    length: float
    shortest: float
    longest: float
    speed: float

    def of_unit(self, unit: str) -> tuple[float, float] | None:
        """The range in which a quantity of this unit matters; None for a pure number."""
        force, length, time = dimensions(unit)
        if (force, length, time) == (0.0, 0.0, 0.0):
            return None
        if (force, length) == (0.0, 0.0):
            ends = self.shortest**time, self.longest**time
            return min(ends), max(ends)
        size = self.force**force * self.length**length * (self.length / self.speed) ** time
        return BELOW * size, ABOVE * size


def natural_sizes(runs: Sequence[ScoredRun]) -> Sizes:
    """The sizes of the dynamic runs, of all runs where none is dynamic."""
    dynamic = [run for run in runs if run.kind not in ("quasi_static", "hold")] or list(runs)
    return Sizes(
        force=0.5 * max(float(np.ptp(run.force)) for run in dynamic),
        length=0.5 * max(float(np.ptp(run.drive.displacement)) for run in dynamic),
        shortest=0.5 * min(run.drive.dt for run in dynamic),
        longest=max(run.drive.dt * run.drive.samples for run in runs),
        speed=max(float(np.sqrt(np.mean(run.drive.velocity**2))) for run in dynamic),
    )


def with_ranges(spec: NetworkSpec, sizes: Sizes) -> NetworkSpec:
    """The network with bounds for every searched value that has none; a start outside them moves to the next one."""
    return spec.with_values({slot.path: _ranged(slot, sizes, spec) for slot in spec.slots() if slot.value.searched})


def _ranged(slot: Slot, sizes: Sizes, spec: NetworkSpec) -> Value:
    value = slot.value
    if value.bounds is not None:
        return value
    low, high = _sensible(slot.path, spec)
    found = sizes.of_unit(value.unit)
    if value.scale == "linear":
        span = 10.0 * max(abs(value.number), found[1] / ABOVE if found else 0.0)
        low, high = max(low, value.number - span), min(high, value.number + span)
    elif found:
        low, high = max(low, found[0]), min(high, found[1])
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        low, high = value.number / 300.0, value.number * 300.0
    return replace(value, bounds=(low, high), number=float(np.clip(value.number, low, high)))


def _sensible(path: str, spec: NetworkSpec) -> tuple[float, float]:
    name, _, key = path.partition("[")[0].rpartition(".")
    for branch in spec.leaves():
        if branch.name == name and key in branch.element.declares.parameters:
            return branch.element.declares.parameters[key].bounds
        if branch.name == name and key in branch.curves and branch.curves[key].form == "constant":
            return branch.curves[key].curve.bounds
    return -np.inf, np.inf

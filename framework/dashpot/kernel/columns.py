"""The drive of a run as the kernel wants it: one row per sample and one per turning point."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.expr.interpret import interpret
from dashpot.expr.node import symbols_of
from dashpot.kernel.compiler.events import after_the_one_before, follow
from dashpot.kernel.curves import segment_of
from dashpot.kernel.following import Seen, at_samples
from dashpot.kernel.ir.program import Program
from dashpot.model.network import Characteristic

Array = NDArray[np.float64]
Constants = tuple[float, tuple[tuple[str, float], ...]]
NEVER = -1  # where the kernel need not look for a turning point any more
REST = ("velocity_old", "velocity_new", "acceleration")


@dataclass(frozen=True)
class Rows:
    """Arrays of a run for the kernel; see ``source.print_source`` for their shapes."""

    drive: Drive
    columns: Array
    index: NDArray[np.int64]
    local: Array
    turn_at: NDArray[np.int64]
    turn_columns: Array
    settings: Mapping[str, float] = field(default_factory=dict)

    @cached_property
    def constants(self) -> Constants:
        """The step in s, and the settings in the order of their names: what runs may have in common."""
        return self.drive.dt, tuple(sorted(self.settings.items()))

    @cached_property
    def nbytes(self) -> int:
        """The bytes of all columns, those of the drive not among them."""
        return self.columns.nbytes + self.index.nbytes + self.local.nbytes + self.turn_columns.nbytes


def prepare_rows(
    program: Program, curves: Mapping[str, Characteristic], drive: Drive, settings: Mapping[str, float], channels: Seen
) -> Rows:
    """Everything of a network that depends on the drive and on ``channels`` (n,) alone.

    At the first sample no branch has a memory yet. A turning point has the channels at the end of its step.
    """
    seen = at_samples(channels)
    samples = see_samples(drive) | seen
    turns = see_turns(drive) | {name: signal[drive.turn_step] for name, signal in seen.items()}
    before_samples, before_turns = follow(program.followers, drive, samples, turns)
    columns = _evaluate(program, {**samples, **before_samples}, drive.samples)
    turn_columns = _evaluate(program, {**turns, **before_turns}, drive.turn_step.size)
    index = np.empty((drive.samples, len(program.lookups)), dtype=np.int64)
    local = np.empty((drive.samples, len(program.lookups)))
    bases = table_bases(program, curves)
    for number, look in enumerate(program.lookups):
        argument = np.broadcast_to(interpret([look.argument], samples)[0], (drive.samples,))
        segment, local[:, number] = segment_of(curves[look.curve], argument)
        index[:, number] = bases[look.curve] + segment
    return Rows(drive, columns, index, local, np.append(drive.turn_step, NEVER), turn_columns, settings)


def table_bases(program: Program, curves: Mapping[str, Characteristic]) -> dict[str, int]:
    """The first segment of each curve in the tables of a group."""
    bases, size = {}, 0
    for curve in dict.fromkeys(look.curve for look in program.lookups):
        bases[curve] = size
        size += len(curves[curve].at) + 1
    return bases


def see_samples(drive: Drive) -> dict[str, Array | float]:
    """The drive at every sample, as branches of each sight see it."""
    x, v, a = drive.displacement, drive.velocity, drive.acceleration
    before, v_before = np.concatenate([x[:1], x[:-1]]), np.concatenate([v[:1], v[:-1]])
    still = {"old": before, "new": x, "velocity_old": v_before, "velocity_new": v, "acceleration": a}
    # a branch with memory has not moved when the record begins
    path = dict(still, **{key: np.concatenate([[0.0], still[key][1:]]) for key in REST})
    since = before.copy()
    since[drive.turn_step] = drive.turn_displacement
    sights = {"still": still, "path": path, "monotone": {"old": since, "new": x}}
    return {"dt": drive.dt} | {f"{name}.{key}": value for name, sight in sights.items() for key, value in sight.items()}


def see_turns(drive: Drive) -> dict[str, Array | float]:
    """The drive at its turning points; only rate-independent branches move there."""
    place, step = drive.turn_displacement, drive.turn_step
    old = after_the_one_before(step, drive.displacement, place)
    return {"dt": drive.dt, "monotone.old": old, "monotone.new": place}


def _evaluate(program: Program, values: Mapping[str, Array | float], count: int) -> Array:
    found = np.zeros((count, len(program.columns)))
    known = [(number, node) for number, node in enumerate(program.columns) if symbols_of(node) <= set(values)]
    for (number, _), column in zip(known, interpret([node for _, node in known], values), strict=True):
        found[:, number] = column
    return found

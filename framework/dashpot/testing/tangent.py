"""The derived tangent of a law is its slope."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.expr.derive import derive
from dashpot.expr.interpret import interpret
from dashpot.expr.node import Node
from dashpot.kernel.columns import see_samples
from dashpot.kernel.compiler.trace import TracedBranch, trace_branch
from dashpot.kernel.curves import TableLaw
from dashpot.kernel.eager import table_law
from dashpot.model.element import Element
from dashpot.testing.motion import random_drive
from dashpot.testing.specimen import Specimen, draw_sizes, draw_specimens
from dashpot.testing.verdict import Examination

Array = NDArray[np.float64]

STEPS = (1e-5, 3e-7, 1e-8)  # of the amplitude
TOLERANCE = 2e-4
ROUNDING = 1e-10
SAMPLES = 60
ADVICE = "The force must not jump with the position at the end of the step, and its derivative must be finite."

# the states (lanes,) before a step, and its motion
Step = tuple[Mapping[str, Array], Mapping[str, Any]]


def check_tangent(element: type[Element], seed: int | None = None) -> None:
    """The tangent lies between the slopes to the left and to the right, also where nothing moves."""
    examination = Examination.begin(element, "tangent", seed)
    rng = examination.rng()
    sizes = draw_sizes(rng)
    drive = random_drive(rng, "dwelling", sizes.length, sizes.time, SAMPLES)
    for specimen in draw_specimens(element, rng, sizes):
        law = _Law.of(specimen)
        for still in (False, True):
            for where in law.steps(drive, still):
                _compare(examination, law, where, sizes.length, specimen.form)


@dataclass(frozen=True, eq=False)
class _Law:
    """A traced law with its numbers and its tangent."""

    traced: TracedBranch
    tangent: Node
    known: Mapping[str, Array]
    tables: Mapping[str, TableLaw]
    lanes: int

    @classmethod
    def of(cls, specimen: Specimen) -> _Law:
        """The law of a specimen."""
        traced = trace_branch(specimen.branch)
        numbers = specimen.numbers
        tables = {path: table_law(path, curve, numbers) for path, curve in specimen.spec.curves().items() if curve.at}
        return cls(traced, derive(traced.force, f"{traced.sight}.new"), numbers, tables, specimen.values.shape[0])

    def steps(self, drive: Drive, still: bool) -> list[Step]:
        """Some steps of a drive; ``still`` steps go nowhere."""
        seen = see_samples(drive)
        found: list[Step] = []
        states: Mapping[str, Array] = dict.fromkeys(self.traced.states, np.zeros(self.lanes))
        for k in range(1, drive.samples):
            motion = {name: np.asarray(value)[k] if np.ndim(value) else value for name, value in seen.items()}
            found.append((states, self.halted(motion) if still else motion))
            answer = interpret(list(self.traced.states.values()), {**self.known, **states, **motion}, self.tables)
            states = dict(zip(self.traced.states, answer, strict=True))
        return found[::3]

    def halted(self, motion: Mapping[str, Any]) -> dict[str, Any]:
        """The motion stopped where it begins."""
        sight = self.traced.sight
        return {**motion, f"{sight}.new": motion[f"{sight}.old"]}

    def at(self, root: Node, step: Step, shift: float) -> Array:
        """The value (lanes,) of a root when a step ends elsewhere."""
        states, motion = step
        name = f"{self.traced.sight}.new"
        moved = {**self.known, **states, **motion, name: motion[name] + shift}
        return np.broadcast_to(interpret([root], moved, self.tables)[0], (self.lanes,))


def _compare(examination: Examination, law: _Law, where: Step, length: float, form: str) -> None:
    # a kink of the force, or a bend as short as the way to a turning point inside a step, may lie inside one of the
    # distances over which slopes are taken, hardly inside all of them
    for share in STEPS:
        step = share * length
        tangent, left, right, wrong = _slopes(law, where, step)
        if not wrong.any():
            return
    lane = int(np.argmax(wrong))
    rises = f"{left[lane]:g} to the left and {right[lane]:g} N/m to the right"
    examination.fail(f"with {form}, the tangent is {tangent[lane]:g} N/m where the force rises by {rises}", ADVICE)


def _slopes(law: _Law, where: Step, step: float) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    force = {shift: law.at(law.traced.force, where, shift * step) for shift in (-2, -1, 0, 1, 2)}
    right = (4.0 * force[1] - 3.0 * force[0] - force[2]) / (2.0 * step)
    left = (3.0 * force[0] - 4.0 * force[-1] + force[-2]) / (2.0 * step)
    tangent = law.at(law.tangent, where, 0.0)
    room = TOLERANCE * np.maximum(np.abs(right), np.abs(left)) + ROUNDING * np.max(np.abs(force[0])) / step
    inside = (tangent >= np.minimum(left, right) - room) & (tangent <= np.maximum(left, right) + room)
    return tangent, left, right, ~inside

"""The derived tangent of a law is its slope."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.expr.derive import derive
from dashpot.expr.interpret import interpret
from dashpot.expr.node import Node
from dashpot.kernel.columns import see_samples
from dashpot.kernel.curves import TableLaw, cubic_coefficients
from dashpot.kernel.trace import TracedBranch, trace_branch
from dashpot.model.element import Element
from dashpot.testing.motion import random_drive
from dashpot.testing.specimen import Specimen, draw_sizes, draw_specimens
from dashpot.testing.verdict import Examination

Array = NDArray[np.float64]

STEP = 1e-5  # of the amplitude
TOLERANCE = 2e-4
SAMPLES = 60


def check_tangent(element: type[Element], seed: int | None = None) -> None:
    """The tangent lies between the slopes to the left and to the right, also where nothing moves."""
    examination = Examination.begin(element, "tangent", seed)
    rng = examination.rng()
    sizes = draw_sizes(rng)
    drive = random_drive(rng, "dwelling", sizes.length, sizes.time, SAMPLES)
    for specimen in draw_specimens(element, rng, sizes):
        law = _Law.of(specimen)
        for still in (False, True):
            for states, motion in law.steps(drive, still):
                _compare(examination, law, states, motion, STEP * sizes.length, specimen.form)


@dataclass(frozen=True, eq=False)
class _Law:
    """A traced law with its numbers and its tangent."""

    traced: TracedBranch
    tangent: Node
    known: Mapping[str, object]
    tables: Mapping[str, TableLaw]
    lanes: int

    @classmethod
    def of(cls, specimen: Specimen) -> _Law:
        traced = trace_branch(specimen.branch)
        numbers = specimen.numbers
        tables = {path: TableLaw(curve, cubic_coefficients(curve, np.array([numbers[f"{path}[{k}]"]
                                                                            for k in range(len(curve.at))])))
                  for path, curve in specimen.spec.curves().items() if curve.at}  # fmt: skip
        return cls(traced, derive(traced.force, f"{traced.sight}.new"), numbers, tables, specimen.values.shape[0])

    def steps(self, drive: Drive, still: bool) -> list[tuple[dict[str, Array], dict[str, object]]]:
        """States (lanes,) before some steps of a drive and the motion of these steps; ``still`` steps go nowhere."""
        seen, found = see_samples(drive), []
        states = dict.fromkeys(self.traced.states, np.zeros(self.lanes))
        for k in range(1, drive.samples):
            motion = {name: np.asarray(value)[k] if np.ndim(value) else value for name, value in seen.items()}
            found.append((states, self.halted(motion) if still else motion))
            answer = interpret(list(self.traced.states.values()), {**self.known, **states, **motion}, self.tables)
            states = dict(zip(self.traced.states, answer, strict=True))
        return found[::3]

    def halted(self, motion: Mapping[str, object]) -> dict[str, object]:
        sight = self.traced.sight
        return {**motion, f"{sight}.new": motion[f"{sight}.old"]}

    def at(self, roots: list[Node], states: Mapping[str, Array], motion: Mapping[str, object], shift: float) -> list[Array]:
        name = f"{self.traced.sight}.new"
        moved = {**self.known, **states, **motion, name: motion[name] + shift}
        return [np.broadcast_to(value, (self.lanes,)) for value in interpret(roots, moved, self.tables)]


def _compare(examination: Examination, law: _Law, states: Mapping[str, Array], motion: Mapping[str, object], step: float,
             form: str) -> None:  # fmt: skip
    force = {shift: law.at([law.traced.force], states, motion, shift * step)[0] for shift in (-2, -1, 0, 1, 2)}
    right = (4.0 * force[1] - 3.0 * force[0] - force[2]) / (2.0 * step)
    left = (3.0 * force[0] - 4.0 * force[-1] + force[-2]) / (2.0 * step)
    (tangent,) = law.at([law.tangent], states, motion, 0.0)
    room = TOLERANCE * np.maximum(np.abs(right), np.abs(left)) + 1e-9 * np.max(np.abs(force[0])) / step
    outside = ~((tangent >= np.minimum(left, right) - room) & (tangent <= np.maximum(left, right) + room))
    if outside.any():
        lane = int(np.argmax(outside))
        examination.fail(f"with {form}, the tangent is {tangent[lane]:g} N/m where the force rises by {left[lane]:g} to the "
                         f"left and {right[lane]:g} N/m to the right", "The force must not jump with the position at the "
                         "end of the step, and its derivative must be finite.")  # fmt: skip

"""What can be measured of a network: the forces on its driven nodes and the motions of the nodes that it names.

Each branch answers by a complex stiffness and a mean force; the nodes are then eliminated as if these were linear. So
equal structures answer alike, whatever their laws are, and what shows here in no answer shows in no test.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.model.lint.law import Array, Law, Numbers
from dashpot.model.lint.response import Answer, Trials, answer_of
from dashpot.model.network import NetworkSpec
from dashpot.model.topology import COMPLIANCE, Topology

Complex = NDArray[np.complexfloating[Any, Any]]
FLOOR = 1e-3  # of the sizes that forces and motions have in a trial: what is less is rounding
SIDES = (0.5, -0.5)


@dataclass(frozen=True, eq=False)
class Outputs:
    """A network on its trials with some numbers, by path; ready to be asked what a change of them changes."""

    spec: NetworkSpec
    topology: Topology
    trials: Trials
    numbers: Numbers
    laws: tuple[Law, ...] = field(init=False)
    answers: tuple[Answer, ...] = field(init=False)
    sizes: Array = field(init=False)

    def __post_init__(self) -> None:
        laws = tuple(Law.of(edge.branch).with_numbers(self.numbers) for edge in self.topology.edges)
        object.__setattr__(self, "laws", laws)
        object.__setattr__(self, "answers", tuple(self._answer(k) for k in range(len(laws))))
        object.__setattr__(self, "sizes", self._sizes())

    def changes(self, steps: Mapping[str, float]) -> Array:
        """A column for each number: the change of all that is measured, per unit of its size, by a step of it."""
        varied = [self._varied(k, steps) for k in range(len(self.laws))]
        columns = [np.zeros((2 * self.sizes.size, 0))]
        for path, step in steps.items():
            up, down = (
                self._measured(
                    [found.get((path, side), answer) for found, answer in zip(varied, self.answers, strict=True)],
                    {**self.numbers, path: self.numbers[path] + side * step},
                )
                for side in SIDES
            )
            columns.append(self._relative(up - down)[:, None])
        return np.concatenate(columns, axis=1)

    def share(self, edge: int) -> Array:
        """The change of all that is measured, per unit of its size, when an edge carries a little more force."""
        more = [answer.scaled(1.0 + 1e-4 * (k == edge)) for k, answer in enumerate(self.answers)]
        return self._relative(self._measured(more, self.numbers) - self._measured(self.answers, self.numbers)) / 1e-4

    def _varied(self, k: int, steps: Mapping[str, float]) -> dict[tuple[str, float], Answer]:
        # all changes of one edge at once: each takes as many lanes as there are trials
        law, offset, trials = self.laws[k], self.topology.edges[k].offset, self.trials
        cases = [(path, side) for path in steps if path in law.numbers or path == offset for side in SIDES]
        if not cases:
            return {}
        moved = {
            path: np.repeat(
                [number + side * steps[other] * (other == path) for other, side in cases], trials.omega.size
            )
            for path, number in law.numbers.items()
        }
        shift = np.repeat([side * steps[path] * (path == offset) for path, side in cases], trials.omega.size)
        many = partial(np.tile, reps=len(cases))
        answer = answer_of(
            law.with_numbers(moved), many(trials.omega), many(trials.middle[k]) + shift, many(trials.amplitude[k])
        )
        return dict(zip(cases, answer.split(len(cases)), strict=True))

    def _answer(self, k: int) -> Answer:
        return answer_of(self.laws[k], self.trials.omega, self.trials.middle[k], self.trials.amplitude[k])

    def _relative(self, change: Complex) -> Array:
        relative = np.where(np.isfinite(change), change, 0.0) / self.sizes
        return np.concatenate([relative.real.ravel(), relative.imag.ravel()])

    def _measured(self, answers: Sequence[Answer], numbers: Numbers) -> Complex:
        return np.concatenate(self._blocks(answers, numbers), axis=1)

    def _sizes(self) -> Array:
        force, motion = (
            np.max(np.abs(block), axis=1, initial=0.0) for block in self._blocks(self.answers, self.numbers)
        )
        driven, amplitude = len(self.topology.held("driven")), np.max(self.trials.amplitude, axis=0)
        stiffness = np.max([np.abs(answer.stiffness) for answer in self.answers], axis=0)
        force[:, :driven] += FLOOR * stiffness[:, None]
        force[:, driven:] += FLOOR * (stiffness * amplitude)[:, None]
        motion[:, :driven] += FLOOR
        motion[:, driven:] += FLOOR * amplitude[:, None]
        rows = [np.repeat(size[:, None], count, axis=1) for size, count in ((force, driven), (motion, self._named()))]
        sizes = np.concatenate(rows, axis=1)
        return np.where(np.isfinite(sizes) & (sizes > 0.0), sizes, np.inf)

    def _named(self) -> int:
        return sum(name in self.spec.joints for name in self.topology.unknown)

    def _blocks(self, answers: Sequence[Answer], numbers: Numbers) -> tuple[Complex, Complex]:
        # forces on driven nodes and motions of named ones (trials, nodes, because of: each drive, each load, the mean)
        names = list(self.topology.joints)
        driven, unknown = (
            [names.index(name) for name in group] for group in (self.topology.held("driven"), self.topology.unknown)
        )
        loads = [k for k, name in enumerate(self.topology.unknown) if self.topology.joints[name].hold == "loaded"]
        stiffness, mean = self._assembled(answers, numbers, names)
        trials = len(mean)
        pushed = np.broadcast_to(-np.eye(len(unknown))[:, loads], (trials, len(unknown), len(loads)))
        asked = np.concatenate([stiffness[:, unknown][:, :, driven], pushed, mean[:, unknown, None]], axis=2)
        moved = -np.linalg.solve(stiffness[:, unknown][:, :, unknown], asked)
        held = np.concatenate(
            [stiffness[:, driven][:, :, driven], np.zeros((trials, len(driven), len(loads))), mean[:, driven, None]],
            axis=2,
        )
        force = held + stiffness[:, driven][:, :, unknown] @ moved
        seen = [k for k, name in enumerate(self.topology.unknown) if name in self.spec.joints]
        felt, moved = self._on_the_fixture(force, moved, numbers)
        return self._through_the_cell(felt, numbers, len(driven)), moved[:, seen]

    def _on_the_fixture(self, force: Complex, moved: Complex, numbers: Numbers) -> tuple[Complex, Complex]:
        """Forces and motions where each driven node moves the network by way of a fixture that gives way."""
        compliance = numbers.get(f"measurement.{COMPLIANCE}", 0.0)
        driven = force.shape[1]
        give = np.linalg.inv(np.eye(driven) + compliance * force[:, :, :driven])
        felt = give @ force
        return felt, moved - compliance * moved[:, :, :driven] @ felt

    def _assembled(self, answers: Sequence[Answer], numbers: Numbers, names: list[str]) -> tuple[Complex, Complex]:
        omega = self.trials.omega
        stiffness = np.zeros((omega.size, len(names), len(names)), complex)
        mean = np.zeros((omega.size, len(names)), complex)
        for edge, answer in zip(self.topology.edges, answers, strict=True):
            ends = ((names.index(edge.lower), 1.0), (names.index(edge.upper), -1.0))
            for row, sign in ends:
                mean[:, row] += sign * answer.mean
                for column, other in ends:
                    stiffness[:, row, column] += sign * other * answer.stiffness
        for row, joint in enumerate(self.topology.joints.values()):
            mass = sum(numbers[f"{joint.numbers}.{key}"] for key in joint.masses)
            stiffness[:, row, row] -= mass * omega**2
            mean[:, row] += mass * self.spec.gravity
        return stiffness, mean

    def _through_the_cell(self, force: Complex, numbers: Numbers, driven: int) -> Complex:
        cell = {key.partition(".")[2]: numbers[f"measurement.{key}"] for key in self.spec.measurement}
        seen = cell.get("gain", 1.0) * force
        turn = 1j * self.trials.omega
        late = np.exp(-turn * cell.get("delay", 0.0)) / (1.0 + turn * cell.get("lag", 0.0))
        seen[:, :, :driven] *= late[:, None, None]
        seen[:, :, -1] += cell.get("offset", 0.0)
        return seen

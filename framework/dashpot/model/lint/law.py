"""A branch on plain numbers, moved as one likes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.model.element import Motion
from dashpot.model.law_fault import told_of_law
from dashpot.model.network import Branch, Characteristic, Value, branch_slots

Array = NDArray[np.float64]
Numbers = Mapping[str, Any]  # by path, each a number or one for each lane

FAR, PAUSE, PAUSES = 1e3, 1e4, 20  # m, s, and how many of them to get there and to wait
NOTHING = 1e-6  # of the largest force on the way: what is less has faded
BESIDE = 1e-9  # of what is far: half the width over which a slope is taken
LINE = (2e5, 2e6)  # stiffness and bend of what is still to come from data, N/m and N/m^2


@dataclass(frozen=True)
class Law:
    """The law of a branch with all its numbers, by path; tables are read linearly between their knots."""

    branch: Branch
    numbers: Numbers

    @classmethod
    def of(cls, branch: Branch) -> Law:
        """The law with the parameters of the file."""
        own = stand_in(branch)
        return cls(own, {slot.path: slot.value.number for slot in branch_slots(own)})

    def with_numbers(self, numbers: Numbers) -> Law:
        """The same law with other numbers."""
        return Law(self.branch, {**self.numbers, **{path: numbers[path] for path in self.numbers if path in numbers}})

    def force(self, path: Array, velocity: Array, acceleration: Array, dt: Any) -> Array:
        """The force (steps, lanes) along a path (steps + 1, lanes) from the unloaded state, in steps of dt."""
        law, given = self.branch.element(), self._given()
        states: Mapping[str, Any] = dict.fromkeys(self.branch.element.declares.states, np.zeros(path.shape[1]))
        scale = _curve(f"{self.branch.numbers}.scale", self.branch.scale, self.numbers)
        forces = np.empty((len(path) - 1, path.shape[1]))
        with np.errstate(all="ignore"), told_of_law(self.branch.element):
            for k in range(len(forces)):
                x = Motion(path[k], path[k + 1], velocity[k], velocity[k + 1], acceleration[k + 1])
                response = law.step(x, SimpleNamespace(**states), given, dt)
                forces[k], states = response.force * scale(x.new), response.states
        return forces

    def holds(self) -> bool:
        """Whether the force still presses back at a deflection that is held for long, coming from a larger one.

        A spring does, to at least one side; friction presses the other way then, and what relaxes does no more.
        """
        there, back, rest = (
            np.linspace(0.0, 1.0, PAUSES + 1),
            np.linspace(1.0, 0.5, PAUSES + 1)[1:],
            np.full(PAUSES, 0.5),
        )
        share = np.concatenate([there, back, rest])[:, None]
        path = np.array([FAR, -FAR]) * share
        rate = np.gradient(path, PAUSE, axis=0)
        rate[-PAUSES - 1 :] = 0.0  # at rest from where the pause begins: no step runs past it
        force = self.force(path, rate, 0.0 * rate, PAUSE)
        pressing = force[-1] * np.sign(path[-1])
        # what cannot be told is not complained of
        return bool(((pressing > NOTHING * np.max(np.abs(force))) | np.isnan(pressing)).any())

    def _given(self) -> SimpleNamespace:
        name, declared = self.branch.numbers, self.branch.element.declares
        values = {
            key: self.numbers.get(f"{name}.{key}", parameter.default) for key, parameter in declared.parameters.items()
        }
        curves = {key: _curve(f"{name}.{key}", curve, self.numbers) for key, curve in self.branch.curves.items()}
        return SimpleNamespace(**values, **curves)


def stand_in(branch: Branch) -> Branch:
    """The branch with a slightly bent line, to be found, in place of a curve that comes from data."""
    curves = {key: _bent_line(curve) if curve.data else curve for key, curve in branch.curves.items()}
    return replace(branch, curves=curves)


def _bent_line(curve: Characteristic) -> Characteristic:
    values = tuple(
        Value(number, curve.curve.coefficient_unit(power), "free", scale="linear", node=curve.node)
        for power, number in enumerate(LINE, 1)
    )
    return Characteristic(curve.curve, "polynomial", values, node=curve.node)


def _curve(path: str, curve: Characteristic | None, numbers: Numbers) -> _Curve:
    if curve is None:
        return _Curve(lambda argument: 1.0)
    if curve.form == "constant":
        return _Curve(lambda argument: numbers[path] * argument)
    knots = [numbers[f"{path}[{number}]"] for number in range(len(curve.values))]
    if curve.form == "polynomial":
        return _Curve(lambda argument: sum(factor * argument**power for power, factor in enumerate(knots, 1)))
    return _Curve(lambda argument: _read_table(curve, knots, argument))


@dataclass(frozen=True)
class _Curve:
    value: Callable[[Any], Any]

    def __call__(self, argument: Any) -> Any:
        return self.value(argument)

    def slope(self, argument: Any) -> Any:
        """The slope, by a central difference over a width far below that of a curve."""
        width = BESIDE * (FAR + np.abs(argument))
        return (self.value(argument + width) - self.value(argument - width)) / (2.0 * width)


def _read_table(curve: Characteristic, knots: Sequence[Any], argument: Any) -> Array:
    # a factor stays as it is outside its knots
    inside = np.clip(argument, curve.at[0], curve.at[-1]) if curve.curve.value[1] == "1" else np.asarray(argument)
    last = len(knots) - 2
    total = np.zeros(np.broadcast_shapes(*(np.shape(value) for value in (inside, *knots))))
    for k, (low, high) in enumerate(pairwise(curve.at)):
        here = ((inside >= low) | (k == 0)) & ((inside < high) | (k == last))
        total = np.where(here, knots[k] + (inside - low) / (high - low) * (knots[k + 1] - knots[k]), total)
    return total

"""Running a network in plain numpy, step by step: the reference that compiled networks are held against.

Eagerly, every element's own ``step`` computes with arrays over lanes; nothing is traced. Interpreted, the traced graph
does. Both see the drive as the kernel does: rate-independent branches also move at turning points between samples.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.expr.interpret import Recipe
from dashpot.kernel.columns import see_samples, see_turns
from dashpot.kernel.compiler.trace import (
    RATES,
    Sight,
    TracedBranch,
    check_states,
    refuse_missing_numbers,
    trace_network,
)
from dashpot.kernel.curves import TableLaw, cubic_coefficients
from dashpot.kernel.following import without_channels
from dashpot.model.element import Motion, Response
from dashpot.model.network import Branch, Characteristic, NetworkSpec

Array = NDArray[np.float64]
Numbers = Mapping[str, Array]


def simulate_eagerly(spec: NetworkSpec, drive: Drive, values: Array | None = None) -> Array:
    """The force (lanes, samples) in N for ``values`` (lanes, slots), by the elements' own numpy code.

    Numbers over settings and channels are what ``values`` say.
    ``values`` are in the order of ``spec.slots()``; a single lane (slots,), or None for those of the network, is
    answered as (samples,).
    """
    spec, block = without_channels(spec), _block(spec, values)
    numbers = _numbers(spec, block)
    walkers = [
        _EagerWalker(branch, traced.sight, numbers, block.shape[0])
        for branch, traced in zip(spec.leaves(), trace_network(spec), strict=True)
    ]
    return _answer(_march(walkers, drive, block.shape[0]), values)


def simulate_interpreted(spec: NetworkSpec, drive: Drive, values: Array | None = None) -> Array:
    """The same as ``simulate_eagerly`` by interpreting the traced graph."""
    spec, block = without_channels(spec), _block(spec, values)
    numbers = _numbers(spec, block)
    tables = {path: table_law(path, curve, numbers) for path, curve in _tabulated(spec).items()}
    walkers = [_GraphWalker(traced, numbers, tables, block.shape[0]) for traced in trace_network(spec)]
    return _answer(_march(walkers, drive, block.shape[0]), values)


class EagerBranch:
    """A branch whose element computes with arrays; ``numbers`` holds the values (lanes,) of its slots by path."""

    def __init__(self, branch: Branch, numbers: Numbers) -> None:
        self.branch, self.law = branch, branch.element()
        declared = branch.element.declares
        self.parameters = SimpleNamespace(
            **{key: numbers.get(f"{branch.name}.{key}", law.default) for key, law in declared.parameters.items()},
            **{key: _curve(f"{branch.name}.{key}", curve, numbers) for key, curve in branch.curves.items()},
        )
        self.scale = _curve(f"{branch.name}.scale", branch.scale, numbers) if branch.scale else None

    def rest(self, lanes: int) -> dict[str, Array]:
        """The states of the unloaded specimen."""
        return {key: np.zeros(lanes) for key in self.branch.element.declares.states}

    def respond(self, x: Motion, states: Mapping[str, Any], dt: float) -> Response:
        """The force at the end of a step, scaled as the file says, and the new states."""
        response = self.law.step(x, SimpleNamespace(**states), self.parameters, dt)
        check_states(self.branch, response)
        force = response.force if self.scale is None else response.force * self.scale(x.new)
        return Response(force, **response.states)


class _Walker(ABC):
    """A branch that is moved step by step and keeps its own memory."""

    sight: Sight

    @abstractmethod
    def move(self, motion: Mapping[str, float], dt: float) -> Any:
        """The force after a step; changes the memory."""


class _EagerWalker(_Walker):
    """A branch whose element computes with arrays."""

    def __init__(self, branch: Branch, sight: Sight, numbers: Numbers, lanes: int) -> None:
        self.sight, self.eager = sight, EagerBranch(branch, numbers)
        self.states: Mapping[str, Any] = self.eager.rest(lanes)

    def move(self, motion: Mapping[str, float], dt: float) -> Any:
        # what a law of this sight does not depend on is not there to be used
        x = Motion(motion["old"], motion["new"], *(motion.get(rate, np.nan) for rate in RATES))
        response = self.eager.respond(x, self.states, dt)
        self.states = response.states
        return response.force


class _GraphWalker(_Walker):
    """A branch whose traced graph is interpreted."""

    def __init__(self, traced: TracedBranch, numbers: Numbers, tables: Mapping[str, TableLaw], lanes: int) -> None:
        self.traced, self.numbers, self.tables, self.sight = traced, numbers, tables, traced.sight
        self.states: dict[str, Any] = dict.fromkeys(traced.states, np.zeros(lanes))
        self.recipe = Recipe(traced.roots)

    def move(self, motion: Mapping[str, float], dt: float) -> Any:
        seen = {f"{self.sight}.{key}": value for key, value in motion.items()}
        known = {**self.numbers, **self.states, **seen, "dt": dt}
        force, *states = self.recipe(known, self.tables)
        self.states = dict(zip(self.traced.states, states, strict=True))
        return force


def _march(walkers: Sequence[_Walker], drive: Drive, lanes: int) -> Array:
    samples, turns = see_samples(drive), see_turns(drive)
    turning = [walker for walker in walkers if walker.sight == "monotone"]
    force, turn = np.zeros((lanes, drive.samples)), 0
    with np.errstate(all="ignore"):
        for k in range(drive.samples):
            while turn < drive.turn_step.size and drive.turn_step[turn] == k:
                for walker in turning:
                    walker.move(_motion(turns, "monotone", turn), drive.dt)
                turn += 1
            for walker in walkers:
                force[:, k] += walker.move(_motion(samples, walker.sight, k), drive.dt)
    return force


def _motion(seen: Mapping[str, Array | float], sight: Sight, number: int) -> dict[str, float]:
    names = {key: f"{sight}.{key}" for key in ("old", "new", *RATES)}
    return {key: np.asarray(seen[name])[number] for key, name in names.items() if name in seen}


def _block(spec: NetworkSpec, values: Array | None) -> Array:
    refuse_missing_numbers(spec)
    return np.atleast_2d([slot.value.number for slot in spec.slots()] if values is None else values)


def _answer(force: Array, values: Array | None) -> Array:
    return force[0] if values is None or np.ndim(values) == 1 else force


def _numbers(spec: NetworkSpec, block: Array) -> Numbers:
    return {slot.path: column for slot, column in zip(spec.slots(), block.T, strict=True)}


def _curve(path: str, curve: Characteristic, numbers: Numbers) -> TableLaw | _PowerLaw:
    if curve.form == "table":
        return table_law(path, curve, numbers)
    if curve.form == "constant":
        return _PowerLaw((numbers[path],))
    return _PowerLaw([numbers[f"{path}[{number}]"] for number in range(len(curve.values))])


@dataclass(frozen=True, eq=False)
class _PowerLaw:
    """A polynomial through the origin; ``factors`` (lanes,) of its powers from the first on."""

    factors: Sequence[Array]

    def __call__(self, argument: Any) -> Any:
        return sum(factor * argument**power for power, factor in enumerate(self.factors, 1))

    def slope(self, argument: Any) -> Any:
        return sum(power * factor * argument ** (power - 1) for power, factor in enumerate(self.factors, 1))


def table_law(path: str, curve: Characteristic, numbers: Numbers) -> TableLaw:
    """A table with its values from ``numbers``."""
    knots = np.array([numbers[f"{path}[{number}]"] for number in range(len(curve.at))])
    return TableLaw(curve, cubic_coefficients(curve, knots))


def _tabulated(spec: NetworkSpec) -> dict[str, Characteristic]:
    return {
        f"{branch.name}.{key}": curve
        for branch in spec.leaves()
        for key, curve in branch.characteristics().items()
        if curve.form == "table"
    }

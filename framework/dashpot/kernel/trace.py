"""Tracing a network: every branch's law as a graph of its motion, its states and its parameters."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, Literal

from dashpot.expr.node import Node, as_node, symbol, table, walk
from dashpot.model.element import Motion
from dashpot.model.network import Branch, Characteristic, Group, NetworkSpec
from dashpot.text.problem import InputError

# how a branch sees the drive: "still" without memory, "path" along the cubic of a whole step, "monotone" from turning
# point to turning point
Sight = Literal["still", "path", "monotone"]

RATES = ("velocity_old", "velocity_new", "acceleration")


@dataclass(frozen=True)
class TracedBranch:
    """The law of one branch as graph nodes. ``states`` maps the symbol of a state to its new value."""

    name: str
    sight: Sight
    force: Node
    states: dict[str, Node]


@dataclass(frozen=True)
class CurveLaw:
    """A curve as a law meets it: called with its argument."""

    path: str
    form: str
    count: int

    def __call__(self, argument: Any) -> Node:
        """The value of the curve as a graph."""
        if self.form == "constant":
            return symbol(self.path) * argument
        if self.form == "polynomial":
            total = symbol(f"{self.path}[{self.count - 1}]")
            for number in reversed(range(self.count - 1)):
                total = symbol(f"{self.path}[{number}]") + argument * total
            return argument * total
        return table(self.path, as_node(argument))


def trace_network(spec: NetworkSpec) -> tuple[TracedBranch, ...]:
    """The laws of all branches. Raises InputError where the network needs unknown nodes."""
    _refuse_series(spec.root)
    return tuple(trace_branch(branch) for branch in spec.leaves())


def trace_branch(branch: Branch) -> TracedBranch:
    """The law of a branch, seen as widely as it needs: rates and duration make it follow the whole path."""
    traced = _trace(branch, "path")
    used = {node.payload for node in walk(_roots(traced)) if node.operation == "symbol"}
    if not traced.states:
        return _trace(branch, "still")
    needs_rates = "dt" in used or any(f"path.{rate}" in used for rate in RATES)
    return traced if needs_rates else _trace(branch, "monotone")


def _trace(branch: Branch, sight: Sight) -> TracedBranch:
    law = branch.element()
    motion = Motion(*(symbol(f"{sight}.{key}") for key in ("old", "new", *RATES)))
    declared = branch.element.declares
    states = {key: f"{branch.name}|{key}" for key in declared.states}
    response = law.step(
        motion,
        SimpleNamespace(**{key: symbol(name) for key, name in states.items()}),
        SimpleNamespace(**{key: _parameter(branch, key) for key in (*declared.parameters, *declared.curves)}),
        symbol("dt"),
    )
    if set(response.states) != set(states):
        raise TypeError(f"element '{branch.element.word}' declares the states {sorted(states)} but its step answers "
                        f"{sorted(response.states)}; answer Response(force, <state>=...) for each")  # fmt: skip
    force = as_node(response.force)
    if branch.scale:
        force = force * CurveLaw(f"{branch.name}.scale", branch.scale.form, len(branch.scale.values))(motion.new)
    return TracedBranch(branch.name, sight, force, {states[k]: as_node(v) for k, v in response.states.items()})


def _parameter(branch: Branch, key: str) -> Node | CurveLaw | float | None:
    if key in branch.curves:
        curve: Characteristic = branch.curves[key]
        return CurveLaw(f"{branch.name}.{key}", curve.form, len(curve.values))
    if key in branch.values:
        return symbol(f"{branch.name}.{key}")
    return branch.element.declares.parameters[key].default


def _roots(traced: TracedBranch) -> list[Node]:
    return [traced.force, *traced.states.values()]


def _refuse_series(group: Group) -> None:
    for member in group.members:
        if isinstance(member, Group):
            if member.kind == "series":
                raise InputError.at(member.place, f"the branch '{member.name}' is a series connection, whose inner node "
                                    "this version cannot solve", "use an element that contains the series, such as "
                                    "maxwell or prandtl")  # fmt: skip
            _refuse_series(member)

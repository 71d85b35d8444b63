"""Tracing a network: every branch's law as a graph of its motion, its states and its parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any, Literal

from dashpot.expr.node import Node, TraceError, as_node, symbol, symbols_of, table, walk
from dashpot.kernel.following import Moment, channel_symbol, channel_symbols, moved
from dashpot.model.element import Motion, Response
from dashpot.model.law_fault import told_of_law
from dashpot.model.network import Branch, Characteristic, NetworkSpec, Value
from dashpot.text.problem import InputError, Place

# how a branch sees the drive: "still" without memory, "path" along the cubic of a whole step, "monotone" from turning
# point to turning point; "edge" is the law in itself, with the symbols of a motion that is put in later
Sight = Literal["still", "path", "monotone", "edge"]

STATE_MARK = "|"  # between the branch and the state in the symbol of a state
RATES = ("velocity_old", "velocity_new", "acceleration")


@dataclass(frozen=True)
class TracedBranch:
    """The law of one branch as graph nodes. ``states`` maps the symbol of a state to its new value.

    ``stops`` are the two deflections between which a rigid law is free to move; None for the others.
    """

    name: str
    sight: Sight
    force: Node
    states: Mapping[str, Node]
    stops: tuple[Node, Node] | None = None

    @property
    def roots(self) -> list[Node]:
        """Everything that the law computes."""
        return [self.force, *self.states.values()]


@dataclass(frozen=True)
class CurveLaw:
    """A curve as a traced law meets it: called with its argument. ``numbers`` are those beside the knots of a table."""

    path: str
    form: str
    numbers: tuple[Node, ...]

    @classmethod
    def of(cls, path: str, curve: Characteristic, moment: Moment) -> CurveLaw:
        """A curve whose numbers see channels at a moment of the step."""
        numbers: tuple[Node, ...] = ()
        if curve.form == "constant":
            numbers = (_number(path, curve.values[0], moment),)
        elif curve.form == "polynomial":
            numbers = tuple(_number(f"{path}[{k}]", value, moment) for k, value in enumerate(curve.values))
        return cls(path, curve.form, numbers)

    def __call__(self, argument: Any) -> Node:
        """The value of the curve as a graph."""
        if self.form == "constant":
            return self.numbers[0] * argument
        if self.form == "polynomial":
            *lower, total = self.numbers
            for factor in reversed(lower):
                total = factor + argument * total
            return argument * total
        return table(self.path, as_node(argument))

    def slope(self, argument: Any) -> Node:
        """The slope of the curve as a graph."""
        if self.form == "table":
            return table(self.path, as_node(argument), 1)
        *lower, total = [power * number for power, number in enumerate(self.numbers, 1)]
        for factor in reversed(lower):
            total = factor + argument * total
        return as_node(total)


def trace_network(spec: NetworkSpec) -> tuple[TracedBranch, ...]:
    """The laws of all branches of a network with two ends, each along the motion of the driven one."""
    return tuple(trace_branch(branch) for branch in spec.leaves())


def refuse_missing_numbers(spec: NetworkSpec) -> None:
    """Raise InputError for a curve that is to come from data and has not been taken from any yet."""
    for path, curve in spec.data_curves().items():
        if curve.form == "data":
            place = curve.node.place if curve.node else Place()
            raise InputError.at(
                place,
                f"the curve '{path}' is to be taken from data and has no knots yet",
                "fit the network first, or write a table",
            )


def trace_branch(branch: Branch) -> TracedBranch:
    """The law of a branch, seen as widely as it needs: rates and duration make it follow the whole path.

    Raises InputError, naming the element and the line, for a law that cannot be traced.
    """
    traced = _see(branch)
    _refuse_moving_tables(branch, traced)
    return traced


def _see(branch: Branch) -> TracedBranch:
    traced = trace_along(branch, "path")
    if not traced.states:
        return trace_along(branch, "still")
    return trace_along(branch, "monotone") if rate_independent(traced) else traced


def rate_independent(traced: TracedBranch) -> bool:
    """Whether a law depends neither on rates nor on how long a step takes."""
    used = {name for root in traced.roots for name in symbols_of(root)}
    return "dt" not in used and not any(f"{traced.sight}.{rate}" in used for rate in RATES)


def trace_along(branch: Branch, sight: Sight) -> TracedBranch:
    """The law of a branch as a graph of the symbols ``<sight>.old``, ``<sight>.new`` and so on.

    The memory of a law that depends on rates or on time sees channels halfway through the step. Raises InputError,
    naming the element and the line, for a law that cannot be traced.
    """
    traced = _trace(branch, sight, "channel")
    if not traced.states or rate_independent(traced) or not any(_channels(node) for node in traced.states.values()):
        return traced
    return replace(traced, states=_trace(branch, sight, "halfway").states)


def _trace(branch: Branch, sight: Sight, moment: Moment) -> TracedBranch:
    motion, states, parameters = _motion(sight), _states(branch), _parameters(branch, moment)
    with told_of_law(branch.element):
        response = branch.element().step(motion, _symbols(states), parameters, symbol("dt"))
        check_states(branch, response)
        force, answered = as_node(response.force), {states[k]: as_node(v) for k, v in response.states.items()}
        stops = branch.element().stops(parameters)
    if branch.scale:
        force = force * _scale(branch, motion, moment)
    held = None if stops is None else (as_node(stops[0]), as_node(stops[1]))
    return TracedBranch(branch.name, sight, force, answered, held)


def _channels(node: Node) -> set[str]:
    return channel_symbols(symbols_of(node))


def trace_stored(branch: Branch, sight: Sight) -> Node | None:
    """The energy in J that a branch stores, from the motion and the states at the end of a step; None: not known.

    A law of the deflection alone stores all ``work`` that is done on it, one of the rates alone stores nothing. The
    others have to say it; a ``scale`` multiplies what they say. Where what is stored moves with a channel, something
    beside the motion does work on the branch, so that it is not known.
    """
    motion, states = _motion(sight), _states(branch)
    with told_of_law(branch.element):
        said = branch.element().stored(motion, _symbols(states), _parameters(branch, "channel"))
        stored = None if said is None else as_node(said)
    if stored is not None:
        whole = stored * _scale(branch, motion, "channel")
        return None if _channels(whole) else whole
    law = trace_along(replace(branch, scale=None), sight)
    moving = symbols_of(law.force) & {*(f"{sight}.{key}" for key in ("old", "new", *RATES)), *states.values(), "dt"}
    if moving <= {f"{sight}.new"}:
        return None if _channels(law.force) else symbol("work")
    return as_node(0.0) if moving <= {f"{sight}.{rate}" for rate in RATES} else None


def _motion(sight: Sight) -> Motion:
    return Motion(*(symbol(f"{sight}.{key}") for key in ("old", "new", *RATES)))


def _states(branch: Branch) -> dict[str, str]:
    return {key: f"{branch.name}{STATE_MARK}{key}" for key in branch.element.declares.states}


def _symbols(names: Mapping[str, str]) -> SimpleNamespace:
    return SimpleNamespace(**{key: symbol(name) for key, name in names.items()})


def _parameters(branch: Branch, moment: Moment) -> SimpleNamespace:
    declared = branch.element.declares
    return SimpleNamespace(**{key: _parameter(branch, key, moment) for key in (*declared.parameters, *declared.curves)})


def _scale(branch: Branch, motion: Motion, moment: Moment) -> Any:
    return CurveLaw.of(f"{branch.numbers}.scale", branch.scale, moment)(motion.new) if branch.scale else 1.0


def check_states(branch: Branch, response: Response) -> None:
    """Raise TraceError where a law does not answer exactly the states that it declares."""
    declared, answered = sorted(branch.element.declares.states), sorted(response.states)
    if declared != answered:
        raise TraceError(
            f"it declares the states {declared} but its step answers {answered}; "
            "answer Response(force, <state>=...) with each of them"
        )


def _parameter(branch: Branch, key: str, moment: Moment) -> Node | CurveLaw | float | None:
    path = f"{branch.numbers}.{key}"
    if key in branch.curves:
        return CurveLaw.of(path, branch.curves[key], moment)
    if key in branch.values:
        return _number(path, branch.values[key], moment)
    return branch.element.declares.parameters[key].default


def _number(path: str, value: Value, moment: Moment) -> Node:
    over = value.over
    if over is None or not over.channel:
        return symbol(path)
    numbers = [symbol(path + ending) for ending in over.endings]
    return as_node(moved(over, symbol(path), numbers, symbol(channel_symbol(over.word, moment)), value.sensible))


def _refuse_moving_tables(branch: Branch, traced: TracedBranch) -> None:
    # the kernel looks tables up once per sample for all lanes, so their arguments may depend on the drive alone, and a
    # memory that moves at turning points, between the samples, may not read one
    for node in walk(traced.roots):
        if node.operation == "table":
            used = symbols_of(node.arguments[0])
            moving = {name for name in used if name.startswith(f"{traced.sight}.")}
            if not moving or used - moving - {"dt"}:
                _refuse_table(branch, node, f"at {', '.join(sorted(used - moving)) or 'a constant'}")
    if traced.sight == "monotone":
        for node in walk(traced.states.values()):
            if node.operation == "table":
                _refuse_table(branch, node, "for its memory between two samples")


def _refuse_table(branch: Branch, node: Node, where: str) -> None:
    path, _ = node.payload
    message = f"the element '{branch.element.word}' looks up the table '{path}' {where}, expected along the drive"
    raise InputError.at(branch.place, message, "write the curve as a constant or as a polynomial")

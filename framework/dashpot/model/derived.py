"""Which parameters of a network follow from which others, and computing them for whole blocks of lanes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dashpot.expr.interpret import interpret
from dashpot.expr.node import Node
from dashpot.model.expression import Expression, parse_expression, same_powers, told_powers
from dashpot.text.problem import InputError, Place, Problem, nearest
from dashpot.text.quantity import powers

if TYPE_CHECKING:
    from dashpot.model.network import Slot, Value

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rule:
    """How the number in one slot follows: ``node`` over the names, each of which is a slot."""

    slot: int
    node: Node
    names: Mapping[str, int]
    sensible: tuple[float, float]


@dataclass(frozen=True)
class Derived:
    """The rules of a network, those first that others need."""

    rules: tuple[Rule, ...] = ()

    def fill(self, values: Array) -> Array:
        """Lanes (lanes, slots) in SI with all numbers that follow from others, in place.

        A number outside of the range in which it makes sense is NaN: a lane that has one fails.
        """
        for rule in self.rules:
            [found] = interpret([rule.node], {name: values[:, slot] for name, slot in rule.names.items()})
            low, high = rule.sensible
            values[:, rule.slot] = np.where((found >= low) & (found <= high), found, np.nan)
        return values


def derived_of(slots: Sequence[Slot]) -> Derived:
    """The rules of the parameters of a network. Raises InputError with all that is wrong with them."""
    places = {slot.path: number for number, slot in enumerate(slots)}
    problems: list[Problem] = []
    rules = {}
    for number, slot in enumerate(slots):
        if slot.value.expression:
            try:
                rules[number] = _rule(number, slots, places)
            except ValueError as error:
                problems.append(_problem(slot, str(error)))
    if problems:
        raise InputError(problems)
    return Derived(tuple(_in_turn(rules, slots)))


def followed(slots: Sequence[Slot], derived: Derived) -> dict[str, Value]:
    """The numbers that follow from others, by path. Raises InputError for one outside of where it makes sense."""
    numbers = derived.fill(np.array([[slot.value.number for slot in slots]]))[0]
    found = {}
    for rule in derived.rules:
        slot, number = slots[rule.slot], float(numbers[rule.slot])
        if not np.isfinite(number):
            low, high = rule.sensible
            message = (
                f"expected an expression that gives {low:g} to {high:g} {slot.value.unit}, "
                f"'{slot.value.expression}' does not; check its values and their units"
            )
            raise InputError([_problem(slot, message)])
        found[slot.path] = replace(slot.value, number=number)
    return found


def _rule(number: int, slots: Sequence[Slot], places: Mapping[str, int]) -> Rule:
    slot = slots[number]
    expression = parse_expression(slot.value.expression)
    names = {name: _find(name, slot.path, places) for name in expression.names}
    for name, place in names.items():
        value = slots[place].value
        if value.setting or value.over:
            raise ValueError(
                f"'{name}' depends on a setting and differs from run to run: no expression can refer to it; "
                "write the dependence at both parameters"
            )
    _check_unit(expression, slot, {name: slots[place].value.unit for name, place in names.items()})
    return Rule(number, expression.term.node, names, slot.value.sensible)


def _find(name: str, path: str, places: Mapping[str, int]) -> int:
    """The slot that a name means at a path: of the own branch, of its group, of the groups around it, of the file."""
    scope = path
    while scope:
        scope = scope.rpartition(".")[0]
        full = f"{scope}.{name}" if scope else name
        if full in places and full != path:
            return places[full]
    if name == path or path.endswith(f".{name}"):
        raise ValueError(f"the parameter refers to itself by '{name}'; refer to another one")
    hint = nearest(name, places) or f"known here: {', '.join(places)}"
    raise ValueError(f"there is no parameter '{name}'; {hint}")


def _check_unit(expression: Expression, slot: Slot, units: Mapping[str, str]) -> None:
    found, wanted = expression.powers(lambda name: units[name]), powers(slot.value.unit)
    if not same_powers(found, wanted):
        raise ValueError(
            f"expected an expression in {slot.value.unit}, got one that measures {told_powers(found)}; "
            "multiply by a quantity with the missing unit, e.g. '0.02 s * stiffness'"
        )


def _in_turn(rules: Mapping[int, Rule], slots: Sequence[Slot]) -> Iterator[Rule]:
    """The rules, those first that others need. Raises InputError for a circle of numbers."""
    waiting = dict(rules)
    while waiting:
        ready = [number for number, rule in waiting.items() if not set(rule.names.values()) & set(waiting)]
        if not ready:
            circle = ", ".join(f"'{slots[number].path}'" for number in waiting)
            message = f"{circle} follow from one another in a circle; give one of them a value"
            raise InputError([_problem(slots[next(iter(waiting))], message)])
        for number in ready:
            yield waiting.pop(number)


def _problem(slot: Slot, message: str) -> Problem:
    said, _, hint = message.rpartition("; ")
    place = slot.value.node.place if slot.value.node else Place()
    return Problem(place, f"{slot.path}: {said or hint}", hint if said else "")

"""Parameters of a network that follow from others: ``{expression: 0.5 * front.stiffness}``.

An expression has numbers, quantities with a unit, paths of other numbers, ``+ - * / ^`` between spaces, parentheses and
the functions of ``FUNCTIONS``. It is parsed here, never run as code, and its unit is checked.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from dashpot.expr.node import Node, TraceError, apply, constant, symbol
from dashpot.text.quantity import base_unit_of, measure, powers

Powers = Mapping[str, float]

TOKEN = re.compile(r"[(),]|[^\s(),]+")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?")
NAME = re.compile(r"\w[\w+-]*(?:\.\w[\w+-]*)*(?:\[\d+\])*")
SUMS, PRODUCTS = {"+": "add", "-": "subtract"}, {"*": "multiply", "/": "divide"}
OPERATORS = (*SUMS, *PRODUCTS, "^")
FUNCTIONS = {"sqrt": "sqrt", "exp": "exp", "log": "log", "min": "minimum", "max": "maximum"}
CLOSE = 1e-9  # powers of units that count as equal
LONGEST, DEEPEST = 500, 50


@dataclass(frozen=True)
class Term:
    """A part of an expression: its graph over the names as they are written, and how its unit follows from theirs."""

    node: Node
    powers: Callable[[Callable[[str], Powers]], Powers]


@dataclass(frozen=True)
class Expression:
    """An expression as it was read; ``names`` are the paths in it, as they are written."""

    text: str
    names: tuple[str, ...]
    term: Term

    def powers(self, unit_of: Callable[[str], str]) -> Powers:
        """The powers of its unit, from those of its names. ValueError where units do not fit each other."""
        return self.term.powers(lambda name: powers(unit_of(name)))


@cache
def parse_expression(text: str) -> Expression:
    """Read an expression. ValueError (expected, got, what to do) for a text that is none."""
    if len(text) > LONGEST:
        raise ValueError(f"expected an expression of up to {LONGEST} characters, got {len(text)}")
    parser = _Parser(TOKEN.findall(text))
    try:
        term = parser.whole()
    except TraceError:
        raise ValueError("expected a number, got a constant that is none, such as the root of a negative") from None
    return Expression(text, tuple(dict.fromkeys(parser.names)), term)


class _Parser:
    """A descent through the tokens: sums of products of powers of atoms."""

    def __init__(self, tokens: Sequence[str]) -> None:
        self.tokens, self.place, self.depth = list(tokens), 0, 0
        self.names: list[str] = []

    def whole(self) -> Term:
        term = self._sum()
        if self._next is not None:
            raise ValueError(f"expected an operator, got '{self._next}'; write operators between spaces: 0.5 * a.b")
        return term

    @property
    def _next(self) -> str | None:
        return self.tokens[self.place] if self.place < len(self.tokens) else None

    def _take(self) -> str:
        token = self._next
        if token is None:
            raise ValueError("expected a number or a path at the end of the expression, got nothing; complete it")
        self.place += 1
        return token

    def _expect(self, wanted: str) -> None:
        if self._next != wanted:
            raise ValueError(f"expected '{wanted}', got {_told(self._next)}; check the parentheses")
        self.place += 1

    def _sum(self) -> Term:
        return self._chain(self._product, SUMS, _alike)

    def _product(self) -> Term:
        return self._chain(self._power, PRODUCTS, _multiplied)

    def _chain(self, part: Callable[[], Term], operators: Mapping[str, str], unit: _UnitRule) -> Term:
        term = part()
        while self._next in operators:
            operation = operators[self._take()]
            term = _joined(operation, [term, part()], unit)
        return term

    def _power(self) -> Term:
        term = self._atom()
        if self._next != "^":
            return term
        self._take()
        token = self._take()
        if not NUMBER.fullmatch(token):
            raise ValueError(f"expected a plain number as exponent, got '{token}'")
        exponent = float(token)
        return Term(
            apply("power", term.node, constant(exponent)),
            lambda known: _scaled(term.powers(known), exponent),
        )

    def _atom(self) -> Term:
        token = self._take()
        if token == "(":
            term = self._nested()
            self._expect(")")
            return term
        if NUMBER.fullmatch(token):
            return self._quantity(token)
        if token in FUNCTIONS and self._next == "(":
            return self._call(token)
        if token in OPERATORS or not NAME.fullmatch(token):
            raise ValueError(
                f"expected a number, a path such as front.stiffness or one of {', '.join(FUNCTIONS)} with "
                f"parentheses, got '{token}'; write operators between spaces"
            )
        self.names.append(token)
        return Term(symbol(token), lambda known: known(token))

    def _nested(self) -> Term:
        self.depth += 1
        if self.depth > DEEPEST:
            raise ValueError(f"expected parentheses up to {DEEPEST} deep, got more; write several numbers")
        term = self._sum()
        self.depth -= 1
        return term

    def _quantity(self, number: str) -> Term:
        unit = self._next if self._next not in (None, "(", ")", ",", *OPERATORS) else ""
        self.place += bool(unit)
        written = f"{number} {unit}".strip()
        base = base_unit_of(written)
        return Term(constant(measure(written)), lambda known: powers(base))

    def _call(self, name: str) -> Term:
        self._expect("(")
        arguments = [self._nested()]
        while self._next == ",":
            self._take()
            arguments.append(self._nested())
        self._expect(")")
        several = name in ("min", "max")
        if several != (len(arguments) > 1):
            wanted = "two or more numbers" if several else "one number"
            raise ValueError(f"expected {wanted} in {name}(...), got {len(arguments)}")
        if several:
            term, *rest = arguments
            for other in rest:
                term = _joined(FUNCTIONS[name], [term, other], _alike)
            return term
        return _joined(FUNCTIONS[name], arguments, _rooted if name == "sqrt" else _plain)


_UnitRule = Callable[[str, Sequence[Powers]], Powers]


def _joined(operation: str, terms: Sequence[Term], unit: _UnitRule) -> Term:
    return Term(
        apply(operation, *(term.node for term in terms)),
        lambda known: unit(operation, [term.powers(known) for term in terms]),
    )


def _alike(_: str, units: Sequence[Powers]) -> Powers:
    first, second = units
    if not same_powers(first, second):
        raise ValueError(
            f"expected quantities of one kind on both sides of a sum, min or max, got {told_powers(first)} and "
            f"{told_powers(second)}; a number beside a quantity needs its unit, e.g. '+ 10 N/mm'"
        )
    return first


def _multiplied(operation: str, units: Sequence[Powers]) -> Powers:
    first, second = units
    sign = 1.0 if operation == "multiply" else -1.0
    return {key: first.get(key, 0.0) + sign * second.get(key, 0.0) for key in {*first, *second}}


def _rooted(_: str, units: Sequence[Powers]) -> Powers:
    return _scaled(units[0], 0.5)


def _plain(operation: str, units: Sequence[Powers]) -> Powers:
    if not same_powers(units[0], {}):
        raise ValueError(f"expected a ratio in {operation}(...), got {told_powers(units[0])}; divide by a reference")
    return {}


def _scaled(unit: Powers, factor: float) -> Powers:
    return {key: factor * power for key, power in unit.items()}


def same_powers(first: Powers, second: Powers) -> bool:
    """Whether two units measure the same kind of quantity."""
    return all(abs(first.get(key, 0.0) - second.get(key, 0.0)) < CLOSE for key in {*first, *second})


def told_powers(unit: Powers) -> str:
    """The kind of a quantity in words: ``mass * time^-2``."""
    return " * ".join(_factors(unit)) or "a ratio"


def _factors(unit: Powers) -> Iterator[str]:
    for key, power in sorted(unit.items()):
        if abs(power) > CLOSE:
            name = key.strip("[]")
            yield name if abs(power - 1.0) < CLOSE else f"{name}^{power:g}"


def _told(token: str | None) -> str:
    return "nothing" if token is None else f"'{token}'"

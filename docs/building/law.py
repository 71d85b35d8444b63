"""The law of an element as its docstring states it: parsed, so that it can be set as an equation, and evaluated.

After the first colon of a docstring stand clauses with commas between them; a clause with ``=``, ``<`` or ``<=`` is an
equation, words around it stay words. Products are written by juxtaposition: ``F = damping v |v|``.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

TOKEN = re.compile(r"\s*(\d+(?:\.\d+)?|sum of|K\*|[A-Za-z]\w*'*|<=|[-+*/^()|=<>])")
WORDS = re.compile(r"\b(no|while|beyond|that|for|else|against|the|motion)\b")
RELATIONS = ("=", "<", "<=", ">")
FUNCTIONS: Mapping[str, Callable[..., Any]] = {"sgn": np.sign, "tanh": np.tanh, "exp": np.exp, "max": np.max}
GREEK = {"sigma": "σ"}
DIFFERENTIALS = ("dF", "dx", "dt")


@dataclass(frozen=True)
class Term:
    """A piece of an equation: an ``operation`` on ``parts``, or a ``name`` or ``number`` with its ``text``."""

    operation: str
    parts: tuple[Term, ...] = ()
    text: str = ""


def clauses(made: type[Any]) -> list[list[str | Term]]:
    """The clauses of the law of an element: each a list of words and equations."""
    sentence = " ".join(inspect.cleandoc(made.__doc__ or "").split("\n\n")[0].split())
    law = sentence.partition(": ")[2].removesuffix(".")
    return [list(_pieces(clause)) for clause in _split(law)]


def equations(made: type[Any]) -> list[Term]:
    """The equations among the clauses."""
    return [piece for clause in clauses(made) for piece in clause if isinstance(piece, Term)]


def parse(text: str) -> Term:
    """An equation as a term. ValueError for what is none."""
    return _Parser(text).whole()


def evaluate(term: Term, names: Mapping[str, Any]) -> Any:
    """The value of a term that is no relation. KeyError for a name without a value."""
    if term.operation == "number":
        return float(term.text)
    if term.operation == "name":
        return names[term.text]
    if term.operation == "call":
        return (FUNCTIONS | dict(names))[term.text](*(evaluate(part, names) for part in term.parts))
    values = [evaluate(part, names) for part in term.parts]
    return OPERATIONS[term.operation](*values)


OPERATIONS: Mapping[str, Callable[..., Any]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "^": np.power,
    "abs": np.abs,
    "minus": np.negative,
    "group": lambda value: value,
}


def mathml(term: Term, symbols: Mapping[str, str]) -> str:
    """The term as MathML; a name that has a symbol is shown by it."""
    return f'<math display="block"><mrow>{_set(term, symbols)}</mrow></math>'


def symbol(text: str) -> str:
    """A name as MathML, with its index and its primes."""
    name, primes = text.rstrip("'"), "′" * text.count("'")
    head, _, index = name.partition("_")
    if head in DIFFERENTIALS:
        return "<mi>d</mi>" + symbol(text.removeprefix("d"))
    letter = f"<mi>{GREEK.get(head, head)}</mi>" if len(head) < 3 or head in GREEK else f"<mtext>{name}</mtext>"
    base = f"<msub>{letter}<mi>{index}</mi></msub>" if index and len(head) < 3 else letter
    return f"<msup>{base}<mo>{primes}</mo></msup>" if primes else base


def _set(term: Term, symbols: Mapping[str, str]) -> str:
    parts = [_set(part, symbols) for part in term.parts]
    match term.operation:
        case "number":
            return f"<mn>{term.text}</mn>"
        case "name":
            return symbol(symbols.get(term.text) or term.text)
        case "call":
            name = f"<mi>{symbols.get(term.text, term.text)}</mi>"
            return f"<mrow>{name}<mo>&#x2061;</mo><mo>(</mo>{''.join(parts)}<mo>)</mo></mrow>"
        case "/":
            top, below = ("".join(_set(_bare(part), symbols)) for part in term.parts)
            return f"<mfrac><mrow>{top}</mrow><mrow>{below}</mrow></mfrac>"
        case "^":
            return f"<msup><mrow>{parts[0]}</mrow><mrow>{_set(_bare(term.parts[1]), symbols)}</mrow></msup>"
        case "abs":
            return f"<mrow><mo>|</mo>{parts[0]}<mo>|</mo></mrow>"
        case "group":
            return f"<mrow><mo>(</mo>{parts[0]}<mo>)</mo></mrow>"
        case "sum":
            return f"<munder><mo>∑</mo><mi>i</mi></munder>{parts[0]}"
        case "minus":
            return f"<mo>−</mo>{parts[0]}"
        case "*":
            return f"{parts[0]}<mspace width='0.17em'/>{parts[1]}"
    sign = {"-": "−", "<": "&lt;", "<=": "≤", ">": "&gt;"}.get(term.operation, term.operation)
    return f"{parts[0]}<mo>{sign}</mo>{parts[1]}"


def _bare(term: Term) -> Term:
    return term.parts[0] if term.operation == "group" else term


def _split(law: str) -> Iterator[str]:
    yield from re.split(r",\s+(?![^()]*\))", law)


def _pieces(clause: str) -> Iterator[str | Term]:
    words: list[str] = []
    for piece in filter(None, (part.strip() for part in WORDS.split(clause))):
        if not any(f" {relation} " in piece for relation in RELATIONS):
            words.append(piece)
            continue
        if words:
            yield " ".join(words)
        words = []
        yield parse(piece)
    if words:
        yield " ".join(words)


class _Parser:
    """Recursive descent over the tokens of one equation; ``bars`` counts the open bars of absolute values."""

    def __init__(self, text: str) -> None:
        self.text, self.tokens, self.bars = text, TOKEN.findall(text), 0
        if "".join(self.tokens).replace(" ", "") != text.replace(" ", ""):
            raise ValueError(f"expected an equation, got '{text}'")

    def whole(self) -> Term:
        found = self.sum()
        while self.tokens and self.tokens[0] in RELATIONS:
            found = Term(self.tokens.pop(0), (found, self.sum()))
        if self.tokens:
            raise ValueError(f"expected the end of '{self.text}', got '{self.tokens[0]}'")
        return found

    def sum(self) -> Term:
        found = self.product()
        while self.tokens and self.tokens[0] in "+-":
            found = Term(self.tokens.pop(0), (found, self.product()))
        return found

    def product(self) -> Term:
        if self.tokens[0] == "sum of":
            self.tokens.pop(0)
            return Term("sum", (self.product(),))
        if self.tokens[0] == "-":
            self.tokens.pop(0)
            return Term("minus", (self.product(),))
        found = self.power()
        while self.tokens and self._goes_on():
            if self.tokens[0] == "/":
                self.tokens.pop(0)
                found = Term("/", (found, self.power()))
            else:
                found = Term("*", (found, self.power()))
        return found

    def power(self) -> Term:
        found = self.atom()
        if self.tokens and self.tokens[0] == "^":
            self.tokens.pop(0)
            return Term("^", (found, self.exponent()))
        return found

    def exponent(self) -> Term:
        if self.tokens[0] == "-":
            self.tokens.pop(0)
            return Term("minus", (self.atom(),))
        return self.atom()

    def atom(self) -> Term:
        token = self.tokens.pop(0)
        if token == "(":
            return Term("group", (self._closed(")"),))
        if token == "|":
            self.bars += 1
            inside = self._closed("|")
            self.bars -= 1
            return Term("abs", (inside,))
        if token[0].isdigit():
            return Term("number", text=token)
        if self.tokens[:1] == ["("] and token in {*FUNCTIONS, "f"}:
            self.tokens.pop(0)
            return Term("call", (self._closed(")"),), token)
        if token in FUNCTIONS:
            return Term("call", (self.atom(),), token)
        if not token[0].isalpha():
            raise ValueError(f"expected a name or a number in '{self.text}', got '{token}'")
        return Term("name", text=token)

    def _closed(self, end: str) -> Term:
        found = self.sum()
        if not self.tokens or self.tokens.pop(0) != end:
            raise ValueError(f"expected '{end}' in '{self.text}'")
        return found

    def _goes_on(self) -> bool:
        token = self.tokens[0]
        return token in ("/", "(") or token[0].isalnum() or (token == "|" and not self.bars)

"""What is wrong, where, and what to do: the one way in which input errors are told."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Place:
    """A place in a file. Lines and columns count from 1; what is unknown is None."""

    file: str | None = None
    line: int | None = None
    column: int | None = None

    def __str__(self) -> str:
        if self.line is None:
            return self.file or ""
        parts = [self.file or "<text>", self.line, self.column]
        return ":".join(str(part) for part in parts if part is not None)


@dataclass(frozen=True)
class Problem:
    """One mistake (or warning): where it is, what was expected and got, what to do about it."""

    place: Place
    message: str
    hint: str = ""
    severity: Literal["error", "warning"] = "error"

    def __str__(self) -> str:
        word = "warning: " if self.severity == "warning" else ""
        sentences = ". ".join(part.rstrip(".") for part in (self.message, self.hint) if part)
        return ": ".join(part for part in (str(self.place), word + sentences) if part)


class InputError(Exception):
    """Everything that is wrong with an input, in the order of the text; one line for each problem."""

    def __init__(self, problems: Iterable[Problem]):
        self.problems = in_text_order(problems)
        super().__init__("\n".join(str(problem) for problem in self.problems))

    @classmethod
    def at(cls, place: Place, message: str, hint: str = "") -> InputError:
        """The error with the single problem `message` at `place`."""
        return cls([Problem(place, message, hint)])


def in_text_order(problems: Iterable[Problem]) -> tuple[Problem, ...]:
    """Problems by file, line and column."""
    return tuple(sorted(problems, key=_position))


def _position(problem: Problem) -> tuple[str, int, int]:
    place = problem.place
    return place.file or "", place.line or 0, place.column or 0


def nearest(word: str, known: Iterable[str]) -> str:
    """`did you mean 'spring'?` for the known word closest to `word`, or an empty text when none is close."""
    by_lower_case = {name.lower(): name for name in known}
    found = difflib.get_close_matches(word.lower(), by_lower_case, n=1, cutoff=0.6)
    return f"did you mean '{by_lower_case[found[0]]}'?" if found else ""


def of_family(word: str, known: Iterable[str]) -> str:
    """`did you mean 'a_1' or 'a_2'?` for the words with all parts of `word`, else as `nearest`."""
    names = list(known)
    same = [name for name in names if _parts(name) == _parts(word)]
    family = same or [name for name in names if _parts(word) and all(_is_part(part, name) for part in _parts(word))]
    if len(family) < 2:
        return nearest(word, family or names)
    *others, last = (f"'{name}'" for name in family)
    return f"did you mean {', '.join(others)} or {last}?"


def _parts(name: str) -> list[str]:
    return re.findall(r"[a-z]+|[0-9]+", name.lower())


def _is_part(part: str, name: str) -> bool:
    return any(other.startswith(part) for other in _parts(name))

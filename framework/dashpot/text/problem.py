"""What is wrong, where, and what to do: the one way in which input errors are told."""

from __future__ import annotations

import difflib
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from dashpot.text.name import visible

# more runs than these with the same fault are counted, so that what else is wrong stays on the screen
RUNS_ALIKE = 3
_RUN = re.compile(r"run '[^']*' \([^)]*\)")


@dataclass(frozen=True)
class Place:
    """A place in a file. Lines and columns count from 1; what is unknown is None.

    Examples:
        >>> str(dp.Place("mount.yaml", line=4, column=3))
        'mount.yaml:4:3'
    """

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
    """One mistake (or warning): where it is, what was expected and got, what to do about it.

    Examples:
        >>> str(dp.Problem(dp.Place("mount.yaml"), "expected a stiffness, got '3 kg'", "write it in N/mm"))
        "mount.yaml: expected a stiffness, got '3 kg'. write it in N/mm"
    """

    place: Place
    message: str
    hint: str = ""
    severity: Literal["error", "warning"] = "error"

    def __str__(self) -> str:
        word = "warning: " if self.severity == "warning" else ""
        sentences = ". ".join(part.rstrip(".") for part in (self.message, self.hint) if part)
        return visible(": ".join(part for part in (str(self.place), word + sentences) if part))


class InputError(Exception):
    """Everything that is wrong with a file or an argument; its text is what the command line says.

    ``problems`` are the mistakes one by one, in the order of the text.

    Examples:
        >>> try:
        ...     dp.declare("format: dashpot-network/1\\nname: m\\nbranches: {a: {element: sprin, stiffness: 1 N/mm}}")
        ... except dp.InputError as error:
        ...     wrong = error.problems[0]
        >>> wrong.place.line, wrong.hint
        (3, "did you mean 'spring'?")
    """

    def __init__(self, problems: Iterable[Problem]):
        self.problems = in_text_order(problems)
        super().__init__("\n".join(problem_lines(self.problems)))

    @classmethod
    def at(cls, place: Place, message: str, hint: str = "") -> InputError:
        """The error with the single problem `message` at `place`."""
        return cls([Problem(place, message, hint)])


def problem_lines(problems: Iterable[Problem]) -> Iterator[str]:
    """A line for each problem; where many runs have the same one, the first of them and how many more there are."""
    told = list(problems)
    kinds = [(_RUN.sub("", each.message), each.hint, each.severity) for each in told]
    counts, seen = Counter(kinds), Counter[tuple[str, str, str]]()
    for problem, kind in zip(told, kinds, strict=True):
        seen[kind] += 1
        more = counts[kind] - RUNS_ALIKE if _RUN.match(problem.message) else 0
        if more < 2 or seen[kind] <= RUNS_ALIKE:
            yield str(problem)
        elif seen[kind] == RUNS_ALIKE + 1:
            yield f"... and {more} more runs, of which the same is true"


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

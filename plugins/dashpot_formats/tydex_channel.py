"""A line under **MEASURCHANNELS: name, remark, unit, conversion factor and offsets."""

from __future__ import annotations

import math
from dataclasses import dataclass

from dashpot.contract.reader import ReadingError
from dashpot_formats.unit_words import names_a_unit, plain_unit

# the columns of the format: 1-10 name, 11-40 remark, 41-50 unit, then three numbers in ten columns each
_UNIT, _FACTOR, _END = 40, 50, 80


@dataclass(frozen=True)
class TydexChannel:
    """A measured channel; `line` is where it is declared."""

    name: str
    unit: str
    factor: float
    offsets: tuple[float, float]
    line: int


def read_channel(text: str, line: int) -> TydexChannel:
    """The channel that a line declares. Raises ReadingError when its conversion is none."""
    name, rest = text.split()[0], text.expandtabs()
    numbers = _numbers(rest[_FACTOR:_END]) if _keeps_columns(rest) else None
    unit = rest[_UNIT:_FACTOR]
    if numbers is None:
        unit, numbers = _from_the_right(text.split()[1:])
    factor, first, second = (*numbers, *(1.0, 0.0, 0.0)[len(numbers) :])
    if not all(map(math.isfinite, (factor, first, second))) or factor == 0:
        raise ReadingError(f"the channel '{name}' has no sound conversion factor", "correct it", line)
    return TydexChannel(name, plain_unit(unit), factor, (first, second), line)


def _keeps_columns(text: str) -> bool:
    """Whether the line reaches the unit, which is no number, and no word lies across its beginning or its end."""
    padded = text.ljust(_END)
    whole = all(padded[place - 1] == " " or padded[place] == " " for place in (_UNIT, _FACTOR))
    return len(text.rstrip()) > _UNIT and whole and not _numbers(text[_UNIT:_FACTOR])


def _numbers(text: str) -> list[float] | None:
    try:
        return [float(word) for word in text.split()[:3]]
    except ValueError:
        return None


def _from_the_right(words: list[str]) -> tuple[str, list[float]]:
    """Unit and numbers of a line that does not keep to the columns."""
    numbers: list[float] = []
    while words and len(numbers) < 3 and (found := _numbers(words[-1])):
        numbers.insert(0, found[0])
        words = words[:-1]
    return (words[-1] if words and (numbers or names_a_unit(words[-1])) else ""), numbers

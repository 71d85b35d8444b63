"""How an element is drawn: the symbols of a rheological schematic, alone, in series or in parallel."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from typing import TypeAlias


class Symbol(Enum):
    """What engineers draw. ``BOX`` is a rectangle with the word of the element in it.

    Examples:
        >>> dp.Symbol.SPRING.name
        'SPRING'
    """

    SPRING = auto()
    DASHPOT = auto()
    SLIDER = auto()  # two faces that rub
    INERTER = auto()  # force follows the acceleration between its ends
    TRACK = auto()  # a column of fluid in a channel between two chambers
    GAP = auto()  # two faces that may part and carry no force then
    PLAY = auto()  # free to move between two stops
    FRACTIONAL = auto()  # a spring-pot, between spring and dashpot
    BOX = auto()


@dataclass(frozen=True, init=False)
class Series:
    """Pictures one after the other: all carry the same force. ``Series(Symbol.SPRING, Symbol.DASHPOT)``.

    Examples:
        >>> maxwell = dp.Series(dp.Symbol.SPRING, dp.Symbol.DASHPOT)
        >>> len(maxwell.parts)
        2
    """

    parts: tuple[Picture, ...]

    def __init__(self, *parts: Picture) -> None:
        object.__setattr__(self, "parts", parts)


@dataclass(frozen=True, init=False)
class Parallel:
    """Pictures side by side: all see the same deflection.

    Examples:
        >>> dp.Parallel(maxwell, dp.Symbol.SLIDER).parts[1].name
        'SLIDER'
    """

    parts: tuple[Picture, ...]

    def __init__(self, *parts: Picture) -> None:
        object.__setattr__(self, "parts", parts)


Picture: TypeAlias = Symbol | Series | Parallel

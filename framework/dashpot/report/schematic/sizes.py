"""The measures of a drawing: in points for a picture, in characters for a terminal."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from dashpot.report.schematic.plain import spelt


@dataclass(frozen=True)
class Sizes:
    """Lengths along the force and across it; ``width`` measures a line of text, a bold one on request.

    ``upright`` says that forces run up the page and labels stand beside a symbol; else they run to the right, and
    labels stand above. ``whole`` asks for whole numbers. The name and the lines of a label are joined to lines of up to
    ``filling``, if it is not 0, and spelt in ``ascii_only``.
    """

    upright: bool
    whole: bool
    symbol: float
    half: float
    lead: float
    line: float
    gap: float
    space: float
    support: float
    cell: float
    pad: float
    width: Callable[[str, bool], float]
    filling: float = 0.0
    ascii_only: bool = False

    def label(self, name: str, lines: Sequence[str]) -> tuple[str, tuple[str, ...]]:
        """A name and the lines below it as they are set."""
        if self.ascii_only:
            name, lines = spelt(name), [spelt(line) for line in lines]
        if not self.filling:
            return name, tuple(lines)
        return "", tuple(_filled(filter(None, [name, *lines]), self.filling))

    def extent(self, name: str, lines: Sequence[str]) -> tuple[float, float]:
        """Width and height of a name with lines below it."""
        widths = [self.width(name, True)] if name else []
        widths += [self.width(line, False) for line in lines]
        return max(widths, default=0.0), self.line * len(widths)


def _filled(pieces: Iterable[str], width: float) -> list[str]:
    lines: list[str] = []
    for piece in pieces:
        if lines and columns(lines[-1]) + 2 + columns(piece) <= width:
            lines[-1] += f"  {piece}"
        else:
            lines.append(piece)
    return lines


# classes of characters with the width, in em, that none of them exceeds in DejaVu Sans, the widest face of the style
CLASSES = (
    (frozenset("ilj,.:;|' ·"), 0.36),
    (frozenset('tfrI()[]/-!"²³_'), 0.51),
    (frozenset("=≈+~<>ω∆#"), 0.85),
    (frozenset("mwMWOQGDNHU@%&…→½"), 1.02),
)
POINTS, BOLD_POINTS = 12.0, 13.2


def points(text: str, bold: bool) -> float:
    """A width in points that a line at 12 points does not exceed in any of the faces of a drawing."""
    return sum(map(_em, text)) * (BOLD_POINTS if bold else POINTS)


def _em(character: str) -> float:
    if ord(character) > 0x2E80:
        return 1.1
    known = next((width for signs, width in CLASSES if character in signs), None)
    return known or (0.8 if character.isupper() or ord(character) > 0x250 else 0.66)


def columns(text: str, bold: bool = False) -> int:
    """How many columns of a terminal a text takes."""
    return sum(
        0 if unicodedata.combining(sign) else 2 if unicodedata.east_asian_width(sign) in "WF" else 1 for sign in text
    )


PAPER = Sizes(
    upright=True,
    whole=False,
    symbol=48.0,
    half=14.0,
    lead=6.0,
    line=15.0,
    gap=20.0,
    space=8.0,
    support=26.0,
    cell=24.0,
    pad=8.0,
    width=points,
)
TERMINAL = Sizes(
    upright=False,
    whole=True,
    symbol=5.0,
    half=0.0,
    lead=1.0,
    line=1.0,
    gap=1.0,
    space=1.0,
    support=2.0,
    cell=3.0,
    pad=1.0,
    width=columns,
)

"""Drawings for terminals that know ASCII only: labels spelt out, lines replaced sign by sign."""

from __future__ import annotations

import unicodedata

SPELT = {"≈": "~", "·": "*", "²": "^2", "³": "^3", "…": "..", "µ": "u"}
LINES = str.maketrans("─━│╢╟┤├┌┐└┘┬┴┼┃┠┨╂╱╲▄█●○↔→▒↗", "--|||||+++++++####/\\=#oo=>//")
LETTER = "greek small letter "


def spelt(text: str) -> str:
    """A label with the signs of formulas spelt out; names stay as their author wrote them."""
    return "".join(SPELT.get(sign) or _letter(sign) for sign in text)


def _letter(sign: str) -> str:
    name = unicodedata.name(sign, "").lower()
    return name.removeprefix(LETTER) if name.startswith(LETTER) else sign

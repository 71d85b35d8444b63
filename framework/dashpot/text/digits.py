"""How many digits a number is shown with: significant ones, or those that its interval gives."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TypeGuard

from dashpot.text.quantity import factor, shown_unit

MISSING = "–"
LARGE = 1e7  # is written with an exponent
SMALL = 1e-4  # below this, too
PLACES = 3  # of a length beside the largest of its kind
_TYPESET = {"*": "·", "^2": "²", "^3": "³"}
_MICRO = re.compile(r"(?<![^\s·/(])u(?=[A-Za-z])")


def number(value: float | None, digits: int = 3) -> str:
    """`value` with so many significant digits, without an exponent where that stays readable."""
    if value is None or not math.isfinite(value):
        return MISSING
    if value == 0.0:
        return "0"
    exponent = int(f"{abs(value):.{digits - 1}e}".rpartition("e")[2])
    if not -4 <= exponent <= 6:
        return f"{value:.{digits - 1}e}"
    return f"{value:.{max(0, digits - 1 - exponent)}f}"


def number_within(value: float, interval: Sequence[float] | None, digits: int = 3) -> str:
    """`value` with as many decimals as its interval gives, both in one unit; with `digits` where it has none.

    The half width has one significant digit, two where it begins with a one. What these decimals would show as zero
    is shown with one significant digit.
    """
    if not is_interval(interval) or interval[0] == interval[1] or not abs(value) < LARGE:
        return number(value, digits)
    decimals = decimals_of(interval)
    if 0.0 < abs(value) < SMALL:
        return _small(value, decimals)
    shown = f"{value:.{decimals}f}"
    return number(value, 1) if float(shown) == 0.0 else shown


def _small(value: float, decimals: int) -> str:
    exponent = int(f"{value:e}".rpartition("e")[2])
    return number(value, max(1, decimals + exponent + 1))


def typeset(text: str) -> str:
    """A text with its unit as it is printed: "0.4 N*s/mm" is "0.4 N·s/mm", "45 um" is "45 µm". `si` reads both."""
    for plain, sign in _TYPESET.items():
        text = text.replace(plain, sign)
    return _MICRO.sub("µ", text)


def decimals_of(interval: Sequence[float]) -> int:
    """The decimals that an interval with two different ends gives to its value and to its ends."""
    mantissa, _, exponent = f"{abs(interval[1] - interval[0]) / 2.0:.0e}".rpartition("e")
    return max(0, (1 if mantissa == "1" else 0) - int(exponent))


def rig_unit(unit: str, value: float) -> tuple[float, str]:
    """Factor and name of the unit in which an SI value of this size is shown: 1e-3 and "N/mm" for 220e3 N/m.

    The name is as files have it; `typeset` prints it.
    """
    shown = shown_unit(value, unit or "1")
    return (1.0, "") if shown == "1" else (1.0 / factor(shown, unit)[0], shown)


def quantity(value: float | None, unit: str, digits: int = 3) -> str:
    """An SI value with its unit: "25.8 kN"."""
    return " ".join(shown_with_unit(value, unit, digits)).rstrip()


def shown_with_unit(value: float | None, unit: str, digits: int = 3) -> tuple[str, str]:
    """An SI value and its unit as a reader wants them: ("25.8", "kN")."""
    if value is None or not math.isfinite(value):
        return MISSING, typeset(unit)
    scale, name = rig_unit(unit, value)
    return number(value * scale, digits), typeset(name)


def with_interval(value: float | None, interval: Sequence[float] | None, unit: str, per: str = "") -> str:
    """An SI value and its interval in one unit, with the decimals that the interval gives: "41 N [38, 44]".

    What it is ``per``, and has no unit, stands behind the unit: "5 N per run".
    """
    if value is None or not math.isfinite(value):
        return MISSING
    scale, name = rig_unit(unit, value)
    name = unit_per(typeset(name), per)
    if not is_interval(interval):
        return f"{number(value * scale)} {name}".rstrip()
    ends = sorted(end * scale for end in interval)
    low, high = (number_within(end, ends) for end in ends)
    return f"{number_within(value * scale, ends)} {name}".rstrip() + f" [{low}, {high}]"


def unit_per(unit: str, per: str | None) -> str:
    """A unit per what is counted: "N per run"."""
    return f"{unit} per {per}".lstrip() if per else unit


def is_interval(interval: Sequence[float] | None) -> TypeGuard[Sequence[float]]:
    """Whether these are two ends that are known and finite."""
    return interval is not None and len(interval) == 2 and all(b is not None and math.isfinite(b) for b in interval)


def beside(value: float, largest: float) -> float:
    """`value` rounded to a thousandth of the decade of the `largest` of its kind: what is measured beside 0 is 0."""
    if not largest or not math.isfinite(largest):
        return value
    return round(value, PLACES - math.floor(math.log10(abs(largest)))) + 0.0

"""Numbers as an engineer reads them: significant digits, rig units (mm, N/mm, ms), intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeGuard

MISSING = "–"


def rig_unit(unit: str, value: float) -> tuple[float, str]:
    """Factor and name of the unit in which an SI value of this size is shown: 1e-3 and "N/mm" for 220e3 N/m."""
    from dashpot.text.quantity import factor, pretty

    shown = pretty(value, unit or "1").partition(" ")[2]
    return (1.0 / factor(shown, unit)[0], shown) if shown else (1.0, "")


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


def shown_with_unit(value: float | None, unit: str, digits: int = 3) -> tuple[str, str]:
    """An SI value and its unit as a reader wants them: ("25.8", "kN")."""
    if value is None or not math.isfinite(value):
        return MISSING, unit
    factor, name = rig_unit(unit, value)
    return number(value * factor, digits), name


def quantity(value: float | None, unit: str, digits: int = 3) -> str:
    """An SI value with its unit: "25.8 kN"."""
    return " ".join(shown_with_unit(value, unit, digits)).rstrip()


def set_value(value: float, unit: str) -> str:
    """An SI value somebody set (an amplitude, the edge of a band), without zeros nobody wrote: "0.5 mm"."""
    from dashpot.text.quantity import pretty

    return pretty(value, unit)


def with_interval(value: float | None, interval: Sequence[float] | None, unit: str) -> str:
    """An SI value and its interval, with as many decimals as the interval deserves: "41 N [38, 44]"."""
    if value is None or not math.isfinite(value):
        return MISSING
    factor, name = rig_unit(unit, value)
    if not _is_interval(interval):
        return f"{number(value * factor)} {name}".rstrip()
    low, high = sorted(bound * factor for bound in interval)
    decimals = _decimals(high - low, value * factor)
    shown = f"{value * factor:.{decimals}f} {name}".rstrip()
    return f"{shown} [{low:.{decimals}f}, {high:.{decimals}f}]"


def percent_interval(interval: Sequence[float] | None) -> str | None:
    """(0.71, 0.8) is "71 to 80"."""
    if not _is_interval(interval):
        return None
    low, high = (100.0 * end for end in interval)
    decimals = _decimals(high - low, high)
    return f"{low:.{decimals}f} to {high:.{decimals}f}"


def percent(share: float | None, digits: int = 2) -> str:
    """0.76 is "76 %"."""
    if share is None or not math.isfinite(share):
        return MISSING
    return f"{number(100.0 * share, digits)} %"


def join(words: Sequence[str]) -> str:
    """a, b and c."""
    *head, tail = words
    return f"{', '.join(head)} and {tail}" if head else tail


def _is_interval(interval: Sequence[float] | None) -> TypeGuard[Sequence[float]]:
    return interval is not None and len(interval) == 2 and all(b is not None and math.isfinite(b) for b in interval)


def _decimals(width: float, value: float) -> int:
    # one digit of the half width, two where it starts with a one
    size = width / 2.0 or abs(value) * 1e-3
    if size == 0.0:
        return 0
    mantissa, _, exponent = f"{size:.0e}".rpartition("e")
    return max(0, (1 if mantissa == "1" else 0) - int(exponent))

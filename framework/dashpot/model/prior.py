"""What is known of a parameter before a fit: ``prior: {normal: 60 N/mm, deviation: 5 N/mm}``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from dashpot.text.form import Form, read_quantity
from dashpot.text.quantity import pretty

if TYPE_CHECKING:
    from dashpot.model.values import Kind, Reading

Law = Literal["normal", "lognormal"]
LAWS: tuple[Law, ...] = ("normal", "lognormal")


@dataclass(frozen=True)
class Prior:
    """A normal distribution of a number, with mean ``middle`` and standard ``deviation`` in SI; or a lognormal one.

    Of a lognormal one ``middle`` is the median in SI and ``deviation`` the standard deviation of the natural logarithm,
    so that 0.1 is about 10 %. ``source`` is the file of the fit that it comes from, if it was not written by hand.
    """

    law: Law
    middle: float
    deviation: float
    source: str = ""

    def told(self, unit: str) -> str:
        """The prior in words, for a number in a unit."""
        deviation = f"{100.0 * self.deviation:.3g} %" if self.law == "lognormal" else pretty(self.deviation, unit, 3)
        origin = f", from {self.source}" if self.source else ""
        return f"{self.law} {pretty(self.middle, unit)}, deviation {deviation}{origin}"


def read_prior(form: Form, kind: Kind, reading: Reading) -> Prior | None:
    """``{normal: mean, deviation: ...}`` or ``{lognormal: median, deviation: 10 %}``; mistakes are noted."""
    given = [law for law in LAWS if law in form]
    if len(given) != 1:
        known = ", ".join(form.keys) or "nothing"
        form.complain(
            None,
            f"{form.what}: expected 'normal: MEAN' or 'lognormal: MEDIAN', got {known}",
            "e.g. {normal: 60 N/mm, deviation: 5 N/mm} or {lognormal: 60 N/mm, deviation: 10 %}",
        )
        return None
    [law] = given
    middle = form.take(law, lambda node: read_quantity(reading.pick(node), kind.unit))
    unit = "1" if law == "lognormal" else kind.unit
    deviation = form.take("deviation", lambda node: read_quantity(reading.pick(node), unit))
    form.close()
    if middle is None or deviation is None:
        return None
    if not (0.0 < deviation < math.inf):
        form.complain("deviation", f"{form.what}: expected a deviation above 0, got {deviation:g}", "widen it")
    if law == "lognormal" and middle <= 0.0:
        form.complain(law, f"{form.what}: expected a positive median, got {middle:g} {kind.unit}", "write normal")
    return Prior(law, middle, deviation)

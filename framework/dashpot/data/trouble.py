"""What is wrong with one run, before it is known where that stands in the dataset file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from dashpot.text.problem import Place


@dataclass(frozen=True)
class Trouble:
    """A finding about a run: what it is and what to do. `place` is the key of the dataset file that caused it.

    `fault` names a fault of the measurement itself ("clipping"); empty for what is merely written or read wrong.
    """

    message: str
    hint: str = ""
    place: Place | None = None
    severity: Literal["error", "warning"] = "error"
    fault: str = ""


class Unusable(Exception):
    """A run that has to be set aside, with all the reasons found."""

    def __init__(self, troubles: Iterable[Trouble]):
        self.troubles = tuple(troubles)
        super().__init__("; ".join(trouble.message for trouble in self.troubles))


def refuse(troubles: Iterable[Trouble]) -> None:
    """Raise Unusable when there is any trouble."""
    found = tuple(troubles)
    if found:
        raise Unusable(found)

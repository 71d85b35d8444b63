"""A form of a cause as columns of a matrix."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from dashpot.contract.cause import Cause, Suspect
from dashpot.model.sites import Site


@dataclass(frozen=True, eq=False)
class Candidate:
    """A form of a cause with the place of its columns among all; ``site`` is where in a network with nodes.

    ``twin`` is how many before it have the same form and grid, and differ in what the grid does not have. One that is
    not ``provable`` is a fault that only a data sheet can tell, where there is none: it is a rival of other faults and
    no more.
    """

    cause: type[Cause]
    suspect: Suspect
    columns: slice
    site: Site | None = None
    twin: int = 0
    provable: bool = True

    @property
    def name(self) -> tuple[str, str]:
        """The word of the cause, and the words of the site."""
        return self.cause.word, self.site.words if self.site else ""

    def columns_of(self, things: Collection[str]) -> Iterator[int]:
        """The places of its columns that change one of some things, where forms of the cause change different ones."""
        places = range(self.columns.start, self.columns.stop)
        return (at for at, thing in zip(places, self.suspect.each_of, strict=True) if thing in things)

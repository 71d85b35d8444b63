"""What a result is outside a notebook: a line by itself, its answer and its table where it is printed."""

from __future__ import annotations

from abc import abstractmethod

from dashpot.notebook.listing import Listing


class Printed:
    """A result with an answer in a sentence and a table.

    Dataclasses below it would show every sample; so ``repr`` is one line, and ``print`` gives what a terminal gets.
    """

    @abstractmethod
    def table(self) -> Listing:
        """The table of the result."""

    @property
    @abstractmethod
    def _line(self) -> str:
        """The answer in a line."""

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self._line}>"

    def __str__(self) -> str:
        return f"{self.table()}\n{self._line}"

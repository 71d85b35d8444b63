"""A table in a cell, and as a pandas frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from dashpot.notebook.cell import cell
from dashpot.notebook.promoted import promoted
from dashpot.report.parts import Grid
from dashpot.report.tables import plain_table, to_csv

if TYPE_CHECKING:
    from pandas import DataFrame


class Listing(Grid):
    """A table of a result. In a notebook it shows itself; ``print`` writes it as text.

    Examples:
        >>> table = comparison.table()
        >>> [column.heading for column in table.columns][:3]
        ['model', 'free parameters', 'RMSE train (N)']
        >>> table.to_csv().splitlines()[1].startswith("spring,")
        True
    """

    @classmethod
    def of(cls, grid: Grid) -> Listing:
        """A table of the report as one that shows itself."""
        return promoted(cls, grid)

    def to_pandas(self) -> DataFrame:
        """The table as a pandas frame, numbers unrounded, a heading with its unit for each column.

        ImportError without pandas.
        """
        return frame({column.heading: [row.get(column.key) for row in self.rows] for column in self.columns})

    def to_csv(self) -> str:
        """The table as CSV."""
        return to_csv(self.rows, self.columns)

    def __str__(self) -> str:
        return plain_table(self)

    def _repr_html_(self) -> str:
        return cell(self)


def frame(columns: Mapping[str, Sequence[Any]]) -> DataFrame:
    """The columns as a pandas frame. ImportError, with what to install, without pandas."""
    try:
        import pandas
    except ImportError:
        raise ImportError(
            "expected pandas for a data frame, it is not installed: pip install 'dashpot[pandas]'. "
            "Without it, table() shows and to_csv() writes the same table"
        ) from None
    return pandas.DataFrame(dict(columns))

"""The same tables as CSV, and in the terminal with rich."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dashpot.report.parts import Column, Grid
from dashpot.text.digits import MISSING, number_within, typeset

if TYPE_CHECKING:
    from rich.console import JustifyMethod
    from rich.table import Table

UNIT = "unit"  # the key of a column of units
FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")


def cell_text(column: Column, row: Mapping[str, Any]) -> str:
    """What a reader sees in the cell."""
    value = row.get(column.key)
    if value is None:
        return MISSING
    if isinstance(value, str | int) or column.digits is None:
        return typeset(str(value)) if column.key == UNIT else str(value)
    return number_within(value, row.get(column.interval), column.digits)


def printed_heading(column: Column) -> str:
    """The heading of a column as a reader sees it; a CSV file has `Column.heading`."""
    return f"{column.title} ({typeset(column.unit)})" if column.unit else column.title


def to_csv(rows: Sequence[Mapping[str, Any]], columns: Sequence[Column]) -> str:
    """The table as CSV: headings with units, numbers in full, an empty cell where there is no value.

    A text that a spreadsheet would run as a formula is preceded by an apostrophe.
    """
    lines = io.StringIO()
    writer = csv.writer(lines, lineterminator="\r\n")
    writer.writerow([_harmless(column.heading) for column in columns])
    writer.writerows([_csv_cell(row.get(column.key)) for column in columns] for row in rows)
    return lines.getvalue()


def rich_table(grid: Grid) -> Table:
    """The grid as a table for `rich.console.Console.print`."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(title=Text(grid.title), title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for column in grid.columns:
        # a long name goes on in the next line, a number is never cut
        width = None if column.digits is None else _width(column, grid)
        side: JustifyMethod = "left" if column.digits is None else "right"
        table.add_column(Text(printed_heading(column)), justify=side, overflow="fold", min_width=width)
    for row in grid.rows:
        table.add_row(*(Text(cell_text(column, row)) for column in grid.columns))
    return table


def _width(column: Column, grid: Grid) -> int:
    return max((len(cell_text(column, row)) for row in grid.rows), default=0)


def plain_table(grid: Grid, width: int = 120) -> str:
    """The grid with its caption as plain text, for files and pipes."""
    from rich.console import Console

    lines = io.StringIO()
    console = Console(file=lines, width=width, color_system=None, force_terminal=False)
    console.print(rich_table(grid))
    if grid.caption:
        console.print(grid.caption, markup=False, highlight=False)
    return "\n".join(line.rstrip() for line in lines.getvalue().splitlines()) + "\n"


def _csv_cell(value: Any) -> str:
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if isinstance(value, int | float | np.number):
        return repr(value.item() if isinstance(value, np.generic) else value) if np.isfinite(value) else ""
    return "" if value is None else _harmless(str(value))


def _harmless(text: str) -> str:
    return f"'{text}" if text.startswith(FORMULA_STARTS) else text

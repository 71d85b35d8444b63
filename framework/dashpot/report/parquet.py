"""A table as Parquet, where the extra is installed."""

from __future__ import annotations

import io

import numpy as np

from dashpot.report.parts import Grid
from dashpot.text.problem import InputError, Place


def require_parquet() -> None:
    """InputError, with what to install, without pyarrow."""
    try:
        import pyarrow.parquet  # noqa: F401
    except ImportError:
        raise InputError.at(
            Place("--parquet"),
            "expected pyarrow, it is not installed",
            "pip install 'dashpot[parquet]', or take the CSV file",
        ) from None


def to_parquet(grid: Grid) -> memoryview:
    """The table with headings as in CSV: columns of numbers hold numbers, all others texts."""
    import pyarrow
    from pyarrow.parquet import write_table

    columns = {column.heading: [row.get(column.key) for row in grid.rows] for column in grid.columns}
    table = {
        heading: cells if _numeric(cells) else [None if cell is None else str(cell) for cell in cells]
        for heading, cells in columns.items()
    }
    out = io.BytesIO()
    write_table(pyarrow.table(table), out)
    return out.getbuffer()


def _numeric(cells: list[object]) -> bool:
    return all(cell is None or isinstance(cell, int | float | np.number) for cell in cells)

"""From the lines of a text table to columns of numbers."""

from __future__ import annotations

from dashpot.contract.reader import Table
from dashpot_formats.delimited_columns import read_columns
from dashpot_formats.delimited_header import read_header
from dashpot_formats.delimited_layout import Layout
from dashpot_formats.delimited_lines import Lines
from dashpot_formats.delimited_rows import find_rows
from dashpot_formats.stated_sampling import stated_sampling

# lines above the table that are looked through for the sampling rate
_LONGEST_HEADER = 10_000


def read_table(lines: Lines, layout: Layout) -> Table:
    """The columns of a table under this layout. Raises ReadingError for rows that do not fit it."""
    header = read_header(lines, layout)
    rows = find_rows(lines, layout)
    width = max(layout.width, len(header.names))
    columns, stamps = read_columns(rows, width)
    names = [header.names[index] if index < len(header.names) else str(index + 1) for index in range(width)]
    units = {name: unit for name, unit in zip(header.names, header.units, strict=False) if unit}
    units |= {names[index]: "s" for index in stamps}
    above = lines[max(0, layout.first - _LONGEST_HEADER) : layout.first]
    return Table(dict(zip(names, columns, strict=True)), units, stated_sampling(above), lines=rows.numbers + 1)

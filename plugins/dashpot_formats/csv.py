"""Text tables as rigs write them: comma, semicolon, tab or blanks, decimal comma, headers, units, remarks."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.delimited_header import Header, read_header
from dashpot_formats.delimited_layout import DECIMALS, DELIMITERS, Layout, find_layout, is_comment, is_number, split_row
from dashpot_formats.delimited_text import read_lines
from dashpot_formats.option import check_options, get_option

if TYPE_CHECKING:
    import pandas

_DELIMITER_WORDS = {"tab": "\t", "\\t": "\t", "space": None, "spaces": None, " ": None, "whitespace": None}


class Csv(Reader):
    """Reads a text table; what the file does not make plain can be said under `file_options`.

    delimiter: `,` `;` `tab` `space` ...; decimal: `.` or `,`; encoding; skip_rows: lines to leave out at the top.
    Columns are named by the line above the numbers, whose units may stand in brackets or in a line of their own;
    without names they are called 1, 2, 3, ... A column may hold texts as long as nobody asks for it.
    """

    word = "csv"
    suffixes = (".csv", ".txt", ".tsv", ".dat", ".asc", ".prn", ".log")

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, ("delimiter", "decimal", "encoding", "skip_rows"))
        lines = read_lines(path, get_option(options, "encoding", str, None))
        skipped = get_option(options, "skip_rows", int, 0)
        lines = [""] * skipped + lines[skipped:]
        layout = find_layout(lines, _delimiters(options), _decimals(options))
        return _read_table(lines, layout, read_header(lines, layout))


def _delimiters(options: Mapping[str, object]) -> tuple[str | None, ...]:
    wanted = get_option(options, "delimiter", str, None)
    if wanted is None:
        return DELIMITERS
    delimiter = _DELIMITER_WORDS.get(wanted, wanted)
    if delimiter is not None and len(delimiter) != 1:
        raise ReadingError(f"expected one character as delimiter, got '{wanted}'", "write , ; tab or space")
    return (delimiter,)


def _decimals(options: Mapping[str, object]) -> tuple[str, ...]:
    wanted = get_option(options, "decimal", str, None)
    if wanted is not None and wanted not in DECIMALS:
        raise ReadingError(f"expected . or , as decimal sign, got '{wanted}'", "correct it under file_options")
    return DECIMALS if wanted is None else (wanted,)


def _read_table(lines: list[str], layout: Layout, header: Header) -> Table:
    kept = [
        index
        for index in range(layout.first, len(lines))
        if lines[index].strip() and not is_comment(lines[index], layout.delimiter)
    ]
    rows = [lines[index] for index in kept]
    width = max(layout.width, len(header.names))
    _refuse_long_rows(rows, kept, layout, width)
    frame = _parse(rows, layout, max(width, *(_count(row, layout.delimiter) for row in rows)))
    if len(frame) != len(rows):
        raise ReadingError('a quote (") is opened and not closed', "remove it")
    names = [header.names[index] if index < len(header.names) else str(index + 1) for index in range(width)]
    columns = {name: _values(frame[index], layout.decimal) for index, name in enumerate(names)}
    units = {name: unit for name, unit in zip(header.names, header.units, strict=False) if unit}
    return Table(columns, units, lines=np.array(kept) + 1)


def _parse(rows: list[str], layout: Layout, width: int) -> pandas.DataFrame:
    import pandas

    return pandas.read_csv(
        io.StringIO("\n".join(rows)),
        sep=r"\s+" if layout.delimiter is None else layout.delimiter,
        decimal=layout.decimal,
        header=None,
        names=list(range(width)),
        index_col=False,
        skipinitialspace=True,
        float_precision="round_trip",
        low_memory=False,
        engine="c",
    )


def _count(row: str, delimiter: str | None) -> int:
    return len(row.split()) if delimiter is None else row.count(delimiter) + 1


def _refuse_long_rows(rows: list[str], kept: list[int], layout: Layout, width: int) -> None:
    """More values than columns: a lost line break, say. Lines of text may have any number of words."""
    for index, row in zip(kept, rows, strict=True):
        if _count(row, layout.delimiter) > width:
            cells = split_row(row, layout.delimiter)
            if is_number(cells[0], layout.decimal) and any(cells[width:]):
                message = f"expected {width} values, got {len(cells)}"
                raise ReadingError(message, "correct the line; or name 'delimiter' and 'decimal'", index + 1)


def _values(column: pandas.Series, decimal: str) -> np.ndarray:
    """Numbers (n,), or an object array of numbers and of the texts that are none."""
    import pandas

    if pandas.api.types.is_numeric_dtype(column) and not pandas.api.types.is_bool_dtype(column):
        return column.to_numpy(dtype=float)
    texts = column.astype(object)
    numbers = pandas.to_numeric(texts.astype(str).str.strip().str.replace(decimal, "."), errors="coerce")
    mixed = numbers.to_numpy(dtype=float).astype(object)
    unread = numbers.isna().to_numpy() & ~texts.isna().to_numpy()
    mixed[unread] = [str(text) for text in texts[unread]]
    return mixed

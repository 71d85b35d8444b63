"""Text tables as rigs write them: comma, semicolon, tab or blanks, decimal comma, headers, units, remarks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import zip_longest
from pathlib import Path

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.delimited_header import Header, read_header
from dashpot_formats.delimited_layout import (
    DECIMALS,
    DELIMITERS,
    NO_VALUE,
    Layout,
    find_layout,
    is_comment,
    is_number,
    split_row,
)
from dashpot_formats.delimited_text import read_lines
from dashpot_formats.option import check_options, get_option

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
        if skipped < 0:
            raise ReadingError(f"expected 'skip_rows' as 0 or more, got {skipped}", "it counts lines at the top")
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
    cells = _split_columns([lines[index] for index in kept], layout.delimiter)
    width = max(layout.width, len(header.names))
    _refuse_long_rows(cells, kept, layout, width)
    cells += [[""] * len(kept)] * (width - len(cells))
    names = [header.names[index] if index < len(header.names) else str(index + 1) for index in range(width)]
    columns = {name: _numbers(texts, layout.decimal) for name, texts in zip(names, cells, strict=False)}
    units = {name: unit for name, unit in zip(header.names, header.units, strict=False) if unit}
    return Table(columns, units, lines=np.array(kept) + 1)


def _split_columns(rows: list[str], delimiter: str | None) -> list[Sequence[str]]:
    """The texts of every column. Rows that are all alike, the usual case, are split in one go."""
    widths = {len(row.split(delimiter)) for row in rows}
    if len(widths) == 1 and (delimiter is None or not any('"' in row for row in rows)):
        (width,) = widths
        cells = (delimiter or " ").join(rows).split(delimiter)
        return [cells[index::width] for index in range(width)]
    return list(zip_longest(*(split_row(row, delimiter) for row in rows), fillvalue=""))


def _refuse_long_rows(cells: list[Sequence[str]], kept: list[int], layout: Layout, width: int) -> None:
    """More values than columns: a lost line break, say. Lines of text may have any number of words."""
    for column in cells[width:]:
        for row, text in enumerate(column):
            if text.strip() and is_number(cells[0][row].strip(), layout.decimal):
                count = sum(bool(other[row].strip()) for other in cells)
                message = f"expected {width} values, got {count}"
                raise ReadingError(message, "correct the line; or name 'delimiter' and 'decimal'", kept[row] + 1)


def _numbers(texts: Sequence[str], decimal: str) -> np.ndarray:
    """Numbers (n,), or an object array of numbers and of the texts that are none; what is empty is NaN."""
    together = "\n".join(texts)
    if "_" not in together and not (decimal == "," and "." in together):
        try:
            return np.array(together.replace(decimal, ".").split("\n"), dtype=float)
        except ValueError:
            pass
    values = [_number(text, decimal) for text in texts]
    mixed = any(isinstance(value, str) for value in values)
    return np.array(values, dtype=object if mixed else float)


def _number(text: str, decimal: str) -> float | str:
    text = text.strip()
    if is_number(text, decimal):
        return float(text.replace(decimal, "."))
    return float("nan") if text.lower() in NO_VALUE else text

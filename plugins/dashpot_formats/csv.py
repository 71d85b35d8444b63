"""Text tables as rigs write them: comma, semicolon, tab or blanks, decimal comma, headers, units, remarks."""

from __future__ import annotations

import re
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
from dashpot_formats.stated_sampling import stated_sampling
from dashpot_formats.time_stamps import is_stamp, seconds

# lines above the table that are looked through for the sampling rate
_LONGEST_HEADER = 10_000
# a table may have so many times as many places as there are values, beyond a small one
_SPARSEST, _SMALL = 10, 100_000

_DELIMITER_WORDS = {"tab": "\t", "\\t": "\t", "space": None, "spaces": None, " ": None, "whitespace": None}


class Csv(Reader):
    """Reads a text table as measuring programs export it; what it does not make plain goes under `file_options`.

    delimiter: `,` `;` `tab` `space` `|` ...; decimal: `.` or `,`; encoding; skip_rows: lines to leave out at the top.
    Columns are named by a line above the numbers, whose units may stand in brackets or in a line of their own; without
    names they are called 1, 2, 3, ... Dates and times of day become seconds since the first row. A sampling rate that
    the lines above state is used where no time is declared. A column may hold texts as long as nobody asks for it.
    """

    word = "csv"
    suffixes = (".csv", ".txt", ".tsv", ".dat", ".asc", ".prn", ".log", ".lvm")

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
    cells = _split_columns([lines[index] for index in kept], layout.delimiter, kept)
    width = max(layout.width, len(header.names))
    _refuse_long_rows(cells, kept, layout, width)
    cells += [[""] * len(kept)] * (width - len(cells))
    names = [header.names[index] if index < len(header.names) else str(index + 1) for index in range(width)]
    columns = {name: _numbers(texts, layout.decimal) for name, texts in zip(names, cells, strict=False)}
    units = {name: unit for name, unit in zip(header.names, header.units, strict=False) if unit}
    for name, texts in zip(names, cells, strict=False):
        stamps = seconds(texts) if columns[name].dtype == object and is_stamp(texts[0]) else None
        if stamps is not None:
            columns[name], units[name] = stamps, "s"
    above = lines[max(0, layout.first - _LONGEST_HEADER) : layout.first]
    return Table(columns, units, stated_sampling(above), lines=np.array(kept) + 1)


def _split_columns(rows: list[str], delimiter: str | None, kept: list[int]) -> list[Sequence[str]]:
    """The texts of every column. Rows that are all alike, the usual case, are split in one go."""
    widths = {len(row.split(delimiter)) for row in rows}
    if len(widths) == 1 and (delimiter is None or not any('"' in row for row in rows)):
        (width,) = widths
        cells = (delimiter or " ").join(rows).split(delimiter)
        return [cells[index::width] for index in range(width)]
    split = [split_row(row, delimiter) for row in rows]
    _refuse_endless_row(split, kept)
    return list(zip_longest(*split, fillvalue=""))


def _refuse_endless_row(rows: list[list[str]], kept: list[int]) -> None:
    """A lost line break makes a row so long that a table as wide as it would not fit anywhere."""
    lengths = [len(row) for row in rows]
    widest = max(lengths)
    if widest * len(rows) > _SPARSEST * (sum(lengths) + _SMALL):
        usual = sorted(lengths)[len(lengths) // 2]
        line = kept[lengths.index(widest)] + 1
        raise ReadingError(f"expected about {usual} values, got {widest}", "a line break is missing: correct it", line)


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
            return np.array(_with_plain_signs(together, decimal).split("\n"), dtype=float)
        except ValueError:
            pass
    values = [_number(text, decimal) for text in texts]
    mixed = any(isinstance(value, str) for value in values)
    return np.array(values, dtype=object if mixed else float)


def _with_plain_signs(text: str, decimal: str) -> str:
    """Decimal points, and `E` before exponents, which Fortran writes as `D`."""
    plain = text.replace(decimal, ".")
    return re.sub(r"(?<=[0-9.])[dD](?=[-+]?[0-9])", "E", plain) if "D" in plain or "d" in plain else plain


def _number(text: str, decimal: str) -> float | str:
    text = text.strip()
    plain = _without_thousands(text, decimal)
    if is_number(plain, decimal):
        return float(_with_plain_signs(plain, decimal))
    return float("nan") if text.lower() in NO_VALUE else text


def _without_thousands(text: str, decimal: str) -> str:
    """`1.234,5` with a decimal comma is beyond doubt; `1.234` alone is not, and stays a text."""
    group = re.escape("," if decimal == "." else ".")
    written = re.fullmatch(rf"[-+]?[0-9]{{1,3}}({group}[0-9]{{3}})+{re.escape(decimal)}[0-9]+", text)
    return re.sub(group, "", text) if written else text

"""From the lines of a text table to columns of numbers."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import zip_longest

import numpy as np

from dashpot.contract.reader import ReadingError, Table
from dashpot_formats.delimited_header import Header, read_header
from dashpot_formats.delimited_layout import NO_VALUE, Layout, comment_signs, is_number, split_row
from dashpot_formats.stated_sampling import stated_sampling
from dashpot_formats.time_stamps import is_stamp, seconds

# lines above the table that are looked through for the sampling rate
_LONGEST_HEADER = 10_000
# a table may have so many times as many places as there are values, beyond a small one
_SPARSEST, _SMALL = 10, 100_000


def read_table(lines: list[str], layout: Layout) -> Table:
    """The columns of a table under this layout. Raises ReadingError for rows that do not fit it."""
    return _with_header(lines, layout, read_header(lines, layout))


def _with_header(lines: list[str], layout: Layout, header: Header) -> Table:
    remarks = comment_signs(layout.delimiter)
    kept = [
        index
        for index in range(layout.first, len(lines))
        if (text := lines[index].lstrip()) and not text.startswith(remarks)
    ]
    cells = _split_columns([lines[index] for index in kept], layout.delimiter, kept)
    width = max(layout.width, len(header.names))
    _refuse_long_rows(cells, kept, layout, width)
    cells += [[""] * len(kept)] * (width - len(cells))
    names = [header.names[index] if index < len(header.names) else str(index + 1) for index in range(width)]
    columns = {name: numbers_of(texts, layout.decimal) for name, texts in zip(names, cells, strict=False)}
    units = {name: unit for name, unit in zip(header.names, header.units, strict=False) if unit}
    for name, texts in zip(names, cells, strict=False):
        stamps = seconds(texts) if columns[name].dtype == object and is_stamp(texts[0]) else None
        if stamps is not None:
            columns[name], units[name] = stamps, "s"
    above = lines[max(0, layout.first - _LONGEST_HEADER) : layout.first]
    return Table(columns, units, stated_sampling(above), lines=np.array(kept) + 1)


def _split_columns(rows: list[str], delimiter: str | None, kept: list[int]) -> list[Sequence[str]]:
    """The texts of every column. Rows that are all alike, the usual case, are split in one go."""
    together = (delimiter or " ").join(rows)
    widths = {row.count(delimiter) + 1 if delimiter else len(row.split()) for row in rows}
    if len(widths) == 1 and (delimiter is None or '"' not in together):
        (width,) = widths
        cells = together.split(delimiter)
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


def numbers_of(texts: Sequence[str], decimal: str) -> np.ndarray:
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

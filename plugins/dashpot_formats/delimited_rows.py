"""The rows of a text table: which lines they are, and their cells, block by block."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.reader import ReadingError
from dashpot_formats.delimited_layout import Layout, comment_signs, is_number, split_row
from dashpot_formats.delimited_lines import Lines

# a table may have so many times as many places as there are values, beyond a small one
_SPARSEST, _SMALL = 10, 100_000


@dataclass(frozen=True, eq=False)
class Rows:
    """The lines that are rows of a table, by their numbers (n,) from 0, and how many values each has (n,)."""

    lines: Lines
    layout: Layout
    numbers: NDArray[np.int64]
    lengths: NDArray[np.int64]

    @property
    def size(self) -> int:
        """How many there are."""
        return self.numbers.size

    def blocks(self, width: int) -> Iterator[tuple[int, list[Sequence[str]]]]:
        """The texts of at least ``width`` columns, for some rows on end, with the number of the first of these rows."""
        for first, block in self.lines.blocks(self.layout.first):
            start, stop = np.searchsorted(self.numbers, (first, first + len(block)))
            if start < stop:
                own = [block[index] for index in (self.numbers[start:stop] - first).tolist()]
                cells = self._columns(own, self.lengths[start:stop])
                yield int(start), cells + [[""] * len(own)] * (width - len(cells))

    def _columns(self, rows: list[str], lengths: NDArray[np.int64]) -> list[Sequence[str]]:
        """The cells by column. Rows that are all alike, the usual case, are split in one go."""
        delimiter, width = self.layout.delimiter, int(lengths.max())
        together = (delimiter or " ").join(rows)
        if lengths.min() == width and (delimiter is None or '"' not in together):
            cells = together.split(delimiter)
            return [cells[index::width] for index in range(width)]
        return list(zip_longest(*(split_row(row, delimiter) for row in rows), fillvalue=""))


def find_rows(lines: Lines, layout: Layout) -> Rows:
    """The rows from the first one on, without remarks and empty lines. Raises ReadingError for one without an end."""
    remarks, delimiter = comment_signs(layout.delimiter), layout.delimiter
    numbers, lengths = [], []
    for first, block in lines.blocks(layout.first):
        own = [index for index, line in enumerate(block) if (text := line.lstrip()) and not text.startswith(remarks)]
        numbers.append(first + np.array(own, dtype=np.int64))
        lengths.append(np.array(_lengths([block[index] for index in own], delimiter), dtype=np.int64))
    rows = Rows(lines, layout, np.concatenate(numbers), np.concatenate(lengths))
    _refuse_endless_row(rows)
    return rows


def _lengths(rows: Sequence[str], delimiter: str | None) -> list[int]:
    """How many values each row has."""
    if delimiter is None or any('"' in row for row in rows):
        return [len(split_row(row, delimiter)) for row in rows]
    return [row.count(delimiter) + 1 for row in rows]


def _refuse_endless_row(rows: Rows) -> None:
    """A lost line break makes a row so long that a table as wide as it would not fit anywhere."""
    lengths = rows.lengths
    widest = int(lengths.max())
    if widest * lengths.size > _SPARSEST * (int(lengths.sum()) + _SMALL):
        usual = int(np.sort(lengths)[lengths.size // 2])
        line = int(rows.numbers[np.argmax(lengths)]) + 1
        raise ReadingError(f"expected about {usual} values, got {widest}", "a line break is missing: correct it", line)


class LongRow(NamedTuple):
    """A row with values beyond the width of the table: the column of the first of them, the row, how many it has."""

    column: int
    row: int
    values: int


def find_long_row(cells: Sequence[Sequence[str]], start: int, width: int, decimal: str) -> list[LongRow]:
    """The row, if there is one, that begins with a number and has a value beyond the width: a lost line break, say.

    ``start`` is the first row of these cells. Of several it is the one in the first column. Lines of text may have any
    number of words.
    """
    for index, column in enumerate(cells[width:], width):
        for row, text in enumerate(column):
            if text.strip() and is_number(cells[0][row].strip(), decimal):
                return [LongRow(index, start + row, sum(bool(other[row].strip()) for other in cells))]
    return []

"""Where the numbers of a text table are: delimiter, decimal sign, first row."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.reader import ReadingError
from dashpot_formats.delimited_lines import Lines

# in the order of preference where several read a file alike; None stands for any white space
DELIMITERS: tuple[str | None, ...] = ("\t", ";", ",", "|", None)
DECIMALS = (".", ",")

_NUMBER = {
    ".": re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eEdD][-+]?[0-9]+)?"),
    ",": re.compile(r"[-+]?([0-9]+|[0-9]*,[0-9]+)([eEdD][-+]?[0-9]+)?"),
}
# what stands where there is no number
NO_VALUE = {"", "nan", "na", "n/a", "inf", "-inf", "+inf", "null"}
_COMMENT_SIGNS = ("#", "%", "//", "!")
_SAMPLE = 60
_ROWS_ON_END = 3


@dataclass(frozen=True)
class Layout:
    """How the rows of a table are written; `first` is the line (from 0) of the first row, `width` the usual length."""

    delimiter: str | None
    decimal: str
    first: int
    width: int


def comment_signs(delimiter: str | None) -> tuple[str, ...]:
    """What a line begins with that is a remark."""
    return _COMMENT_SIGNS if delimiter == ";" else (*_COMMENT_SIGNS, ";")


def is_comment(line: str, delimiter: str | None) -> bool:
    """Whether a line is a remark."""
    return line.lstrip().startswith(comment_signs(delimiter))


def uncomment(line: str) -> str:
    """A line without the signs that make it a remark."""
    return line.lstrip().lstrip("#%/!;").strip()


def split_row(line: str, delimiter: str | None) -> list[str]:
    """The values of a line, without quotes and white space around them."""
    if delimiter is None:
        return line.split()
    if '"' in line:
        return _split_quoted(line, delimiter)
    return [part.strip() for part in line.split(delimiter)]


def _split_quoted(line: str, delimiter: str) -> list[str]:
    try:
        return [part.strip() for part in next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))]
    except csv.Error as error:
        raise ReadingError(f"a line with quotes cannot be split: {error}", "remove the quotes") from None


def is_number(text: str, decimal: str) -> bool:
    """Whether a value is a number with this decimal sign."""
    return _NUMBER[decimal].fullmatch(text) is not None


def find_layout(lines: Lines, delimiters: Sequence[str | None], decimals: Sequence[str]) -> Layout:
    """The layout under which the rows hold most numbers. Raises ReadingError when there is no table of numbers."""
    filled = _filled_lines(lines)
    sample = _sample(lines, filled)
    choices = [(delimiter, decimal) for delimiter in delimiters for decimal in decimals]
    if not sample:
        raise ReadingError("it holds no rows", "check that this is the file of the measurement")
    delimiter, decimal = max(choices, key=lambda choice: _score(sample, *choice))
    wider = _wider(sample, [lines[index] for index in filled[-_SAMPLE:]], delimiter, decimal)
    rows = [split_row(line, delimiter) for line in wider if not is_comment(line, delimiter)]
    if not any(is_number(cell, decimal) for row in rows for cell in row):
        raise ReadingError("it holds no table of numbers", "check that this is the file of the measurement")
    columns = _number_columns(rows, decimal)
    width = Counter(_filled(row) for row in rows).most_common(1)[0][0]
    return Layout(delimiter, decimal, _first_row(lines, delimiter, decimal, columns), width)


def _filled_lines(lines: Lines) -> NDArray[np.int64]:
    """The numbers (from 0) of the lines that hold anything."""
    found = [
        np.array([index for index, line in enumerate(block, first) if line.strip()], dtype=np.int64)
        for first, block in lines.blocks()
    ]
    return np.concatenate(found)


def _sample(lines: Lines, filled: NDArray[np.int64]) -> list[str]:
    """Lines spread over the second half of the file, where headers are past, and its last ones."""
    half = filled[filled.size // 2 :]
    chosen = np.concatenate([half[:: max(1, half.size // _SAMPLE)], filled[-_SAMPLE // 2 :]])
    return [lines[index] for index in chosen]


def _wider(sample: Sequence[str], last: Sequence[str], delimiter: str | None, decimal: str) -> Sequence[str]:
    """The last lines alone where they hold more numbers a line: the header is longer than the table."""

    def numbers(lines: Sequence[str]) -> float:
        counts = [sum(is_number(cell, decimal) for cell in split_row(line, delimiter)) for line in lines]
        return sorted(counts)[len(counts) // 2]

    return last if numbers(last) > numbers(sample) else sample


def _score(sample: Sequence[str], delimiter: str | None, decimal: str) -> float:
    score = 0.0
    for line in sample:
        for cell in split_row(line, delimiter):
            score += 1.0 if is_number(cell, decimal) else -0.2 * bool(cell)
    return score


def _number_columns(rows: Sequence[list[str]], decimal: str) -> list[int]:
    counts = Counter(index for row in rows for index, cell in enumerate(row) if is_number(cell, decimal))
    most = max(counts.values())
    return [index for index, count in counts.items() if count > 0.5 * most]


def _filled(row: list[str]) -> int:
    """The values of a row up to the last one that is not empty."""
    return max((index + 1 for index, cell in enumerate(row) if cell), default=0)


def _first_row(lines: Lines, delimiter: str | None, decimal: str, columns: list[int]) -> int:
    """The first line with numbers in most columns, or the first of three rows on end, gaps and all."""
    sparse: list[int] = []
    for index, line in enumerate(lines):
        if not line.strip() or is_comment(line, delimiter):
            continue
        count = _count_numbers(split_row(line, delimiter), decimal, columns)
        if 2 * count > len(columns):
            return sparse[0] if sparse else index
        sparse = [*sparse, index] if count else []
        if len(sparse) == _ROWS_ON_END:
            return sparse[0]
    if sparse:
        return sparse[0]
    raise ReadingError("no row holds numbers in all its columns", "name 'delimiter' and 'decimal' under file_options")


def _count_numbers(row: Sequence[str], decimal: str, columns: list[int]) -> int:
    """How many of these columns hold numbers; 0 when one holds something else than a number or nothing."""
    cells = [row[column] if column < len(row) else "" for column in columns]
    numbers = [is_number(cell, decimal) for cell in cells]
    sound = all(good or cell.lower() in NO_VALUE for good, cell in zip(numbers, cells, strict=True))
    return sum(numbers) if sound else 0

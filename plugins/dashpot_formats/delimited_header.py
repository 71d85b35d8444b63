"""The names and units above a text table."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dashpot.contract.reader import ReadingError
from dashpot.text.quantity import is_unit
from dashpot_formats.delimited_layout import DELIMITERS, Layout, is_comment, is_number, split_row, uncomment

_BRACKETED = re.compile(r"(?P<name>.*\S)\s*[\[(<{](?P<unit>[^\[\](){}<>]*)[\])>}]")
_FRACTION = re.compile(r"(?P<name>.*\S)\s+/\s+(?P<unit>\S+)|(?P<name2>.*\S)\s+in\s+(?P<unit2>\S+)")
_LOOK_BACK = 30


@dataclass(frozen=True)
class Header:
    """Names of the columns, in order, and the units stated for some; no names where the file has none."""

    names: tuple[str, ...] = ()
    units: tuple[str, ...] = ()


def read_header(lines: Sequence[str], layout: Layout) -> Header:
    """The header above the first row. Raises ReadingError when it clearly does not fit the rows."""
    above = list(_lines_above(lines, layout))
    for index, (number, line) in enumerate(above):
        cells = _split_names(line, layout)
        if cells is None:
            continue
        higher = next(filter(None, (_split_names(other, layout) for _, other in above[index + 1 :])), None)
        if higher and _is_unit_row(cells):
            return _header(higher, [cell.strip("[](){}<>") for cell in cells])
        _refuse_broken_row(cells, higher, layout, number)
        return _header(*_names_with_units(cells))
    _refuse_misfit(above, layout)
    return Header()


def _lines_above(lines: Sequence[str], layout: Layout) -> Iterator[tuple[int, str]]:
    """Numbers and texts of the lines above the first row, nearest first; remarks come last."""
    nearby = range(layout.first - 1, max(-1, layout.first - 1 - _LOOK_BACK), -1)
    filled = [index for index in nearby if lines[index].strip()]
    for remark in (False, True):
        for index in filled:
            if is_comment(lines[index], layout.delimiter) is remark:
                yield index + 1, lines[index]


def _split_names(line: str, layout: Layout) -> list[str] | None:
    """The cells of a header line, None when it does not have one for every column."""
    own = () if layout.delimiter is None else (layout.delimiter,)
    remark = is_comment(line, layout.delimiter)
    for delimiter in dict.fromkeys((*own, *DELIMITERS)):
        cells = _split(uncomment(line) if remark else line, delimiter)
        fits = len(cells) == layout.width or (
            len(cells) > layout.width and delimiter == layout.delimiter and not remark
        )
        if fits and not all(is_number(cell, layout.decimal) for cell in cells):
            return cells
    return None


def _split(line: str, delimiter: str | None) -> list[str]:
    cells = _join_brackets(line.split()) if delimiter is None else split_row(line, delimiter)
    while cells and not cells[-1]:
        cells.pop()
    return cells


def _join_brackets(words: list[str]) -> list[str]:
    """A bracketed unit belongs to the word before it: `F [N]` is one cell."""
    cells: list[str] = []
    for word in words:
        if cells and word[0] in "[(" and word[-1] in "])":
            cells[-1] += " " + word
        else:
            cells.append(word)
    return cells


def _is_unit_row(cells: Sequence[str]) -> bool:
    filled = [cell for cell in cells if cell and cell != "-"]
    known = [cell for cell in filled if cell[0] in "[(" or is_unit(cell)]
    return len(known) > 0.5 * len(filled)


def _names_with_units(cells: Sequence[str]) -> tuple[list[str], list[str]]:
    pairs = [_name_and_unit(cell) for cell in cells]
    return [name for name, _ in pairs], [unit for _, unit in pairs]


def _name_and_unit(cell: str) -> tuple[str, str]:
    match = _BRACKETED.fullmatch(cell)
    if match:
        return match["name"], match["unit"].strip()
    match = _FRACTION.fullmatch(cell)
    name, unit = (match["name"] or match["name2"], match["unit"] or match["unit2"]) if match else (cell, "")
    return (name, unit) if unit and is_unit(unit) else (cell, "")


def _header(names: Sequence[str], units: Sequence[str]) -> Header:
    count = Counter(names)
    distinct = [
        name if name and count[name] == 1 else f"{name} (column {index})".strip() for index, name in enumerate(names, 1)
    ]
    return Header(tuple(distinct), tuple(unit if unit != "-" else "" for unit in units))


def _refuse_broken_row(cells: Sequence[str], higher: list[str] | None, layout: Layout, line: int) -> None:
    """A line with numbers below a proper header is no header but a row that cannot be read."""
    numbers = sum(is_number(cell, layout.decimal) for cell in cells)
    if higher and numbers and not any(is_number(cell, layout.decimal) for cell in higher):
        wrong = next(cell for cell in cells if not is_number(cell, layout.decimal))
        raise ReadingError(f"expected a number, got '{wrong}'", "correct it, or leave lines out with 'skip_rows'", line)


def _refuse_misfit(above: Sequence[tuple[int, str]], layout: Layout) -> None:
    """`t,x,F` above `0,001,1,5,20,3`: the comma is the decimal sign as well as the delimiter."""
    if layout.delimiter != "," or not above:
        return
    line, text = above[0]
    names = [cell for cell in split_row(text, ",") if cell]
    if len(names) > 1 and len(names) < layout.width <= 2 * len(names):
        message = f"the header names {len(names)} columns, but the rows below have {layout.width} values"
        hint = "save it with ';' between the values if the comma is the decimal sign, or 'skip_rows' the header"
        raise ReadingError(message, hint, line)

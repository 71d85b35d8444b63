"""The names and units above a text table."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from dashpot.contract.reader import ReadingError
from dashpot_formats.delimited_layout import DELIMITERS, Layout, is_comment, is_number, split_row, uncomment
from dashpot_formats.distinct import distinct
from dashpot_formats.unit_words import names_a_unit, plain_unit

_BRACKETED = re.compile(r"(?P<name>.*\S)\s*[\[(<{](?P<unit>[^\[\](){}<>]*)[\])>}]")
# `Kraft/kN` after ISO 80000, `Kraft / kN`, `Kraft in kN`
_DIVIDER = re.compile(r"\s*/\s*|\s+in\s+")
_LOOK_BACK = 30
_LONGEST_NAME = 300

# what stands in the first cell of a line of units, and what a line of data types is made of
_UNIT_LABELS = {"unit", "units", "einheit", "einheiten", "y_unit_label", "[unit]", "kanaleinheit", "channel unit"}
_DATA_TYPES = re.compile(r"(u?int|float|real|double|single|byte|word|string|char|dt|ieee)[0-9]*", re.IGNORECASE)


@dataclass(frozen=True)
class Header:
    """Names of the columns, in order, and the units stated for some; no names where the file has none."""

    names: tuple[str, ...] = ()
    units: tuple[str, ...] = ()


def read_header(lines: Sequence[str], layout: Layout) -> Header:
    """The header above the first row. Raises ReadingError when it clearly does not fit the rows."""
    above = list(_lines_above(lines, layout))
    candidates = [(number, cells) for number, line in above if (cells := _split_names(line, layout))]
    for index, (number, cells) in enumerate(candidates):
        higher = candidates[index + 1][1] if index + 1 < len(candidates) else None
        if higher and _is_unit_row(cells):
            return _header(higher, _units_of(cells))
        _refuse_broken_row(cells, higher, layout, number)
        return _names_above(cells, [other for _, other in candidates[index + 1 :]])
    _refuse_misfit(above, layout)
    return Header()


def _names_above(nearest: Sequence[str], higher: Sequence[Sequence[str]]) -> Header:
    """Names with their units in brackets; else the nearest line, and the units from a line above it."""
    for cells in (nearest, *higher):
        names, units = _names_with_units(cells)
        if 2 * sum(map(bool, units)) >= len(cells):
            return _header(names, units)
    names, units = _names_with_units(nearest)
    if not any(units):
        labelled = [cells for cells in higher if _label(cells[0]) in _UNIT_LABELS]
        rows = [cells for cells in higher[:1] if _is_unit_row(cells)] + labelled
        units = _units_of(rows[0]) if rows else units
    return _header(names, units)


def _label(cell: str) -> str:
    return cell.lower().rstrip(":")


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
    remark = is_comment(line, layout.delimiter)
    text = uncomment(line) if remark else line
    own = () if layout.delimiter is None else (layout.delimiter,)
    for delimiter in dict.fromkeys((*own, *DELIMITERS)):
        for cells in _splittings(text, delimiter):
            longer = len(cells) > layout.width and delimiter is not None and delimiter == layout.delimiter
            if (len(cells) == layout.width or (longer and not remark)) and _are_names(cells, layout):
                return cells
    return None


def _are_names(cells: Sequence[str], layout: Layout) -> bool:
    alike = len(cells) > 1 and len(set(cells)) == 1
    if alike or all(_DATA_TYPES.fullmatch(cell) for cell in cells):
        return False
    return not all(is_number(cell, layout.decimal) for cell in cells)


def _splittings(text: str, delimiter: str | None) -> Iterator[list[str]]:
    """The ways to take a header line apart. Between blanks a name may have blanks of its own."""
    if delimiter is not None:
        yield _without_empty_end(split_row(text, delimiter))
        return
    yield _join_brackets(text.split())
    if '"' in text:
        yield _without_empty_end(split_row(text.strip(), " "))
    yield re.split(r"\s{2,}|\t", text.strip())


def _without_empty_end(cells: list[str]) -> list[str]:
    while cells and not cells[-1]:
        cells.pop()
    return cells


def _join_brackets(words: list[str]) -> list[str]:
    """A bracketed unit belongs to the word before it: `F [N]` is one cell."""
    cells: list[str] = []
    for word in words:
        if cells and _is_bracketed(word) and not _is_bracketed(cells[-1]):
            cells[-1] += " " + word
        else:
            cells.append(word)
    return cells


def _is_bracketed(word: str) -> bool:
    return word[0] in "[(" and word[-1] in "])"


def _is_unit_row(cells: Sequence[str]) -> bool:
    if _label(cells[0]) in _UNIT_LABELS:
        return True
    filled = [cell for cell in cells if cell and cell != "-"]
    known = [cell for cell in filled if cell[0] in "[(" or names_a_unit(cell)]
    return len(known) > 0.5 * len(filled)


def _units_of(cells: Sequence[str]) -> list[str]:
    return ["" if _label(cell) in _UNIT_LABELS else plain_unit(cell) for cell in cells]


def _names_with_units(cells: Sequence[str]) -> tuple[list[str], list[str]]:
    pairs = [_name_and_unit(cell) for cell in cells]
    return [name for name, _ in pairs], [unit for _, unit in pairs]


def _name_and_unit(cell: str) -> tuple[str, str]:
    if len(cell) > _LONGEST_NAME:
        return cell, ""
    match = _BRACKETED.fullmatch(cell)
    if match:
        return match["name"].rstrip(" /"), plain_unit(re.sub(r"^\s*in\s+", "", match["unit"]))
    for divider in _DIVIDER.finditer(cell):
        name, unit = cell[: divider.start()], cell[divider.end() :]
        if name and names_a_unit(unit) and not (divider[0] == "/" and _ends_in_unit(name, unit)):
            return name, plain_unit(unit)
    return cell, ""


def _ends_in_unit(name: str, below: str) -> bool:
    """Whether a slash belongs to a unit that begins before it: `Speed mm/s`."""
    last = re.split(r"[\s_]", name)[-1]
    return names_a_unit(f"{last}/{below}")


def _header(names: Sequence[str], units: Sequence[str]) -> Header:
    return Header(tuple(distinct(names, "column")), tuple(units))


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

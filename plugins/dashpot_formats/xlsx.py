"""Workbooks of Excel (.xlsx), with the library openpyxl in a process of its own."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot.text.problem import nearest
from dashpot_formats.apart import read_apart
from dashpot_formats.delimited_layout import find_layout
from dashpot_formats.delimited_lines import LONE, Lines
from dashpot_formats.delimited_table import read_table
from dashpot_formats.extra import require
from dashpot_formats.option import check_options, get_option

_BETWEEN = "\t"
# a sheet with fewer is no measurement
_FEWEST_ROWS = 16
# cells `-1,5` and `1.234,5`; a cell `1,234.5`
_COMMA = re.compile(r"(?<![^\t])([-+]?(?:\d{1,3}(?:\.\d{3})+|\d*)),(\d+(?:[eE][-+]?\d+)?)(?![^\t])")
_THOUSANDS = re.compile(r"(?<![^\t])[-+]?\d{1,3}(,\d{3})+\.\d")


class Xlsx(Reader):
    """Reads a sheet as the table that it shows: names, units in brackets or in a row of their own, numbers.

    Formulas count with the values that were saved with them, numbers kept as texts also with a decimal comma. Without
    the option `sheet` (a name, or a number counted from 1) it is the sheet with the most rows of numbers.
    """

    word = "xlsx"
    suffixes = (".xlsx", ".xlsm")
    extra = "excel"
    options = {
        "sheet": "its name, or its number counted from 1",
    }

    def __init__(self) -> None:
        self._last: tuple[object, Mapping[str, list[str]]] = None, {}

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        sheets = self._sheets(path)
        text = "\n".join(_with_points(sheets[_chosen(sheets, options.get("sheet"))]))
        lines = Lines(text.encode("utf-8", LONE))
        return read_table(lines, find_layout(lines, (_BETWEEN,), (".",)))

    def parts(self, path: Path) -> Sequence[Mapping[str, object]]:
        """The sheets of numbers; no choice where there is one of them or none."""
        sheets = self._sheets(path)
        found = [name for name, lines in sheets.items() if _rows_of_numbers(lines) >= _FEWEST_ROWS]
        return [{"sheet": name} for name in found] if len(found) > 1 else [{}]

    def _sheets(self, path: Path) -> Mapping[str, list[str]]:
        """The lines of all sheets; those of the last workbook are kept, as one sheet is read after the other."""
        require("openpyxl", self.extra, "Excel workbooks")
        found = path.stat()
        state = path, found.st_mtime_ns, found.st_size
        if self._last[0] != state:
            self._last = state, read_apart(read_sheets, path, "Excel workbook").notes["sheets"]
        return self._last[1]


def _chosen(sheets: Mapping[str, Sequence[str]], wanted: object) -> str:
    names = list(sheets)
    if wanted is None:
        return max(names, key=lambda name: _rows_of_numbers(sheets[name]))
    if isinstance(wanted, int) and not isinstance(wanted, bool):
        if not 1 <= wanted <= len(names):
            raise ReadingError(f"it has {len(names)} sheets, there is no sheet {wanted}", "sheets count from 1")
        return names[wanted - 1]
    name = get_option({"sheet": wanted}, "sheet", str, "")
    if name not in sheets:
        raise ReadingError(
            f"it has no sheet '{name}'", nearest(name, names) or f"its sheets are: {', '.join(names[:12])}"
        )
    return name


def _rows_of_numbers(lines: Iterable[str]) -> int:
    return sum(map(_is_row_of_numbers, lines))


def _is_row_of_numbers(line: str) -> bool:
    cells = [cell for cell in line.split(_BETWEEN) if cell]
    return bool(cells) and cells[-1][-1].isdigit() and cells[0][-1].isdigit()


def _with_points(lines: Sequence[str]) -> Sequence[str]:
    """With decimal points in place of the decimal commas of texts, unless the comma sets thousands apart."""
    if any(map(_THOUSANDS.search, lines)):
        return lines
    return [_COMMA.sub(lambda found: f"{found[1].replace('.', '')}.{found[2]}", line) for line in lines]


def read_sheets(path: str) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """The lines of all sheets with tabs between their cells."""
    from openpyxl import load_workbook

    book = load_workbook(path, read_only=True, data_only=True)
    try:
        sheets = {sheet.title: _lines(sheet.iter_rows(values_only=True)) for sheet in book.worksheets}
    finally:
        book.close()
    if not any(sheets.values()):
        raise ReadingError("its sheets are empty", "check that this is the file of the measurement")
    return {}, {"sheets": sheets}


def _lines(rows: Iterable[Sequence[Any]]) -> list[str]:
    lines = [_BETWEEN.join(map(_text, row)).rstrip(_BETWEEN) for row in rows]
    while lines and not lines[-1]:
        lines.pop()
    return lines


def _text(cell: Any) -> str:
    if cell is None or isinstance(cell, bool):
        return ""
    if isinstance(cell, int | float):
        return repr(cell)
    return " ".join(str(cell).split())

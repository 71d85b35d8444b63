"""Text tables as rigs write them: comma, semicolon, tab or blanks, decimal comma, headers, units, remarks."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.delimited_layout import DECIMALS, DELIMITERS, find_layout
from dashpot_formats.delimited_table import read_table
from dashpot_formats.delimited_text import read_lines
from dashpot_formats.option import check_options, get_option

_DELIMITER_WORDS = {"tab": "\t", "\\t": "\t", "space": None, "spaces": None, " ": None, "whitespace": None}


class Csv(Reader):
    """Reads a text table as measuring programs export it; what it does not make plain goes under `file_options`.

    Columns are named by a line above the numbers, whose units may stand in brackets or in a line of their own; without
    names they are called 1, 2, 3, ... Dates and times of day become seconds since the first row. A sampling rate that
    the lines above state is used where no time is declared. A column may hold texts as long as nobody asks for it.
    """

    word = "csv"
    suffixes = (".csv", ".txt", ".tsv", ".dat", ".asc", ".prn", ".log")
    options = {
        "delimiter": "what stands between columns: `,` `;` `|` `tab` or `space`",
        "decimal": "the decimal sign, `.` or `,`",
        "encoding": "of the text, such as `cp1252`",
        "skip_rows": "lines to leave out at the top",
    }

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        lines = read_lines(path, get_option(options, "encoding", str, None))
        skipped = get_option(options, "skip_rows", int, 0)
        if skipped < 0:
            raise ReadingError(f"expected 'skip_rows' as 0 or more, got {skipped}", "it counts lines at the top")
        lines = lines.without_first(skipped)
        layout = find_layout(lines, _delimiters(options), _decimals(options))
        return read_table(lines, layout)


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

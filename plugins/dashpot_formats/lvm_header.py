"""The headings of a LabVIEW measurement file: one for the file, one for each segment."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime

from dashpot.contract.reader import ReadingError

END = "***End_of_Header***"
_SEPARATORS = {"tab": "\t", "comma": ",", "semicolon": ";"}
_DECIMALS = {".", ","}


@dataclass(frozen=True)
class FileHeading:
    """How the file is written: separator and decimal sign, and the line (from 0) behind the heading."""

    separator: str
    decimal: str
    behind: int


@dataclass(frozen=True)
class Segment:
    """Channels written under one heading: its entries by key, names of columns, and its lines of numbers (from 0)."""

    entries: Mapping[str, Sequence[str]]
    names: Sequence[str]
    first: int
    last: int

    def values(self, key: str) -> list[str]:
        """What the heading says of each channel, empty where it says nothing."""
        return [cell.strip() for cell in self.entries.get(key, ())]

    @property
    def start(self) -> datetime | None:
        """When its first channel began, where the heading tells."""
        date, time = (self.values(key)[:1] for key in ("Date", "Time"))
        if not date or not time:
            return None
        # fractions may have more digits than a datetime takes
        text = re.sub(r"[.,](\d{1,6})\d*$", r".\1", f"{date[0]} {time[0]}")
        for form in ("%Y/%m/%d %H:%M:%S.%f", "%Y/%m/%d %H:%M:%S"):
            try:
                return datetime.strptime(text, form)
            except ValueError:
                continue
        return None


def is_lvm(lines: Sequence[str]) -> bool:
    """Whether a text begins as LabVIEW begins its measurement files."""
    return bool(lines) and lines[0].lstrip("\ufeff").startswith("LabVIEW Measurement")


def read_file_heading(lines: Sequence[str]) -> FileHeading:
    """The heading of the file. Raises ReadingError where it does not end."""
    end = next((number for number, line in enumerate(lines) if line.startswith(END)), None)
    if end is None:
        raise ReadingError(f"expected a line '{END}' behind its heading, found none", "export the file again", 1)
    entries = dict(_entry(line) for line in lines[:end] if line.strip())
    separator = _SEPARATORS.get(entries.get("Separator", "Tab").lower(), "\t")
    decimal = entries.get("Decimal_Separator", ".")
    return FileHeading(separator, decimal if decimal in _DECIMALS else ".", end + 1)


def _entry(line: str) -> tuple[str, str]:
    parts = [part.strip() for part in re.split(r"[\t,;]", line, maxsplit=1)]
    # the decimal sign may be the separator itself
    return parts[0], parts[1].strip("\t; ") if len(parts) > 1 else ""


def segments(lines: Sequence[str], heading: FileHeading) -> Iterator[Segment]:
    """The segments in the order of the file. Raises ReadingError for a heading without a line of names."""
    start = heading.behind
    while (end := _next(lines, start, END)) is not None:
        entries = {cells[0]: cells[1:] for line in lines[start:end] if (cells := line.split(heading.separator))[0]}
        if end + 1 >= len(lines) or not lines[end + 1].strip():
            raise ReadingError("expected the names of the columns below its heading", "export the file again", end + 1)
        names = [cell.strip() for cell in lines[end + 1].split(heading.separator)]
        last = _next(lines, end + 2, "Channels") or len(lines)
        yield Segment(entries, names, end + 2, last)
        start = last


def _next(lines: Sequence[str], start: int, word: str) -> int | None:
    return next((number for number in range(start, len(lines)) if lines[number].startswith(word)), None)

"""TYDEX, the exchange format of tire measurements: sections that begin with `**`, columns of fixed width."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.delimited_text import read_lines
from dashpot_formats.distinct import distinct
from dashpot_formats.option import check_options, get_option
from dashpot_formats.tydex_channel import TydexChannel, read_channel

_FIELD = 10
_OFFSETS = ("added", "ignored")
_Line = tuple[int, str]


class Tydex(Reader):
    """Reads the measured channels of a TYDEX file (release 1.3), each with its unit, times its conversion factor.

    A channel with conversion offsets needs a word, as suppliers use them differently: `offsets: added` reads
    factor * (number + first offset) + second offset, `offsets: ignored` leaves them to the dataset.
    """

    word = "tydex"
    suffixes = (".tdx", ".tydex")
    options = {
        "offsets": "of channels with conversion offsets: `added` or `ignored`",
    }

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        offsets = get_option(options, "offsets", str, None)
        if offsets is not None and offsets not in _OFFSETS:
            raise ReadingError(f"expected 'offsets' as {' or '.join(_OFFSETS)}, got '{offsets}'", "correct the dataset")
        sections = _sections(read_lines(path, None))
        channels = [read_channel(line, number) for number, line in sections["MEASURCHANNELS"]]
        if not channels:
            raise ReadingError("it declares no channels", "list them under **MEASURCHANNELS")
        names = distinct([channel.name for channel in channels], "channel")
        values, lines = _values(sections["MEASURDATA"], len(channels))
        columns = {
            name: _physical(channel, numbers, offsets)
            for name, channel, numbers in zip(names, channels, values.T, strict=True)
        }
        units = {name: channel.unit for name, channel in zip(names, channels, strict=True) if channel.unit}
        return Table(columns, units, lines=lines)


def _sections(lines: Iterable[str]) -> dict[str, list[_Line]]:
    """The lines of each section with their numbers, without remarks and empty ones."""
    sections: dict[str, list[_Line]] = {}
    current: list[_Line] = []
    for number, line in enumerate(lines, 1):
        if line.startswith("**"):
            current = sections.setdefault(line[2:].split(None, 1)[0].upper() if line[2:].strip() else "", [])
        elif line.strip() and not line.lstrip().startswith("!"):
            current.append((number, line))
    for name in ("MEASURCHANNELS", "MEASURDATA"):
        if name not in sections:
            raise ReadingError(f"it has no section **{name}", "check that this is a TYDEX file with measured data")
    return sections


def _physical(channel: TydexChannel, numbers: np.ndarray, offsets: str | None) -> np.ndarray:
    first, second = channel.offsets
    if (first or second) and offsets is None:
        message = f"channel '{channel.name}' has the conversion offsets {first:g} and {second:g}"
        raise ReadingError(message, "say what they mean with 'offsets: added' or 'offsets: ignored'", channel.line)
    with np.errstate(over="ignore", invalid="ignore"):
        # what becomes too large for a number is told as a missing one
        return channel.factor * (numbers + first) + second if offsets == "added" else channel.factor * numbers


def _values(rows: Sequence[_Line], count: int) -> tuple[np.ndarray, np.ndarray]:
    """The numbers (n, count), and the line in which each row begins."""
    if not rows:
        raise ReadingError("it holds no measured data", "check that this is the file of the measurement")
    points = _points(rows, count)
    values = np.full((len(points), count), np.nan)
    for index, (number, fields) in enumerate(points):
        try:
            values[index] = [float(field) if field else np.nan for field in fields]
        except ValueError:
            raise ReadingError(
                f"expected {count} numbers, got '{' '.join(fields)[:60]}'", "correct it", number
            ) from None
    return values, np.array([number for number, _ in points])


def _points(rows: Sequence[_Line], count: int) -> list[tuple[int, list[str]]]:
    """The fields of each measuring point: between blanks, or of fixed width, on one line or going on in the next."""
    points: list[tuple[int, list[str]]] = []
    for number, line in rows:
        fields = line.split()
        if len(fields) < count and len(line.rstrip()) > _FIELD * (count - 1):
            fields = [line[start : start + _FIELD].strip() for start in range(0, _FIELD * count, _FIELD)]
        if points and len(points[-1][1]) < count:
            points[-1][1].extend(fields)
        else:
            points.append((number, list(fields)))
        if len(points[-1][1]) > count:
            raise ReadingError(f"expected {count} values, got {len(points[-1][1])}", "correct the line", number)
    if len(points[-1][1]) < count:
        number, fields = points[-1]
        raise ReadingError(f"expected {count} values, got {len(fields)}", "the file is cut short", number)
    return points

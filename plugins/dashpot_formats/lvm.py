"""LabVIEW measurement files (.lvm): text tables under headings of their own, in one or several segments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.csv import Csv
from dashpot_formats.delimited_numbers import numbers_of
from dashpot_formats.delimited_text import read_lines
from dashpot_formats.distinct import distinct
from dashpot_formats.lvm_header import FileHeading, Segment, is_lvm, read_file_heading, segments
from dashpot_formats.option import check_options, get_option
from dashpot_formats.unit_words import plain_unit

_CLOCK, _COMMENT = "X_Value", "Comment"


class Lvm(Reader):
    """Reads the segments of a file one after the other: their times, channels and units; comments are left out.

    Times are the column `X_Value`, or follow from `X0` and `Delta_X` of the heading. Segments of one recording, as
    their dates tell, go on in time; else a segment starts its own time, and `rows`, or `segment: 2` under
    `file_options`, takes one. A file without LabVIEW's heading is read as a text table.

    Source: National Instruments, "Specification for the LabVIEW Measurement File (.lvm)".
    """

    word = "lvm"
    suffixes = (".lvm",)
    options = {
        "segment": "the one segment that is read, counted from 1",
        "encoding": "of the text, such as `cp1252`",
    }

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        # a list: its segments look up one line after the other
        lines = list(read_lines(path, get_option(options, "encoding", str, None)))
        if not is_lvm(lines):
            return Csv().read(path, {key: value for key, value in options.items() if key == "encoding"})
        heading = read_file_heading(lines)
        found = _chosen(list(segments(lines, heading)), get_option(options, "segment", int, None))
        blocks = [_read_block(segment, lines, heading) for segment in found]
        return _joined(found, blocks)


def _chosen(found: list[Segment], number: int | None) -> list[Segment]:
    if not found:
        raise ReadingError("it has a heading, but no segment with channels", "export the file again")
    if number is None:
        # a further segment with other channels is another measurement
        return [segment for segment in found if segment.names == found[0].names]
    if not 1 <= number <= len(found):
        raise ReadingError(f"it has {len(found)} segments, there is no segment {number}", "segments count from 1")
    return [found[number - 1]]


class _Block:
    """The numbers of one segment: columns by name (n,), clock and channels apart, and their lines in the file."""

    def __init__(self, clock: np.ndarray, channels: dict[str, np.ndarray], lines: np.ndarray) -> None:
        self.clock, self.channels, self.lines = clock, channels, lines


def _read_block(segment: Segment, lines: Sequence[str], heading: FileHeading) -> _Block:
    kept = [number for number in range(segment.first, segment.last) if lines[number].strip()]
    width = len(segment.names)
    rows = [(lines[number].split(heading.separator) + [""] * width)[:width] for number in kept]
    columns = [numbers_of(list(texts), heading.decimal) for texts in zip(*rows, strict=True)] if rows else []
    if not columns:
        raise ReadingError("a segment holds no rows", "cut its heading off", segment.first)
    clocks = [index for index, name in enumerate(segment.names) if name == _CLOCK]
    named = [i for i, name in enumerate(segment.names) if name != _COMMENT and i not in clocks]
    titles = distinct([segment.names[index] for index in named], "channel")
    channels = {title: columns[index] for title, index in zip(titles, named, strict=True)}
    written = {
        number: columns[index] for number, index in enumerate(clocks, 1) if np.isfinite(_plain(columns[index])).any()
    }
    clock = _plain(next(iter(written.values()))) if written else _counted(segment, heading, len(rows))
    channels |= {
        f"{_CLOCK} {number}": values
        for number, values in written.items()
        if not np.array_equal(_plain(values), clock, equal_nan=True)
    }
    return _Block(clock, channels, np.array(kept) + 1)


def _plain(values: np.ndarray) -> np.ndarray:
    """Numbers only: texts are none."""
    return np.array([np.nan if isinstance(value, str) else value for value in values], dtype=float)


def _counted(segment: Segment, heading: FileHeading, count: int) -> np.ndarray:
    """Times from the beginning and the step in the heading."""
    first, step = (_number(segment.values(key)[:1], heading) for key in ("X0", "Delta_X"))
    if step is None or step <= 0.0:
        return np.full(count, np.nan)
    return (first or 0.0) + step * np.arange(count)


def _number(texts: Sequence[str], heading: FileHeading) -> float | None:
    values = numbers_of(list(texts), heading.decimal) if texts else np.zeros(0)
    return float(values[0]) if values.size and not isinstance(values[0], str) else None


def _joined(found: Sequence[Segment], blocks: Sequence[_Block]) -> Table:
    """All segments as one table: times where there are any, names as they stand, units as the headings tell."""
    clock = np.concatenate(_going_on(found, [block.clock for block in blocks]))
    names = list(dict.fromkeys(name for block in blocks for name in block.channels))
    # a further clock is told where it differs from the first one
    columns = {name: np.concatenate([block.channels.get(name, block.clock) for block in blocks]) for name in names}
    units = {name: unit for name, unit in zip(names, _units(found[0]), strict=False) if unit}
    if np.isfinite(clock).any():
        columns = {_CLOCK: clock, **columns}
        is_time = (found[0].values("X_Dimension")[:1] or ["Time"])[0].lower() == "time"
        units |= {_CLOCK: "s"} if is_time else {}
    return Table(columns, units, lines=np.concatenate([block.lines for block in blocks]))


def _units(segment: Segment) -> list[str]:
    return [plain_unit(text) for text in segment.values("Y_Unit_Label")]


def _going_on(found: Sequence[Segment], clocks: Sequence[np.ndarray]) -> list[np.ndarray]:
    """The times of the segments, those that start anew moved behind the one before where their dates say so."""
    moved = [clocks[0]]
    for before, segment, clock in zip(found, found[1:], clocks[1:], strict=False):
        last = moved[-1]
        step = float(np.median(np.diff(last))) if last.size > 1 else 0.0
        apart = _seconds(before, segment)
        follows = last[0] + apart if apart is not None else None
        if follows is not None and clock[0] <= last[-1] and abs(follows - last[-1] - step) <= step:
            clock = clock - clock[0] + last[-1] + step
        moved.append(clock)
    return moved


def _seconds(first: Segment, second: Segment) -> float | None:
    return (second.start - first.start).total_seconds() if first.start and second.start else None

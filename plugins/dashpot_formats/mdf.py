"""ASAM MDF 4 and 3, the format of vehicle measurements, with the library asammdf in a process of its own."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.apart import read_apart
from dashpot_formats.distinct import distinct
from dashpot_formats.extra import require
from dashpot_formats.option import check_options, get_option
from dashpot_formats.unit_words import plain_unit


class Mdf(Reader):
    """Reads all channels of numbers, converted as the file says; samples marked invalid are missing.

    Channels of one group share a clock, `time`; with several groups the clocks are `time (group 1)`, `time (group 2)`,
    ..., and channels of different groups differ in length: declare such that belong together, or choose one group with
    `group: 2`.
    """

    word = "mdf"
    suffixes = (".mf4", ".mdf")
    extra = "mdf"
    options = {
        "group": "the one channel group that is read, counted from 1",
    }

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        wanted = get_option(options, "group", int, None)
        require("asammdf", self.extra, "MDF files")
        content = read_apart(read_mdf, path, "MDF file")
        channels = [_Channel(*entry) for entry in content.notes["channels"]]
        groups = sorted({channel.group for channel in channels})
        if wanted is not None and wanted not in groups:
            raise ReadingError(f"it has no group {wanted} with numbers", f"there are: {', '.join(map(str, groups))}")
        chosen = [channel for channel in channels if wanted in (None, channel.group)]
        if not chosen:
            raise ReadingError("it holds no channels of numbers", "check that this is the file of the measurement")
        return _table(chosen, content.arrays)


@dataclass(frozen=True)
class _Channel:
    """A channel, and the key under which its numbers came."""

    key: str
    name: str
    group: int
    unit: str


def _table(channels: Sequence[_Channel], arrays: Mapping[str, np.ndarray]) -> Table:
    short = Counter(channel.name for channel in channels)
    titles = [c.name if short[c.name] == 1 else f"{c.name} (group {c.group})" for c in channels]
    names = distinct(titles, "channel")
    columns = {name: arrays[channel.key].astype(float) for name, channel in zip(names, channels, strict=True)}
    units = {name: plain_unit(channel.unit) for name, channel in zip(names, channels, strict=True)}
    return Table(columns, {name: unit for name, unit in units.items() if unit})


def read_mdf(path: str) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """The arrays of all channels under a key, and for each its key, name, group and unit."""
    from asammdf import MDF

    arrays: dict[str, np.ndarray] = {}
    channels: list[tuple[str, str, int, str]] = []

    def keep(name: str, group: int, unit: str, values: np.ndarray) -> None:
        key = str(len(channels))
        arrays[key] = values
        channels.append((key, name, group, unit))

    with MDF(path) as file:
        groups: list[Any] = file.groups
        for index, group in enumerate(groups):
            clock = file.masters_db.get(index)
            places = [place for place in range(len(group.channels)) if place != clock]
            # left to itself the library would cut invalid samples out, and the channels would no longer fit their clock
            signals = [file.get(group=index, index=place, ignore_invalidation_bits=True) for place in places]
            measured = [(signal, values) for signal in signals if (values := _numbers(signal)) is not None]
            if measured:
                keep("time", index + 1, "s", np.asarray(measured[0][0].timestamps, dtype=float))
            for signal, values in measured:
                keep(signal.name, index + 1, signal.unit or "", values)
    return arrays, {"channels": channels}


def _numbers(signal: Any) -> np.ndarray | None:
    values = np.asarray(signal.samples)
    if values.dtype.kind not in "iufb" or values.ndim != 1 or values.size < 2:
        return None
    invalid = getattr(signal, "invalidation_bits", None)
    if invalid is None or not np.any(invalid):
        return values
    return np.where(np.asarray(invalid, dtype=bool), np.nan, values)

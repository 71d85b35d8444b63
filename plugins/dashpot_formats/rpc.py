"""MTS RPC III time histories: a header of keywords, then the channels in groups of frames."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.distinct import distinct
from dashpot_formats.option import check_options
from dashpot_formats.rpc_header import RpcHeader
from dashpot_formats.unit_words import plain_unit

_BYTE_ORDERS = {"BINARY": "<", "BINARY_IEEE_LITTLE_END": "<", "BINARY_IEEE_BIG_END": ">"}
_TYPES = {"SHORT_INTEGER": "i2", "FLOATING_POINT": "f4"}
_MOST_CHANNELS = 4096


class Rpc(Reader):
    """Reads time histories of whole or real numbers, in either byte order, with any number of frames in a group.

    Columns are called by the descriptions of the channels, with their units; the file states the sampling rate. Whole
    numbers are multiplied by the scale of their channel. What fills up the last frame is read as it is stored:
    `dashpot import` leaves zeros out by `rows`. ASCII files of this format are not read.
    """

    word = "rpc"
    suffixes = (".rsp", ".rpc", ".drv", ".tim")

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        content = path.read_bytes()
        header = RpcHeader.read(content)
        layout = _Layout.read(header)
        with np.errstate(over="ignore", invalid="ignore"):
            # what becomes too large for a number is told as a missing one
            values = layout.channels_of(content[header.size :]) * _scales(header, layout)[:, None]
        numbers = range(1, layout.channels + 1)
        names = distinct([header.text(f"DESC.CHAN_{number}", "") for number in numbers], "channel")
        units = {
            name: plain_unit(header.text(f"UNITS.CHAN_{number}", ""))
            for name, number in zip(names, numbers, strict=True)
        }
        step = header.number("DELTA_T", smallest=1e-9)
        # the header holds seven digits of the step
        sampling = float(f"{1.0 / step:.7g}")
        return Table(
            dict(zip(names, values, strict=True)), {name: unit for name, unit in units.items() if unit}, sampling
        )


@dataclass(frozen=True)
class _Layout:
    """How numbers follow each other: in every group all points of the first channel, then of the second, and so on."""

    number: np.dtype
    channels: int
    group: int
    samples: int

    @classmethod
    def read(cls, header: RpcHeader) -> _Layout:
        order = header.choice("FORMAT", _BYTE_ORDERS)
        kind = header.choice("DATA_TYPE", _TYPES, "SHORT_INTEGER")
        header.choice("FILE_TYPE", {"TIME_HISTORY": ""}, "TIME_HISTORY")
        frame = header.whole("PTS_PER_FRAME")
        group = header.whole("PTS_PER_GROUP", default=frame)
        if group % frame:
            message = f"expected whole frames in a group, got PTS_PER_GROUP {group} and PTS_PER_FRAME {frame}"
            raise ReadingError(message, "export the file again")
        channels = header.whole("CHANNELS", largest=_MOST_CHANNELS)
        samples = header.whole("FRAMES") * frame
        return cls(np.dtype(order + kind), channels, group, header.whole("SAMPLES", default=samples, largest=samples))

    def channels_of(self, content: bytes) -> np.ndarray:
        """The numbers of every channel (channels, samples). Raises ReadingError when there are not enough."""
        groups, rest = divmod(self.samples, self.group)
        whole = groups * self.channels * self.group
        there = len(content) // self.number.itemsize
        # the last group is stored in full, with something behind the samples, or just as far as there are samples
        last = self.group if there >= whole + self.channels * self.group else rest
        needed = whole + self.channels * last * bool(rest)
        if there < needed:
            size = self.number.itemsize
            message = f"it is cut short: expected {needed * size} bytes behind its header, got {there * size}"
            raise ReadingError(message, "copy it again")
        numbers = np.frombuffer(content, self.number, needed)
        body = numbers[:whole].reshape(groups, self.channels, self.group).swapaxes(0, 1).reshape(self.channels, -1)
        tail = numbers[whole:].reshape(self.channels, -1)[:, :rest]
        return np.concatenate([body, tail], axis=1).astype(float)


def _scales(header: RpcHeader, layout: _Layout) -> np.ndarray:
    """What one count stands for in every channel; 1 for real numbers."""
    if layout.number.kind == "f":
        return np.ones(layout.channels)
    return np.array([header.number(f"SCALE.CHAN_{number}") for number in range(1, layout.channels + 1)])

"""NI TDMS, the binary format of LabVIEW and DIAdem, with the library npTDMS in a process of its own."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot_formats.apart import read_apart
from dashpot_formats.distinct import distinct
from dashpot_formats.extra import require
from dashpot_formats.option import check_options
from dashpot_formats.unit_words import plain_unit

_UNIT_KEYS = ("unit_string", "NI_UnitDescription", "Unit", "unit")
_STEP = "wf_increment"


class Tdms(Reader):
    """Reads all channels of numbers, scaled as the file says; dates are seconds since their first.

    A channel is called by its name, or `group/name` where several groups have one of that name. The units are those of
    the properties, the sampling rate is that of the waveforms when they share one.
    """

    word = "tdms"
    suffixes = (".tdms",)
    extra = "tdms"

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        require("nptdms", self.extra, "TDMS files")
        content = read_apart(read_tdms, path, "TDMS file")
        if not content.arrays:
            raise ReadingError("it holds no channels of numbers", "check that this is the file of the measurement")
        columns = {name: values.astype(float) for name, values in content.arrays.items()}
        return Table(columns, content.notes["units"], content.notes["sampling"])


def read_tdms(path: str) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Columns, their units and the sampling rate."""
    from nptdms import TdmsFile

    with TdmsFile.open(path) as file:
        channels = [channel for group in file.groups() for channel in group.channels()]
        short = [channel.name for channel in channels]
        titles = [c.name if short.count(c.name) == 1 else f"{c.group_name}/{c.name}" for c in channels]
        columns: dict[str, np.ndarray] = {}
        units: dict[str, str] = {}
        steps: set[float] = set()
        for name, channel in zip(distinct(titles, "channel"), channels, strict=True):
            values = _numbers(channel[:])
            if values is None or not values.size:
                continue
            columns[name] = values
            if unit := "s" if channel.dtype.kind == "M" else _unit(channel.properties):
                units[name] = unit
            if step := channel.properties.get(_STEP):
                steps.add(float(step))
    return columns, {"units": units, "sampling": _rate(steps)}


def _numbers(values: Any) -> np.ndarray | None:
    values = np.asarray(values)
    if values.dtype.kind == "M":
        return (values - values[0]) / np.timedelta64(1, "s") if values.size else None
    return values if values.dtype.kind in "iufb" and values.ndim == 1 else None


def _unit(properties: Mapping[str, Any]) -> str:
    return next((plain_unit(str(properties[key])) for key in _UNIT_KEYS if properties.get(key)), "")


def _rate(steps: set[float]) -> float | None:
    step = steps.pop() if len(steps) == 1 else 0.0
    return float(f"{1.0 / step:.12g}") if np.isfinite(step) and step > 0 else None

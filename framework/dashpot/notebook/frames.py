"""Runs out of frames of pandas and datasets of xarray: which column is which channel, and of which run."""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from dashpot.data.channel import unit_of_channel
from dashpot.text.problem import InputError, Place, nearest

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset as XarrayDataset

LABEL = re.compile(r"(?P<channel>\w+(?:@\w+)?)\s*(?:[(\[](?P<unit>[^)\]]+)[)\]])?")


@dataclass(frozen=True, eq=False)
class Samples:
    """The samples (n,) of one run by channel, and the units that its labels state."""

    run: str
    columns: Mapping[str, np.ndarray]
    units: Mapping[str, str]


def samples_of_frame(
    frame: DataFrame, columns: Mapping[str, Hashable] | None, by: Hashable, name: str
) -> Iterator[Samples]:
    """The runs of a frame, in the order in which the column ``by`` names them; ``name`` is that of one without it."""
    if frame.index.name is not None and frame.index.name not in frame.columns:
        frame = frame.reset_index()
    found = _channels(frame.columns, columns)
    units = _units(found)
    pieces = frame.groupby(by, sort=False, observed=True) if by in frame.columns else [(name, frame)]
    for run, piece in pieces:
        yield Samples(str(run), {key: _plain(piece[label].to_numpy()) for key, label in found.items()}, units)


def samples_of_xarray(
    dataset: XarrayDataset, columns: Mapping[str, Hashable] | None, by: str, name: str
) -> Iterator[Samples]:
    """The runs of a dataset, along its dimension ``by``; shorter ones may be filled up with NaN at their end."""
    found = _channels(dataset.variables, columns)
    units = {
        **_units(found),
        **{
            channel: str(dataset[label].attrs["units"])
            for channel, label in found.items()
            if "units" in dataset[label].attrs
        },
    }
    count = dataset.sizes.get(by)
    for number in range(count or 1):
        piece = dataset if count is None else dataset.isel({by: number})
        run = name if count is None else str(piece[by].item() if by in piece.coords else f"{name}_{number + 1}")
        values = {channel: _plain(piece[label].values) for channel, label in found.items()}
        yield Samples(run, _filled(values), units)


def _channels(labels: Iterable[Hashable], columns: Mapping[str, Hashable] | None) -> dict[str, Hashable]:
    """The label of every channel: as it is said, else of those labels that are the name of a channel."""
    known = list(labels)
    if columns is None:
        return {
            match["channel"]: label
            for label in known
            if (match := LABEL.fullmatch(str(label))) and unit_of_channel(match["channel"])
        }
    for channel, label in columns.items():
        if label not in known:
            texts = [str(each) for each in known]
            raise InputError.at(
                Place(),
                f"the channel '{channel}': there is no column '{label}'",
                nearest(str(label), texts) or f"columns are {', '.join(texts[:12])}",
            )
    return dict(columns)


def _units(channels: Mapping[str, Hashable]) -> dict[str, str]:
    found = {channel: re.search(r"[(\[]([^)\]]+)[)\]]\s*$", str(label)) for channel, label in channels.items()}
    return {channel: match[1] for channel, match in found.items() if match}


def _plain(values: np.ndarray) -> np.ndarray:
    """Samples as numbers; instants and durations as seconds from the first one."""
    if values.dtype.kind in "mM":
        return (values - values[0]) / np.timedelta64(1, "s")
    return values


def _filled(values: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    measured = [column for channel, column in values.items() if channel != "time" and column.dtype.kind == "f"]
    ends = [int(np.flatnonzero(~np.isnan(column))[-1]) + 1 for column in measured if not np.isnan(column).all()]
    return {channel: column[: max(ends, default=None)] for channel, column in values.items()}

"""From the columns of a file to channels in SI."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from dashpot.data.channel import Channel, unit_meant, unit_of_channel
from dashpot.data.table import ReadingError, Table
from dashpot.data.trouble import Trouble, Unusable, refuse
from dashpot.text.quantity import base_unit, factor, is_unit


def find_columns(table: Table, channels: Sequence[Channel]) -> dict[str, str]:
    """Channel name -> column name. Raises Unusable with every channel whose column is missing."""
    found: dict[str, str] = {}
    troubles: list[Trouble] = []
    for channel in channels:
        try:
            found[channel.name] = table.find(channel.column)
        except ReadingError as error:
            troubles.append(Trouble(error.message, error.hint, channel.place))
    refuse(troubles)
    return found


def common_length(table: Table, columns: dict[str, str]) -> int:
    """The number of rows of the columns asked for. Raises Unusable when they differ."""
    lengths = {column: len(table.columns[column]) for column in columns.values()}
    if len(set(lengths.values())) != 1:
        shown = ", ".join(f"'{column}' {length}" for column, length in lengths.items())
        raise Unusable([Trouble(f"its columns differ in length: {shown}", "choose columns that belong together")])
    return next(iter(lengths.values()))


def read_si(table: Table, channel: Channel, column: str, rows: np.ndarray, accept: Sequence[str]) -> np.ndarray:
    """The chosen rows of a channel: sign * gain * (raw in SI) - offset. Raises Unusable."""
    scale, zero = _to_si(table.units.get(column), channel, column, "units" in accept)
    raw = read_numbers(table, channel, column, rows)
    return channel.sign * channel.gain * (raw * scale + zero) - channel.offset


def _to_si(stated: str | None, channel: Channel, column: str, trust_dataset: bool) -> tuple[float, float]:
    stated = unit_meant(channel.name, stated) if stated else stated
    unit = channel.unit or stated
    if unit is None:
        return 1.0, 0.0
    try:
        chosen = factor(unit, unit_of_channel(channel.name) or base_unit(unit))
    except ValueError as error:
        hint = f"say the unit of '{channel.name}' in the dataset"
        raise Unusable([Trouble(f"column '{column}': {error}", hint, channel.place)]) from None
    if stated and channel.unit and not trust_dataset and not _same_unit(stated, channel.unit):
        message = f"column '{column}' is in '{stated}' after its file, in '{channel.unit}' after the dataset"
        hint = "correct the unit, or write 'accept: [units]' where the file is wrong"
        raise Unusable([Trouble(message, hint, channel.place)])
    return chosen


def _same_unit(stated: str, declared: str) -> bool:
    if not is_unit(stated):
        return True
    try:
        scale, offset = factor(stated, declared)
    except ValueError:
        return False
    return math.isclose(scale, 1.0, rel_tol=1e-9) and offset == 0.0


def read_numbers(table: Table, channel: Channel, column: str, rows: np.ndarray) -> np.ndarray:
    """The chosen rows of a column as they stand in the file. Raises Unusable for a text among them."""
    values = table.columns[column][rows]
    if values.dtype != object:
        return np.asarray(values, dtype=float)
    texts = [index for index, value in enumerate(values) if isinstance(value, str)]
    if texts:
        where = table.where(rows[texts[0]])
        more = f", and {len(texts) - 1} more" if len(texts) > 1 else ""
        message = f"expected a number in column '{column}', got '{values[texts[0]]}' in {where}{more}"
        hint = "cut it off with 'rows: [first, last]'"
        if channel.name == "time" and len(texts) == len(values):
            hint = "say 'sampling: ... Hz' in place of the time channel"
        raise Unusable([Trouble(message, hint, channel.place)])
    return values.astype(float)

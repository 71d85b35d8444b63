"""In which unit a column is: as its file states, as its name says, or after the size of its numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from dashpot.data.channel import CHANNEL_UNITS, unit_meant
from dashpot.data.importing.roles import measures_channel

STATED, IN_NAME, GUESSED = "stated in the file", "in the name", "guessed"
_DEFAULTS = {"velocity": "mm/s", "acceleration": "m/s^2", "temperature": "degC", "pressure": "bar"}


@dataclass(frozen=True)
class UnitFound:
    """A unit and what told it."""

    unit: str
    by: str


def find_unit(channel: str, column: str, stated: str, values: np.ndarray) -> UnitFound:
    """The unit of a column that is this channel. A guess is no more than that: it has to be confirmed."""
    if stated and measures_channel(stated, channel):
        return UnitFound(unit_meant(channel, stated), STATED)
    for word in _words(column):
        # a single letter alone is rather the symbol of the channel
        if (word != column or len(word) > 1) and measures_channel(word, channel):
            return UnitFound(unit_meant(channel, word), IN_NAME)
    return UnitFound(_guess(channel, values), GUESSED)


def _words(column: str) -> Iterator[str]:
    """The words of a name from its end, and what stands behind their first slash: `Kraft/kN`, `v/mm/s`."""
    for word in reversed(re.split(r"[\s_.\[\]():-]+", column)):
        yield from (word, word.partition("/")[2])


def _guess(channel: str, values: np.ndarray) -> str:
    if channel == "displacement":
        # hardly a rig goes half a metre
        return "mm" if np.max(np.abs(values)) > 0.5 else "m"
    if channel == "time":
        step = float(np.median(np.diff(values)))
        return "ms" if step >= 1.0 else "s"
    return _DEFAULTS.get(channel, CHANNEL_UNITS[channel])

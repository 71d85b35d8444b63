"""Which column is which channel: from the names and units of columns, and from how they move."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from dashpot.data.channel import CHANNEL_UNITS
from dashpot.text.quantity import factor

# whole names, and parts of names, in English and German; letters count as written
_NAMES = {
    "time": "t time zeit tout runtime x_value timestamp uhrzeit zeitstempel",
    "displacement": "x X s z d u disp pos lvdt weg hub way",
    "force": "F Fx Fy Fz FZ FX FY FZW f load last kraft forc",
    "velocity": "v vel speed",
    "acceleration": "a acc accel",
    "temperature": "T temp",
    "pressure": "p press",
}
_PARTS = {
    "time": "time zeit elapsed runtime",
    "displacement": "displ deflec travel stroke position way weg hub dist lvdt einfeder auslenk deform laser stellung",
    "force": "force kraft load last",
    "velocity": "veloc speed geschw",
    "acceleration": "accel beschl",
    "temperature": "temper",
    "pressure": "pressure druck",
}
_WANTED_PARTS = (
    "command cmd target setpoint soll desired reference error abweich limit peak max min count index".split()
)
_COUNTER = re.compile(r"(sample|row|point|scan|data|meas\w*)?[ _]?(no|nr|num|number|numb|index|idx|count|#)\.?", re.I)

SURE, LIKELY, GUESSED = "its name and unit", "its name", "how it moves"


@dataclass(frozen=True)
class Role:
    """A channel, the column it was found in, and what told so."""

    channel: str
    column: str
    by: str


def named_roles(columns: Sequence[str], units: Mapping[str, str]) -> dict[str, Role]:
    """The best column for every channel, by name and unit; the first of several that are as good."""
    found: dict[str, tuple[float, Role]] = {}
    for column in columns:
        for channel in CHANNEL_UNITS:
            score, by = _score(column, units.get(column, ""), channel)
            if score > 0 and score > found.get(channel, (0.0, None))[0]:
                found[channel] = score, Role(channel, column, by)
    return {channel: role for channel, (_, role) in found.items()}


def _score(column: str, unit: str, channel: str) -> tuple[float, str]:
    by_name, measures = name_score(column, channel), measures_channel(unit, channel)
    if measures is False or (channel != "time" and is_counter(column)):
        return 0.0, ""
    unwanted = any(part in column.lower() for part in _WANTED_PARTS)
    score = by_name + (2.0 if measures else 0.0) - (3.0 if unwanted else 0.0)
    return score, SURE if measures and by_name else "its unit" if measures else LIKELY


def name_score(column: str, channel: str) -> float:
    """How well a name fits a channel: 3 a name of it, 2 a word of it inside, 0 not at all."""
    bare = re.split(r"[\[(]", column)[0].strip()
    words = [word for word in re.split(r"[\s_.:/-]+", bare) if word]
    names = _NAMES[channel].split()
    if any(_is_name(word, names) for word in (bare, *words[:1])):
        return 3.0
    return 2.0 if any(part in bare.lower() for part in _PARTS[channel].split()) else 0.0


def _is_name(word: str, names: Sequence[str]) -> bool:
    return word in names or (len(word) > 2 and word.lower() in names)


def measures_channel(unit: str, channel: str) -> bool | None:
    """Whether a unit measures what a channel is; None without a unit, or with one that nobody knows."""
    try:
        factor(unit, CHANNEL_UNITS[channel])
    except ValueError as error:
        return None if not unit or str(error).startswith("unknown unit") else False
    return True


def is_counter(column: str) -> bool:
    """Whether a name says that the samples are counted."""
    return _COUNTER.fullmatch(column.strip()) is not None


def motion_roles(columns: Mapping[str, np.ndarray], taken: Mapping[str, Role]) -> dict[str, Role]:
    """Displacement and force among the columns that are left, by their numbers.

    A column whose rate of change is another one is the displacement, the other its velocity; what is left after that is
    taken in order. Nothing is guessed where nothing moves.
    """
    used = {role.column for role in taken.values()}
    left = {name: values for name, values in columns.items() if name not in used and np.ptp(values) > 0}
    found = dict(taken)
    if "displacement" not in found:
        pair = _rate_pair(left) if "velocity" not in found else None
        names = list(pair or list(left)[:1])
        for channel, name in zip(("displacement", "velocity"), names, strict=False):
            found[channel] = Role(channel, name, GUESSED)
            left.pop(name)
    if "force" not in found and left:
        found["force"] = Role("force", next(iter(left)), GUESSED)
    return found


def _rate_pair(columns: Mapping[str, np.ndarray]) -> tuple[str, str] | None:
    """Two columns of which the second is the rate of change of the first."""
    best, pair = 0.9, None
    for first, values in columns.items():
        rate = np.gradient(values)
        for second, other in columns.items():
            if first != second and np.ptp(rate) > 0:
                likeness = float(np.corrcoef(rate, other)[0, 1])
                if likeness > best:
                    best, pair = likeness, (first, second)
    return pair

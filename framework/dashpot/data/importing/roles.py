"""Which column is which channel: from the names and units of columns, and from how they move."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from dashpot.data.channel import CHANNEL_UNITS
from dashpot.data.importing.correlation import correlation
from dashpot.text.quantity import factor

# whole names, and parts of names, in English and German; letters count as written
_NAMES = {
    "time": "t sec sek time zeit tout runtime x_value timestamp uhrzeit zeitstempel",
    "displacement": "x X s z d u disp dist pos lvdt weg hub way",
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

# from this correlation on two columns are one signal
_SAME = 0.9995

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
        unit = units.get(column) or (column if len(column) > 1 else "")
        for channel in CHANNEL_UNITS:
            score, by = _score(column, unit, channel)
            if score > 0 and score > found.get(channel, (0.0, None))[0]:
                found[channel] = score, Role(channel, column, by)
    return {channel: role for channel, (_, role) in found.items()}


def _score(column: str, unit: str, channel: str) -> tuple[float, str]:
    by_name, measures = name_score(column, channel), measures_channel(unit, channel)
    if (measures is False and unit != column) or (channel != "time" and is_counter(column)):
        return 0.0, ""
    unwanted = any(part in column.lower() for part in _WANTED_PARTS)
    # columns of a matrix have its name only
    inside = re.search(r"\(\d+\)$", column) is not None
    score = by_name + (2.0 if measures else 0.0) - (3.0 if unwanted else 0.0) - (1.5 if inside else 0.0)
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

    A column whose rate of change is another one is the displacement, the other its velocity; without such a pair the
    smoothest one is. The force is what goes with the motion, and is not the motion itself once more.
    """
    used = {role.column for role in taken.values()}
    left = {name: values for name, values in columns.items() if name not in used and np.ptp(values) > 0}
    found = dict(taken)
    if "displacement" not in found and left:
        # of two columns alone the second is the force: that of a damper goes with the rate, too
        wanted = "velocity" not in found and ("force" in found or len(left) > 2)
        pair = _rate_pair(left) if wanted else None
        names = pair or (_largest_like(min(left, key=lambda name: _roughness(left[name])), left),)
        for channel, name in zip(("displacement", "velocity"), names, strict=False):
            found[channel] = Role(channel, name, GUESSED)
    if "force" not in found and "displacement" in found:
        moved = [columns[found[channel].column] for channel in ("displacement", "velocity") if channel in found]
        used = {role.column for role in found.values()}
        rest = {name: values for name, values in left.items() if name not in used and not _is_like_any(values, moved)}
        if rest:
            found["force"] = Role("force", _largest_like(_moved_along(rest, moved[0]), rest), GUESSED)
    return found


def _roughness(values: np.ndarray) -> float:
    """How much a signal changes its course from sample to sample, as a part of its size."""
    return float(np.std(np.diff(values, 2)) / np.std(values))


def _moved_along(columns: Mapping[str, np.ndarray], motion: np.ndarray) -> str:
    """The first column that the motion, its rate and its direction explain nearly as well as any other."""
    rate = np.gradient(motion)
    basis = np.stack([np.ones_like(motion), motion, rate, np.sign(rate)], axis=1)
    explained = {}
    for name, values in columns.items():
        rest = values - basis @ np.linalg.lstsq(basis, values, rcond=None)[0]
        explained[name] = 1.0 - float(np.var(rest) / np.var(values))
    best = max(explained.values())
    return next(name for name, share in explained.items() if share >= best - 0.2 * abs(best))


def _largest_like(name: str, columns: Mapping[str, np.ndarray]) -> str:
    """The same signal in the largest numbers: volts are mostly recorded beside what they stand for."""
    like = [other for other, values in columns.items() if other == name or _is_like_any(values, [columns[name]])]
    return max(like, key=lambda other: float(np.ptp(columns[other])))


def _is_like_any(values: np.ndarray, others: Sequence[np.ndarray]) -> bool:
    return any(abs(correlation(values, other)) > _SAME for other in others)


def _rate_pair(columns: Mapping[str, np.ndarray]) -> tuple[str, str] | None:
    """Two columns of which the second is the rate of change of the first."""
    best, pair = 0.9, None
    for first, values in columns.items():
        rate = np.gradient(values)
        for second, other in columns.items():
            likeness = correlation(rate, other) if first != second else 0.0
            if likeness > best:
                best, pair = likeness, (first, second)
    return pair

"""Which column is which channel: from the names and units of columns, and from how they move."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from dashpot.data.channel import CHANNEL_UNITS, unit_meant
from dashpot.data.importing.correlation import correlation
from dashpot.data.importing.pairs import (
    Pair,
    best_pair,
    goes_with_clock,
    is_like,
    is_like_any,
    likely_displacements,
)
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
    "current": "I curr",
}
_PARTS = {
    "time": "time zeit elapsed runtime",
    "displacement": "displ deflec travel stroke position way weg hub dist lvdt einfeder auslenk deform laser stellung",
    "force": "force kraft load last friction reib",
    "velocity": "veloc speed geschw",
    "acceleration": "accel beschl",
    "temperature": "temper",
    "pressure": "pressure druck",
    "current": "current strom",
}
_WANTED_PARTS = (
    "command cmd target setpoint soll desired reference error abweich limit peak max min count index".split()
)
_COUNTER = re.compile(
    r"(sample|row|point|scan|data|meas\w*|run|test|cycle|file|record)?[ _-]?"
    r"(no|nr|num|number|numb|index|idx|count|id|#)\.?",
    re.I,
)

# of more columns each pair would take too long
_MOST_COLUMNS = 16

SURE, LIKELY, BY_UNIT, GUESSED = "its name and unit", "its name", "its unit", "how it moves"


@dataclass(frozen=True)
class Role:
    """A channel, the column it was found in, what told so, and other columns that it may be as well.

    ``rivals`` move as well as the column does, ``namesakes`` are called as well.
    """

    channel: str
    column: str
    by: str
    rivals: tuple[str, ...] = ()
    namesakes: tuple[str, ...] = ()


def named_roles(columns: Sequence[str], units: Mapping[str, str]) -> dict[str, Role]:
    """The best column for every channel, by name and unit; the first of several that are as good, its namesakes."""
    found: dict[str, tuple[float, Role]] = {}
    for column in columns:
        unit = units.get(column) or (column if len(column) > 1 else "")
        for channel in CHANNEL_UNITS:
            score, by = _score(column, unit, channel)
            best, role = found.get(channel, (0.0, None))
            if score > best:
                found[channel] = score, Role(channel, column, by)
            elif role is not None and score == best:
                found[channel] = score, replace(role, namesakes=(*role.namesakes, column))
    return {channel: role for channel, (_, role) in found.items()}


def _score(column: str, unit: str, channel: str) -> tuple[float, str]:
    by_name, measures = name_score(column, channel), measures_channel(unit, channel)
    if (measures is False and unit != column) or (channel != "time" and is_counter(column)):
        return 0.0, ""
    if channel == "current" and not (by_name and measures):
        # the `current position`, or a force told as 4 to 20 mA
        return 0.0, ""
    unwanted = any(part in column.lower() for part in _WANTED_PARTS)
    # columns of a matrix have its name only
    inside = re.search(r"\(\d+\)$", column) is not None
    score = by_name + (2.0 if measures else 0.0) - (3.0 if unwanted else 0.0) - (1.5 if inside else 0.0)
    return score, SURE if measures and by_name else BY_UNIT if measures else LIKELY


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
        factor(unit_meant(channel, unit), CHANNEL_UNITS[channel])
    except ValueError as error:
        return None if not unit or str(error).startswith("unknown unit") else False
    return True


def is_counter(column: str) -> bool:
    """Whether a name says that the samples are counted."""
    return _COUNTER.fullmatch(column.strip()) is not None


def motion_roles(
    columns: Mapping[str, np.ndarray], taken: Mapping[str, Role], step: float | None = None
) -> dict[str, Role]:
    """Displacement and force by their numbers: among columns with equally good names, else among those that are left.

    A column whose rate of change is another one is the displacement, the other its velocity; without such a pair one
    over which another one loses work and grows, the smoothest of several. The force is what the motion explains best.
    `step` in s is the time between two samples where it is known.
    """
    found = dict(taken)
    used = {role.column for channel, role in taken.items() if channel not in ("displacement", "force")}
    if "displacement" not in found:
        found |= _guessed_motion(columns, found, step)
    if "displacement" not in found:
        return found
    moved = [columns[found[name].column] for name in ("displacement", "velocity") if name in found]
    named = [name for name in _of(found, "displacement") if name in columns]
    if "force" in found:
        forces = [name for name in _of(found, "force") if name in columns]
    else:
        used |= {found[name].column for name in ("displacement", "velocity") if name in found}
        left = [name for name, values in columns.items() if name not in used and np.ptp(values) > 0]
        forces = [name for name in left if not is_like_any(columns[name], moved)]
    pair = best_pair(columns, named, forces)
    if pair is None:
        return found
    force = found.get("force", Role("force", pair.force, GUESSED))
    found["displacement"] = _settled(found["displacement"], pair.displacement, pair.other_displacements)
    found["force"] = _settled(force, *_force_and_rivals(pair, force.by, {name: columns[name] for name in forces}))
    return found


def _of(roles: Mapping[str, Role], channel: str) -> tuple[str, ...]:
    return (roles[channel].column, *roles[channel].namesakes)


def _settled(role: Role, column: str, rivals: Sequence[str]) -> Role:
    """A role with the column that fits best; those with the same unit alone are not called alike."""
    called = (role.column, *role.namesakes) if role.by in (SURE, LIKELY) else ()
    namesakes = tuple(name for name in called if name != column and name not in rivals)
    return replace(role, column=column, rivals=tuple(rivals), namesakes=namesakes)


def _guessed_motion(
    columns: Mapping[str, np.ndarray], taken: Mapping[str, Role], step: float | None
) -> dict[str, Role]:
    used = {role.column for role in taken.values()}
    left = {name: values for name, values in columns.items() if name not in used and np.ptp(values) > 0}
    if not left:
        return {}
    # of two columns alone the second is the force: that of a damper goes with the rate, too
    wanted = "velocity" not in taken and ("force" in taken or len(left) > 2)
    pair = _rate_pair(left, step) if wanted else None
    if pair is None:
        smoothest = min(_candidates(left, "force" in taken), key=lambda name: _roughness(left[name]))
        pair = (_largest_like(smoothest, left),)
    return {
        channel: Role(channel, name, GUESSED) for channel, name in zip(("displacement", "velocity"), pair, strict=False)
    }


def _candidates(columns: Mapping[str, np.ndarray], force_known: bool) -> list[str]:
    """The columns of which the smoothest is the displacement: what goes with the clock, as a temperature does, is none.

    It is one where hardly any column is left, as in a single slow stroke.
    """
    steady = {name: values for name, values in columns.items() if not goes_with_clock(values)}
    if len(steady) < (1 if force_known else 2):
        return list(columns)
    if force_known or len(steady) > _MOST_COLUMNS:
        return list(steady)
    return likely_displacements(steady) or list(steady)


def _force_and_rivals(pair: Pair, by: str, forces: Mapping[str, np.ndarray]) -> tuple[str, tuple[str, ...]]:
    """The force and its rivals; a column of the same signal in smaller numbers is none."""
    best = _largest_like(pair.force, forces) if by == GUESSED else pair.force
    return best, tuple(name for name in pair.rivals if name != best and not is_like(forces[best], forces[name]))


def _roughness(values: np.ndarray) -> float:
    """How much a signal changes its course from sample to sample, as a part of its size."""
    return float(np.std(np.diff(values, 2)) / np.std(values))


def _largest_like(name: str, columns: Mapping[str, np.ndarray]) -> str:
    """The same signal in the largest numbers: volts are mostly recorded beside what they stand for."""
    like = [other for other, values in columns.items() if other == name or is_like_any(values, [columns[name]])]
    return max(like, key=lambda other: float(np.ptp(columns[other])))


def _rate_pair(columns: Mapping[str, np.ndarray], step: float | None) -> tuple[str, ...] | None:
    """Two columns of which the second is the rate of change of the first.

    The force of a damper or of friction may go with the rate, too: so the sizes have to fit, if the sampling is known.
    """
    best: float = 0.9
    pair: tuple[str, ...] | None = None
    for first, values in columns.items():
        rate = np.gradient(values)
        for second, other in columns.items():
            likeness = correlation(rate, other) if first != second else 0.0
            if likeness > best and (step is None or _fits(float(np.std(other) / np.std(rate)) * step, likeness)):
                best, pair = likeness, (first, second)
    return pair


def _fits(ratio: float, likeness: float) -> bool:
    """Whether a ratio is a power of 1000, as of mm/s to m, as far as the likeness of the signals leaves open."""
    thousands = math.log(ratio) / math.log(1000.0)
    return abs(thousands - round(thousands)) * math.log(1000.0) < -2.0 * math.log(min(likeness, 0.999))

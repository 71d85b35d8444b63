"""Everything that one measured file tells about the run it holds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from dashpot.data.channel import CHANNEL_UNITS
from dashpot.data.excitation import MOVING
from dashpot.data.importing.letters import beside, symbols, weighed_roles
from dashpot.data.importing.motion import Motion, find_motion
from dashpot.data.importing.roles import GUESSED, Role, is_counter, named_roles
from dashpot.data.importing.rows import numeric, of_one_length, usable_rows, without_filling
from dashpot.data.importing.signs import falls, find_signs
from dashpot.data.importing.timing import Timing, find_timing
from dashpot.data.importing.units import GUESSED as GUESSED_UNIT
from dashpot.data.importing.units import UnitFound, find_unit
from dashpot.data.table import Table
from dashpot.text.quantity import base_unit, factor, is_unit

NEEDED = ("displacement", "force")
_FALLS = (
    "the force falls where the deflection grows: either a mass outweighs the stiffness, or displacement and force are "
    "taken for each other"
)


@dataclass(frozen=True)
class ChannelFound:
    """A channel: its column, unit and sign, and what told them; the unit that its file states."""

    role: Role
    unit: UnitFound
    sign: int = 1
    stated: str = ""


@dataclass(frozen=True)
class Level:
    """The mean of a channel or column over a run and how far its values lie apart; SI where the unit is ``known``."""

    mean: float
    spread: float
    known: bool = True


@dataclass(frozen=True, eq=False)
class Finding:
    """What a file holds.

    rows: first row and one past the last (from 0), None for all; columns: all of the file, in order; confirm: what a
    person has to look at; signals: displacement and force (n,) in SI where both were found; conditions: settings as
    texts that the name of the file states; levels: of further channels, such as the temperature, and of unused columns.
    """

    timing: Timing
    channels: Mapping[str, ChannelFound]
    kind: str
    settings: Mapping[str, float]
    rows: tuple[int, int] | None
    columns: tuple[str, ...]
    confirm: tuple[str, ...]
    signals: Mapping[str, np.ndarray] = field(default_factory=dict)
    conditions: Mapping[str, str] = field(default_factory=dict)
    levels: Mapping[str, Level] = field(default_factory=dict)

    @property
    def unused(self) -> tuple[str, ...]:
        """The columns that are no channel."""
        used = {self.timing.column, *(channel.role.column for channel in self.channels.values())}
        return tuple(name for name in self.columns if name not in used)

    def column(self, name: str) -> str | int:
        """A column as a dataset file can say it: by its name, or by its number where the name cannot be written."""
        return name if name.isprintable() and name.strip() else self.columns.index(name) + 1


# channel -> the unit of a column that states none, and the sign
Agreed = Mapping[str, tuple[str, int]]


def find_all(
    table: Table, sampling: float | None = None, agreed: Agreed | None = None, known: Mapping[str, Role] | None = None
) -> Finding:
    """What the columns of a file are, as far as names, units and numbers tell.

    `sampling` in Hz overrules the file; `agreed` holds the unit and sign of channels, `known` the columns of
    displacement and force, that other files have told. The file has to hold numbers.
    """
    every = of_one_length({name: numeric(values) for name, values in table.columns.items()})
    columns = {name: values for name, values in every.items() if np.isfinite(values).mean() > 0.5}
    roles = symbols(named_roles(list(columns), table.units), list(columns))
    time = None if sampling else roles.pop("time", None)
    timing = find_timing(_filled(columns), table.units, sampling or table.sampling, time)
    others = {name: values for name, values in _filled(columns).items() if name != timing.column}
    roles = {channel: role for channel, role in roles.items() if channel != "time"}
    sure = known is not None and all(role.column in columns for role in known.values())
    roles = beside(roles, known or {}) if sure else weighed_roles(_moving(others), roles, timing.step)
    chosen = _chosen(roles, columns)
    needed = [columns[name] for name in (timing.column, *(role.column for role in chosen.values())) if name is not None]
    rows = usable_rows(needed) if needed else (0, _length(columns))
    if needed and timing.column is None:
        rows = rows[0], min(rows[1], without_filling(columns.values()))
    cut = {name: values[slice(*rows)] for name, values in columns.items()}
    channels = {channel: _found(role, table, cut) for channel, role in chosen.items()}
    channels = _agreed(channels, agreed) if agreed else channels
    return _finding(timing, channels, cut, None if rows == (0, _length(columns)) else rows, table, agreed)


def _length(columns: Mapping[str, np.ndarray]) -> int:
    return len(next(iter(columns.values()), ()))


def _filled(columns: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The numbers with what is missing carried over from the sample before."""
    filled = {}
    for name, values in columns.items():
        sound = np.isfinite(values)
        filled[name] = np.interp(np.arange(len(values)), np.flatnonzero(sound), values[sound])
    return filled


def _moving(columns: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Without counters: what grows by one from sample to sample is no motion."""
    return {name: values for name, values in columns.items() if not np.all(np.diff(values) == 1.0)}


def _chosen(roles: Mapping[str, Role], columns: Mapping[str, np.ndarray]) -> dict[str, Role]:
    """Displacement and force, and further channels known by name that have a number everywhere."""
    return {
        channel: role
        for channel, role in roles.items()
        if channel in NEEDED or (role.by != GUESSED and np.isfinite(columns[role.column]).all())
    }


def _found(role: Role, table: Table, columns: Mapping[str, np.ndarray]) -> ChannelFound:
    values = columns[role.column]
    sound = values[np.isfinite(values)]
    stated = table.units.get(role.column, "")
    return ChannelFound(role, find_unit(role.channel, role.column, stated, sound), stated=stated)


def _agreed(channels: Mapping[str, ChannelFound], agreed: Agreed) -> dict[str, ChannelFound]:
    """With the common sign, and the common unit where there is only a guess."""
    return {
        name: ChannelFound(
            found.role,
            UnitFound(agreed[name][0], GUESSED_UNIT) if found.unit.by == GUESSED_UNIT else found.unit,
            agreed[name][1],
            found.stated,
        )
        for name, found in channels.items()
    }


def _finding(
    timing: Timing,
    found: Mapping[str, ChannelFound],
    columns: Mapping[str, np.ndarray],
    rows: tuple[int, int] | None,
    table: Table,
    agreed: Agreed | None,
) -> Finding:
    confirm = [*timing.confirm, *(remark for channel in found.values() for remark in _doubts(channel))]
    confirm += [f"no column was found for the {name}: name it under channels" for name in NEEDED if name not in found]
    channels, signals, motion = dict(found), {}, Motion("transient", {})
    if all(name in found for name in NEEDED):
        raw = {name: _filled(columns)[found[name].role.column] for name in NEEDED}
        common = None if agreed is None else (found["displacement"].sign, found["force"].sign)
        first, second, why = find_signs(raw["displacement"], raw["force"], common)
        signs = {"displacement": first, "force": second}
        confirm += [why] if why else []
        confirm += [_FALLS] if falls(signs["displacement"] * raw["displacement"], signs["force"] * raw["force"]) else []
        channels |= {name: replace(found[name], sign=signs[name]) for name in NEEDED}
        signals = {name: signs[name] * raw[name] * _scale(found[name]) for name in NEEDED}
        motion = find_motion(signals["displacement"], timing.step or 1.0)
    settings = motion.settings if timing.step else {}
    used = {timing.column, *(channel.role.column for channel in channels.values())}
    unused = {name: values for name, values in columns.items() if name not in used}
    return Finding(
        timing,
        channels,
        motion.kind,
        settings,
        rows,
        tuple(table.columns),
        tuple(confirm),
        signals,
        levels=_levels(channels, columns) | _unused_levels(unused, table.units),
    )


def _levels(channels: Mapping[str, ChannelFound], columns: Mapping[str, np.ndarray]) -> dict[str, Level]:
    levels = {}
    for name, found in channels.items():
        if name not in MOVING:
            scale, offset = factor(found.unit.unit, CHANNEL_UNITS[name])
            values = found.sign * (scale * columns[found.role.column] + offset)
            levels[name] = Level(float(np.mean(values)), float(np.ptp(values)))
    return levels


def _unused_levels(columns: Mapping[str, np.ndarray], units: Mapping[str, str]) -> dict[str, Level]:
    """Of columns that are no channel; what counts or goes on from run to run is no condition of a test."""
    levels = {}
    for name, values in columns.items():
        sound = values[np.isfinite(values)]
        steps = np.diff(sound)
        goes_on = bool(np.any(steps)) and (bool(np.all(steps >= 0)) or bool(np.all(steps <= 0)))
        if sound.size and not goes_on and not is_counter(name):
            unit = units.get(name, "")
            known = is_unit(unit)
            scale, offset = factor(unit, base_unit(unit)) if known else (1.0, 0.0)
            levels[f"'{name}'"] = Level(float(np.mean(scale * sound + offset)), scale * float(np.ptp(sound)), known)
    return levels


def _scale(channel: ChannelFound) -> float:
    return factor(channel.unit.unit, CHANNEL_UNITS[channel.role.channel])[0]


def _shown(columns: Sequence[str]) -> str:
    return ", ".join(f"'{name}'" for name in columns[:6])


def _doubts(channel: ChannelFound) -> list[str]:
    role, unit = channel.role, channel.unit
    doubts = [f"column '{role.column}' is taken for the {role.channel} by {role.by}"] if role.by == GUESSED else []
    if role.rivals:
        rivals = _shown(role.rivals)
        doubts.append(
            f"{rivals} may be the displacement, too: the force is explained about as well as by '{role.column}'"
            if role.channel == "displacement"
            else f"the motion explains {rivals} about as well as the {role.channel} '{role.column}': which is it?"
        )
    if role.namesakes:
        alike = _shown(role.namesakes)
        doubts.append(f"the {role.channel} may be {alike} after the names as well as '{role.column}': which is it?")
    if unit.by == GUESSED_UNIT and channel.stated:
        doubts.append(
            f"the {role.channel} '{role.column}' is in {channel.stated} after its file: write 'gain', by which it "
            f"becomes {unit.unit}, and 'accept: [units]'"
        )
    elif unit.by == GUESSED_UNIT:
        doubts.append(f"the {role.channel} is taken to be in {unit.unit}: no unit is stated")
    return doubts

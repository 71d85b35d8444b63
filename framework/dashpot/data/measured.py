"""From a declaration and a table to a run: the steps between a file and usable channels."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from dashpot.data.channel import Channel, unit_of_channel
from dashpot.data.checks import dead_force, missing_values, no_motion, too_short
from dashpot.data.clipping import clipped_channels
from dashpot.data.clock import Clock, lay_on_grid, read_clock
from dashpot.data.columns import common_length, find_columns, read_si
from dashpot.data.declaration import RunDeclaration
from dashpot.data.disturbance import disturbance
from dashpot.data.excitation import mean_of
from dashpot.data.resample import advance, decimate, trim
from dashpot.data.run import Run
from dashpot.data.table import Table
from dashpot.data.trouble import Trouble, Unusable, refuse


@dataclass(frozen=True, eq=False)
class _Piece:
    """The part of a file that makes a run: row numbers (from 0), time and channels of the same length."""

    rows: np.ndarray
    time: np.ndarray
    channels: dict[str, np.ndarray]

    def cut(self, keep: np.ndarray) -> _Piece:
        channels = {name: values[keep] for name, values in self.channels.items()}
        return _Piece(self.rows[keep], self.time[keep], channels)


def read_run(declaration: RunDeclaration, table: Table) -> tuple[Run, list[Trouble]]:
    """The run that a declaration describes, and warnings. Raises Unusable with the reasons to set it aside."""
    piece = _take_piece(declaration, table)

    def where(sample: int) -> str:
        return table.where(int(piece.rows[sample]))

    refuse(too_short(piece.rows.size))
    refuse([trouble for name, values in piece.channels.items() for trouble in missing_values(name, values, where)])
    clock = read_clock(piece.time, where) if declaration.time else Clock(1.0 / _sampling(declaration, table))
    found = [] if "clipping" in declaration.accept else clipped_channels(piece.channels, declaration.kind, where)
    refuse(no_motion(piece.channels) + found)
    step, channels = _even_channels(declaration, clock, piece)
    refuse(too_short(next(iter(channels.values())).size))
    warnings = _warnings(clock) + dead_force(channels)
    return _make_run(declaration, step, clock.remark is not None, channels), warnings


def _take_piece(declaration: RunDeclaration, table: Table) -> _Piece:
    clocks = (declaration.time,) if declaration.time else ()
    declared = (*clocks, *declaration.channels)
    columns = find_columns(table, declared)
    rows = _choose_rows(declaration, common_length(table, columns))
    channels = _read_channels(declaration, table, columns, rows, declared)
    time = channels.pop("time", None)
    piece = _Piece(rows, rows / _sampling(declaration, table) if time is None else time, channels)
    refuse(missing_values("time", piece.time, lambda sample: table.where(int(rows[sample]))))
    return piece.cut(_within(declaration, piece.time))


def _choose_rows(declaration: RunDeclaration, count: int) -> np.ndarray:
    first, last = declaration.rows
    last = count if last is None else last
    if last > count or first > count:
        message = f"it has {count} rows, 'rows' asks for {first} to {last}"
        raise Unusable([Trouble(message, "rows count from 1, without the header", declaration.place("rows"))])
    return np.arange(first - 1, last)


def _read_channels(
    declaration: RunDeclaration, table: Table, columns: dict[str, str], rows: np.ndarray, declared: tuple[Channel, ...]
) -> dict[str, np.ndarray]:
    channels: dict[str, np.ndarray] = {}
    troubles: list[Trouble] = []
    for channel in declared:
        try:
            channels[channel.name] = read_si(table, channel, columns[channel.name], rows, declaration.accept)
        except Unusable as error:
            troubles += error.troubles
    refuse(troubles)
    return channels


def _sampling(declaration: RunDeclaration, table: Table) -> float:
    sampling = declaration.sampling or table.sampling
    if not sampling:
        hint = "add 'time: {column: ..., unit: s}' to its channels, or 'sampling: ... Hz'"
        raise Unusable([Trouble("it has no time: no time channel, no sampling rate", hint)])
    return sampling


def _within(declaration: RunDeclaration, time: np.ndarray) -> np.ndarray:
    start = -np.inf if declaration.start is None else declaration.start - 1e-9
    stop = np.inf if declaration.stop is None else declaration.stop + 1e-9
    keep = (time >= start) & (time <= stop)
    if time.size and not keep.any():
        message = f"'start' and 'stop' leave nothing of its {time.min():.6g} to {time.max():.6g} s"
        raise Unusable([Trouble(message, "give them in the time of the file", declaration.place("start"))])
    return keep


def _even_channels(declaration: RunDeclaration, clock: Clock, piece: _Piece) -> tuple[float, dict[str, np.ndarray]]:
    """Sample time and channels on one even grid, delays taken out, decimated, without drift and hum."""
    channels = dict(piece.channels)
    if clock.remark:
        channels = {name: lay_on_grid(piece.time, values, clock.step) for name, values in channels.items()}
    shifts = {channel.name: channel.delay / clock.step for channel in declaration.channels}
    if any(shifts.values()):
        channels = _without_delays(channels, shifts)
    if declaration.decimate > 1:
        channels = {name: decimate(values, declaration.decimate) for name, values in channels.items()}
    step = clock.step * declaration.decimate
    for channel in declaration.channels:
        if channel.drift or channel.hum:
            shown = channels[channel.name]
            channels[channel.name] = shown - disturbance(channel.drift, channel.hum, step, shown.size)
    return step, channels


def _without_delays(channels: dict[str, np.ndarray], shifts: dict[str, float]) -> dict[str, np.ndarray]:
    count = next(iter(channels.values())).size
    kept = trim(count, list(shifts.values()))
    if kept.stop - kept.start < count // 2:
        longest = max(abs(shift) for shift in shifts.values())
        raise Unusable(
            [Trouble(f"a delay of {longest:.0f} samples leaves too little of its {count}", "check the delay")]
        )
    moved = {name: advance(values, shifts[name]) if shifts[name] else values for name, values in channels.items()}
    return {name: values[kept] for name, values in moved.items()}


def _warnings(clock: Clock) -> list[Trouble]:
    hint = "record at a constant rate where it matters"
    return [Trouble(clock.remark, hint, severity="warning")] if clock.remark else []


@lru_cache(maxsize=4)
def _even_time(step: float, count: int) -> np.ndarray:
    # runs that were sampled alike share it
    return step * np.arange(count)


def _make_run(declaration: RunDeclaration, step: float, uneven: bool, channels: dict[str, np.ndarray]) -> Run:
    count = next(iter(channels.values())).size
    run = Run(
        name=declaration.name,
        kind=declaration.kind,
        time=_even_time(step, count),
        channels={name: np.ascontiguousarray(values) for name, values in channels.items()},
        settings=declaration.settings,
        repeats=declaration.repeats,
        group=declaration.name,
        held_out=declaration.held_out,
        sensors=declaration.sensors,
        source=declaration.file,
        order=declaration.order,
        notes=declaration.notes,
        units={**declaration.units, **{mean_of(each.name): _told(each) for each in declaration.channels}},
        uneven=uneven,
        accept=declaration.accept,
    )
    for values in (run.time, *run.channels.values()):
        values.flags.writeable = False
    return run


def _told(channel: Channel) -> str:
    """The unit in which a channel is told; nothing where its name does not say what is measured, nor the dataset."""
    return channel.unit or unit_of_channel(channel.name) or ""

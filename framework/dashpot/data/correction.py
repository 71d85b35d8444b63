"""What was wrong with the channels of single runs, and the dataset file that puts it right."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.channel import Channel, unit_of_channel
from dashpot.data.dataset import Dataset
from dashpot.data.declaration import RunDeclaration
from dashpot.data.description import Description, read_description
from dashpot.data.disturbance import Hum, disturbance
from dashpot.data.excitation import channel_at
from dashpot.data.resample import advance, trim
from dashpot.data.run import Run
from dashpot.data.run_entries import list_runs, with_entry, with_head
from dashpot.data.source import Source
from dashpot.text.document import Document
from dashpot.text.inserting import plain_or_quoted
from dashpot.text.problem import InputError, Place, nearest

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Correction:
    """corrected(t) = gain * force(t + delay) - offset - drift * t / T - hum(t), as a channel of a dataset file says it.

    `offset` and `drift` in N are what the channel showed too much, `drift` at the end T of the run, growing from 0;
    `delay` in s is by how much it was late; `hum` is empty or holds (Hz, N, N) of each line, one behind the other:
    frequency, cosine and sine by the time t of the corrected run. `displacement_gain` multiplies the displacement.

    Examples:
        >>> dp.Correction(gain=1.02, offset=5.0).then(dp.Correction(gain=0.5)).gain
        0.51
    """

    gain: float = 1.0
    offset: float = 0.0
    drift: float = 0.0
    delay: float = 0.0
    hum: tuple[float, ...] = ()
    displacement_gain: float = 1.0

    @property
    def lines(self) -> tuple[Hum, ...]:
        """The hum as a channel has it."""
        return tuple(Hum(*self.hum[first : first + 3]) for first in range(0, len(self.hum), 3))

    def then(self, other: Correction) -> Correction:
        """This and another one, found beside it, of whatever was too much before the gain; without delays."""
        gain = self.gain * other.gain
        hum = [*self.hum, *other.hum]
        scaled = [value if number % 3 == 0 else gain * value for number, value in enumerate(hum)]
        offset, drift = gain * (self.offset + other.offset), gain * (self.drift + other.drift)
        return Correction(gain, offset, drift, 0.0, tuple(scaled), self.displacement_gain * other.displacement_gain)

    def kept(self, samples: int, dt: float) -> slice:
        """The samples of a run that are left: a delay costs some at one end."""
        return trim(samples, [self.delay / dt])

    def apply(self, force: Array, dt: float) -> Array:
        """The corrected force (samples that are left,) in N of one (samples,) that was read with a step of `dt` s."""
        moved = self.gain * np.asarray(force, dtype=float)
        if self.delay:
            moved = advance(moved, self.delay / dt)[self.kept(moved.size, dt)]
        return moved - self.offset - disturbance(self.drift, self.lines, dt, moved.size)


def corrected_run(run: Run, correction: Correction) -> Run:
    """The run with its channels corrected; all of them lose the samples that the force loses.

    Of a run that was taken apart, `run@node`, they are those at its own node.
    """
    kept = correction.kept(run.time.size, run.sample_time)
    force = correction.apply(run.force, run.sample_time)
    right = {"force": force, "displacement": correction.displacement_gain * run.displacement[kept]}
    channels = {name: values[kept] for name, values in run.channels.items()} | right
    if run.end:
        channels |= {channel_at(name, run.end): values for name, values in right.items()}
    return replace(run, time=run.time[: force.size], channels=channels)


def corrected_text(
    dataset: Dataset, corrections: Mapping[str, Correction], set_aside: Mapping[str, str], folder: Path
) -> str:
    """The text of a dataset file to be written into `folder`, with runs corrected or set aside for a reason.

    Everything else stays as it is, comments too; `folder:` says where the measured files lie. What a run is corrected
    by already is taken into account. Runs are called as in the dataset, `run@node` for the force at a node. Where a
    channel of the run has a delay already, or the run is decimated, a further delay is as exact as interpolation is.
    Raises InputError for a dataset made in memory, an unknown run, a run without a force, and one whose channels cannot
    be written in place.
    """
    if dataset.document is None or dataset.folder is None:
        hint = "write it into files first, as `write_dataset` does"
        raise InputError.at(Place(), f"the dataset '{dataset.name}' was made in memory: it has no file", hint)
    text = list_runs(dataset.document, dataset.name, dataset.file)
    text = with_head(text, "folder", _path_from(folder, dataset.folder))
    before = _describe(text, dataset)
    wanted: dict[str, dict[str, Channel]] = {}
    for name, correction in corrections.items():
        declaration, channel = _channel_of(name, "force", before.declarations, dataset)
        known = wanted.setdefault(declaration.name, {})
        run = _measured(declaration.name, dataset)
        known[channel.name] = _composed(channel, correction, run.sample_time, run.time.size)
        if correction.displacement_gain != 1.0:
            _, channel = _channel_of(name, "displacement", before.declarations, dataset)
            moved = Correction(gain=correction.displacement_gain)
            known[channel.name] = _composed(channel, moved, run.sample_time, run.time.size)
    for name, channels in wanted.items():
        for channel in channels.values():
            text = _with_channel(text, _declaration(name, before.declarations, dataset), channel)
    for name, reason in set_aside.items():
        order = _declaration(name, before.declarations, dataset).order
        text = with_entry(text, order, ("set_aside",), plain_or_quoted(reason))
    _check(before, _describe(text, dataset), wanted, set_aside, dataset)
    return text


def _path_from(folder: Path, measured: Path) -> str:
    try:
        return Path(os.path.relpath(measured.resolve(), folder.resolve())).as_posix()
    except ValueError:
        # on another drive
        return measured.resolve().as_posix()


def _describe(text: str, dataset: Dataset) -> Description:
    assert dataset.document is not None and dataset.folder is not None
    document = Document.parse(text, dataset.document.file)
    return read_description(document, Source(Path(document.file or ""), dataset.folder))


def _measured(name: str, dataset: Dataset) -> Run:
    return next((run for run in dataset.runs if run.record == name), None) or dataset.run(name)


def _declaration(name: str, declarations: tuple[RunDeclaration, ...], dataset: Dataset) -> RunDeclaration:
    by_name = {declaration.name: declaration for declaration in declarations}
    for known in (name, name.rpartition("@")[0]):
        if known in by_name:
            return by_name[known]
    raise InputError.at(Place(), f"the dataset '{dataset.name}' has no run '{name}'", nearest(name, by_name))


def _channel_of(
    name: str, quantity: str, declarations: tuple[RunDeclaration, ...], dataset: Dataset
) -> tuple[RunDeclaration, Channel]:
    declaration = _declaration(name, declarations, dataset)
    node = name.removeprefix(declaration.name).removeprefix("@")
    channels = {channel.name: channel for channel in declaration.channels}
    wanted = channel_at(quantity, node)
    if wanted not in channels:
        raise InputError.at(
            declaration.place("channels"),
            f"run '{declaration.name}' has no channel '{wanted}'",
            nearest(wanted, channels) or f"it has: {', '.join(channels)}",
        )
    return declaration, channels[wanted]


def _composed(channel: Channel, correction: Correction, dt: float, samples: int) -> Channel:
    """A channel that is corrected by what it says, and then once more; of a run with a step of `dt` as it was read."""
    kept, gain = correction.kept(samples, dt), correction.gain
    # the corrected run begins so much later on the clock of the run
    later = kept.start * dt + correction.delay
    rate = gain * channel.drift / ((samples - 1) * dt)
    lines = [Hum(line.frequency, gain * line.cosine, gain * line.sine) for line in channel.hum]
    return replace(
        channel,
        gain=gain * channel.gain,
        offset=gain * channel.offset + correction.offset + rate * later,
        delay=channel.delay + correction.delay,
        drift=rate * (kept.stop - kept.start - 1) * dt + correction.drift,
        hum=_summed([*(_turned(line, later) for line in lines), *correction.lines]),
    )


def _turned(line: Hum, later: float) -> Hum:
    phase = 2.0 * math.pi * line.frequency * later
    cosine, sine = math.cos(phase), math.sin(phase)
    return Hum(line.frequency, line.cosine * cosine + line.sine * sine, line.sine * cosine - line.cosine * sine)


def _summed(lines: list[Hum]) -> tuple[Hum, ...]:
    found: dict[float, Hum] = {}
    for line in lines:
        known = found.get(line.frequency, Hum(line.frequency, 0.0, 0.0))
        found[line.frequency] = Hum(line.frequency, known.cosine + line.cosine, known.sine + line.sine)
    return tuple(found.values())


def _with_channel(text: str, declaration: RunDeclaration, wanted: Channel) -> str:
    known = next(channel for channel in declaration.channels if channel.name == wanted.name)
    unit = unit_of_channel(wanted.name) or "1"
    for key, entry in _entries(known, wanted, unit):
        text = with_entry(text, declaration.order, ("channels", wanted.name, key), entry, column=wanted.column)
    return text


def _entries(known: Channel, wanted: Channel, unit: str) -> Iterator[tuple[str, str]]:
    units = {"gain": "1", "offset": unit, "delay": "s", "drift": unit}
    for key, own in units.items():
        if getattr(known, key) != getattr(wanted, key):
            yield key, _number(getattr(wanted, key), own)
    if known.hum != wanted.hum:
        lines = [
            ", ".join(
                f"{field.name}: {_number(getattr(line, field.name), own)}"
                for field, own in zip(fields(Hum), ("Hz", unit, unit), strict=True)
            )
            for line in wanted.hum
        ]
        yield "hum", f"{{{lines[0]}}}" if len(lines) == 1 else f"[{', '.join(f'{{{line}}}' for line in lines)}]"


def _number(value: float, unit: str) -> str:
    """All digits: what is read back is the same number."""
    return f"{float(value)!r} {unit}".removesuffix(" 1")


def _check(
    before: Description,
    after: Description,
    wanted: Mapping[str, Mapping[str, Channel]],
    set_aside: Mapping[str, str],
    dataset: Dataset,
) -> None:
    """InputError where the new text does not say what it should, as of a channel that mixes with the defaults."""
    told = {problem.message for problem in before.problems}
    found = [problem for problem in after.problems if problem.message not in told]
    if found:
        raise InputError(found)
    for name, channels in wanted.items():
        declaration = _declaration(name, after.declarations, dataset)
        said = {channel.name: _meaning(channel) for channel in declaration.channels}
        for channel in channels.values():
            if said[channel.name] != _meaning(channel):
                raise InputError.at(
                    channel.place,
                    f"run '{name}': its channel '{channel.name}' cannot be corrected in place",
                    "write the channel with its column and unit at the run",
                )
    for name, reason in set_aside.items():
        assert _declaration(name, after.declarations, dataset).set_aside == reason


def _meaning(channel: Channel) -> dict[str, Any]:
    return {field.name: getattr(channel, field.name) for field in fields(Channel) if field.name != "place"}

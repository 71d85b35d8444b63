"""How a column of a measurement file becomes a channel: what the dataset file says about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from dashpot.data.disturbance import Hum, read_hum
from dashpot.text.form import Form, read_integer, read_text
from dashpot.text.node import Node, Scalar
from dashpot.text.problem import Place
from dashpot.text.quantity import base_unit, factor

# the SI unit of what is measured, by the part of the channel's name before '@'
CHANNEL_UNITS = {
    "time": "s",
    "displacement": "m",
    "force": "N",
    "velocity": "m/s",
    "acceleration": "m/s^2",
    "temperature": "K",
    "pressure": "Pa",
    "current": "A",
}


@dataclass(frozen=True)
class Channel:
    """SI value = sign * gain * (number in `unit`, brought to SI) - offset - drift * t / T - hum(t).

    t is the time of the run as it was read, from 0 at its first sample to T at its last one: `drift` is what the zero
    has moved by at the end. `delay` is the time in s by which the channel lags behind; `unit` None means the unit that
    the file states, and SI where it states none.
    """

    name: str
    column: str | int
    place: Place
    unit: str | None = None
    sign: float = 1.0
    gain: float = 1.0
    offset: float = 0.0
    delay: float = 0.0
    drift: float = 0.0
    hum: tuple[Hum, ...] = ()


def unit_meant(channel: str, written: str) -> str:
    """The unit that a measured file means with what it writes: `g` and `G` of an acceleration are standard gravities.

    Examples:
        >>> unit_meant("acceleration@hub", "g"), unit_meant("force", "kN")
        ('g0', 'kN')
    """
    return "g0" if channel.partition("@")[0] == "acceleration" and written in ("g", "G") else written


def unit_of_channel(name: str) -> str | None:
    """The SI unit of a channel, None when its name does not say what is measured."""
    return CHANNEL_UNITS.get(name.partition("@")[0])


def read_channels(form: Form) -> tuple[Channel | None, float | None, tuple[Channel, ...]]:
    """The time channel, the sampling rate in Hz and the other channels that a run declares."""
    below = form.form("channels")
    sampling = form.quantity("sampling", "Hz", None)
    if below is None:
        return None, sampling, ()
    within = below.quantity("sampling", "Hz", None)
    channels = {name: _read_channel(below, name) for name in below.rest}
    time = channels.pop("time", None)
    sampling = within if sampling is None else sampling
    _check_clock(form, "time" in below, sampling)
    _check_ends(form, channels)
    return time, sampling, tuple(channel for channel in channels.values() if channel)


def _check_clock(form: Form, has_time: bool, sampling: float | None) -> None:
    if sampling is not None and not sampling > 0:
        form.complain("sampling", f"{form.what}: expected a sampling rate above 0, got {sampling:g} Hz")
    if has_time and sampling is not None:
        form.complain("channels", f"{form.what} has a time channel and a sampling rate", "remove one of them")


def _check_ends(form: Form, channels: Mapping[str, Channel | None]) -> None:
    if any("@" in name for name in channels):
        return
    for name in ("displacement", "force"):
        if name not in channels:
            declared = ", ".join(f"'{other}'" for other in channels) or "nothing"
            hint = f"add '{name}: {{column: ..., unit: {CHANNEL_UNITS[name]}}}'; declared here: {declared}"
            form.complain("channels", f"{form.what} has no channel '{name}'", hint)


def _read_channel(below: Form, name: str) -> Channel | None:
    node = below.node(name)
    if isinstance(node, Scalar):
        column = below.take(name, read_column)
        return None if column is None else Channel(name, column, node.place)
    form = Form(node, below.problems, f"the channel '{name}'")
    unit = form.text("unit", None)
    kind = _kind(form, name, unit)
    channel = Channel(
        name=name,
        column=form.take("column", read_column),
        place=form.place_of("column"),
        unit=unit,
        sign=form.take("sign", _read_sign, 1.0),
        gain=form.quantity("gain", "1", 1.0),
        offset=form.quantity("offset", kind, 0.0),
        delay=form.quantity("delay", "s", 0.0),
        drift=0.0 if name == "time" else form.quantity("drift", kind, 0.0),
        hum=()
        if name == "time"
        else form.take("hum", partial(read_hum, unit=kind, what=form.what, problems=form.problems), ()),
    )
    form.close()
    return channel


def _kind(form: Form, name: str, unit: str | None) -> str:
    """The SI unit of a channel; its declared unit has to be of that kind."""
    known = unit_of_channel(name)
    try:
        if known and unit:
            factor(unit, known)
        return known or base_unit(unit or "1")
    except ValueError as error:
        form.complain("unit", f"{form.what}: {error}")
        return known or "1"


def read_column(node: Node) -> str | int:
    """A column by its name or its number from 1. ValueError for anything else."""
    if isinstance(node, Scalar) and isinstance(node.value, int) and not isinstance(node.value, bool):
        return node.value
    return read_text(node)


def _read_sign(node: Node) -> float:
    sign = read_integer(node)
    if sign not in (1, -1):
        raise ValueError(f"expected 1 or -1, got {sign}; any other factor is a 'gain'")
    return float(sign)

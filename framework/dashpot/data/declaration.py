"""What a dataset file says about a run, before any measurement is read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from dashpot.data.channel import Channel, read_channels, unit_of_channel
from dashpot.data.inherit import inherit
from dashpot.data.run import KINDS, OTHER_WORDS
from dashpot.text.form import Form, read_integer, read_items, read_text
from dashpot.text.name import RULE, is_name, shown
from dashpot.text.node import Mapping as MappingNode
from dashpot.text.node import Node, Scalar
from dashpot.text.problem import Place, Problem
from dashpot.text.quantity import measure, unit_of

SETTING_UNITS = {
    "amplitude": "m",
    "preload": "m",
    "start": "Hz",
    "stop": "Hz",
    "frequency": "Hz",
    "added_mass": "kg",
    "reached": "m",
}

SENSOR_KEYS = {
    "gain": "largest error of the factor",
    "zero": "largest error of the zero, in the unit of the channel",
    "delay": "largest delay",
    "noise": "root mean square of the noise, in the unit of the channel",
    "compliance": "largest compliance of the load cell with its fixture",
}

# what a dataset may declare as known and harmless: values at the end of the range, units that differ from the file's
ACCEPTABLE = ("clipping", "units", "triage")


@dataclass(frozen=True)
class RunDeclaration:
    """Everything said about one run. `set_aside` is why it is not read, None where it is.

    `rows` counts from 1, both ends included; `start` and `stop` are in s.
    """

    name: str
    file: str
    kind: str
    time: Channel | None
    sampling: float | None
    channels: tuple[Channel, ...]
    settings: Mapping[str, float]
    notes: Mapping[str, str]
    units: Mapping[str, str]
    repeats: str | None
    held_out: bool | None
    set_aside: str | None
    sensors: Mapping[str, Mapping[str, float]]
    rows: tuple[int, int | None]
    start: float | None
    stop: float | None
    decimate: int
    reader: str | None
    file_options: Mapping[str, object]
    accept: tuple[str, ...]
    order: int
    places: Mapping[str, Place]

    def place(self, key: str) -> Place:
        """Where the value of a key stands; the run itself when it has no such key."""
        return self.places.get(key, self.places[""])


def read_declaration(
    node: Node, defaults: MappingNode | None, file: str | None, order: int
) -> tuple[RunDeclaration | None, list[Problem]]:
    """The declaration of a run and the problems of its text; None when there are any.

    `file` is the measurement file when the run names none.
    """
    problems: list[Problem] = []
    form = Form(inherit(node, defaults), problems, _title(node, file, order))
    if not isinstance(node, MappingNode):
        return None, problems
    declaration = _read(form, file, order)
    form.close()
    return (None if problems else declaration), problems


def name_of(node: Node, file: str | None) -> str | None:
    """The name of the run that a node declares, right or wrong; None when it says nothing of the kind."""
    entries = node.entries if isinstance(node, MappingNode) else {}
    for key in ("name", "file"):
        named = entries.get(key)
        if isinstance(named, Scalar) and named.written:
            return named.written if key == "name" else stem_of(named.written)
    return stem_of(file) if file else None


def _title(node: Node, file: str | None, order: int) -> str:
    name = name_of(node, file)
    return f"the run number {order + 1}" if name is None else f"the run '{name}'"


def _read(form: Form, file: str | None, order: int) -> RunDeclaration:
    path = form.text("file") if file is None else form.text("file", file)
    time, sampling, channels = read_channels(form)
    settings, notes, units = read_settings(form)
    return RunDeclaration(
        name=read_name(form, path),
        file=path,
        kind=form.choice("kind", KINDS, meant=OTHER_WORDS),
        time=time,
        sampling=sampling,
        channels=channels,
        settings=settings,
        notes=notes,
        units=units,
        repeats=form.text("repeats", None),
        held_out=form.flag("held_out", None),
        set_aside=form.text("set_aside", None),
        sensors=_read_sensors(form),
        rows=form.take("rows", _read_rows, (1, None)),
        start=form.quantity("start", "s", None),
        stop=form.quantity("stop", "s", None),
        decimate=form.take("decimate", _read_decimation, 1),
        reader=form.text("reader", None),
        file_options=form.take("file_options", read_file_options, {}),
        accept=form.take("accept", _read_accepted, ()),
        order=order,
        places={key: form.place_of(key) for key in form.keys} | {"": form.place},
    )


def read_name(form: Form, path: str | None) -> str:
    """The name of what a form declares, by default that of its file; one that cannot name a file is complained of."""
    name = form.text("name", stem_of(path or "run"))
    if not is_name(name):
        form.complain("name", f"{shown(name)} cannot be the name of a run", RULE)
    return name


def stem_of(file: str) -> str:
    """The name of a file without folders and endings: the name of a run that has none."""
    return file.replace("\\", "/").rpartition("/")[2].partition(".")[0] or "run"


def read_settings(form: Form) -> tuple[dict[str, float], dict[str, str], dict[str, str]]:
    """The settings that are numbers, in SI, those that are words, and the units in which free numbers are told."""
    below = form.form("settings", default=None)
    settings: dict[str, float] = {}
    notes: dict[str, str] = {}
    units: dict[str, str] = {}
    for key in below.keys if below else ():
        if key in SETTING_UNITS:
            settings[key] = below.quantity(key, SETTING_UNITS[key])
        else:
            value, unit = below.take(key, _read_free_setting, ("", ""))
            if isinstance(value, str):
                notes[key] = value
            else:
                settings[key], units[key] = value, unit
    return settings, notes, units


def _read_free_setting(node: Node) -> tuple[float | str, str]:
    """A number in SI and its unit, or a word."""
    text = read_text(node)
    try:
        return measure(text), unit_of(text)
    except ValueError:
        return text, ""


def _read_sensors(form: Form) -> dict[str, dict[str, float]]:
    return {channel: _read_sensor(sensor, channel) for channel, sensor in form.named("sensors", {}).items()}


def _read_sensor(form: Form, channel: str) -> dict[str, float]:
    unit = unit_of_channel(channel) or "1"
    units = {"gain": "1", "delay": "s", "compliance": "m/N"}
    read = {key: form.quantity(key, units.get(key, unit), None) for key in SENSOR_KEYS}
    form.close()
    return {key: value for key, value in read.items() if value is not None}


def _read_rows(node: Node) -> tuple[int, int | None]:
    items = read_items(node)
    if len(items) != 2:
        raise ValueError(f"expected [first, last], got {node.describe()}")
    first = read_integer(items[0])
    last = None if isinstance(items[1], Scalar) and items[1].value is None else read_integer(items[1])
    if first < 1 or (last is not None and last <= first):
        raise ValueError(f"expected [first, last] counted from 1, got [{first}, {last}]")
    return first, last


def _read_decimation(node: Node) -> int:
    number = read_integer(node)
    if not 1 <= number <= 1000:
        raise ValueError(f"expected a whole number from 1 to 1000, got {number}")
    return number


def _read_accepted(node: Node) -> tuple[str, ...]:
    words = tuple(read_text(item) for item in read_items(node))
    for word in words:
        if word not in ACCEPTABLE:
            raise ValueError(f"expected some of {', '.join(ACCEPTABLE)}, got '{word}'")
    return words


def read_file_options(node: Node) -> dict[str, object]:
    """What the reader of a file should know. ValueError for anything but a mapping."""
    if not isinstance(node, MappingNode):
        raise ValueError(f"expected options as 'key: value', got {node.describe()}")
    return node.plain()

"""The JSON schema of a dataset file, and of the file that stands beside a single measurement."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from dashpot.data.channel import CHANNEL_UNITS
from dashpot.data.declaration import ACCEPTABLE, SENSOR_KEYS, SETTING_UNITS
from dashpot.data.description import FORMAT
from dashpot.data.run import KINDS
from dashpot.data.stiffness_table import UNITS
from dashpot.text import schema as s
from dashpot.text.schema import Schema

NEEDED = ("file", "kind", "channels")
# the formats that can be read, each with its options and their meaning
Readers = Mapping[str, Mapping[str, str]]


def dataset_schema(readers: Readers) -> Schema:
    """The schema of a dataset file; ``readers`` are the formats with their options."""
    head = {
        "format": s.choice((FORMAT,)),
        "name": s.text("the name of the dataset"),
        "folder": s.text("where the measured files lie, if not beside this file"),
        "references": s.named(_reference(), "by the path of the parameter: no fit sees them, reports show them"),
    }
    many = s.mapping(
        {**head, "sensors": _sensors(), "defaults": s.part("defaults"), "runs": {"type": "array"}}, ("format",)
    )
    many["properties"]["tables"] = s.items(_table(readers), "of dynamic stiffness; every row is a run")
    many["anyOf"] = [{"required": ["runs"]}, {"required": ["tables"]}]
    many |= {
        "if": {"required": ["defaults"]},
        "then": {"properties": {"runs": s.items(s.part("partial_run"))}, "allOf": [_said(key) for key in NEEDED]},
        "else": {"properties": {"runs": s.items(s.part("run"))}},
    }
    alone = s.mapping({**head, **_run_keys(readers, "channels")}, ("format", "kind", "channels"))
    keys = _run_keys(readers, "partial_channels")
    parts = {
        "run": s.mapping(_run_keys(readers, "channels"), NEEDED),
        "partial_run": s.mapping(keys),
        "defaults": s.mapping(keys, about="for every run that does not say it itself"),
        "channels": _channels("column"),
        "partial_channels": _channels(),
    }
    about = "Measured runs and what their files hold. Without 'runs': the only run, beside whose file this text stands."
    return s.document("dataset", about, s.by_key({"runs": many, "tables": many}, alone), parts)


def _reference() -> Schema:
    by = {"by": s.text("how it was measured")}
    number = s.mapping({"value": s.quantity("", "with its unit"), **by}, ("value",))
    curve = {
        key: s.items(s.quantity(unit), s.in_unit(about, unit), minItems=2)
        for key, unit, about in (("velocity", "m/s", "growing"), ("force", "N", "one for each velocity"))
    }
    return s.by_key({"value": number}, s.mapping({**curve, **by}, ("velocity", "force")))


def _table(readers: Readers) -> Schema:
    column = {**s.text(), "description": "its name in the file, or its number from 1"}
    one = {
        "if": {"type": "object"},
        "then": s.mapping({"column": column, "unit": s.text("that of the file")}),
        "else": column,
    }
    keys = {
        "name": s.text("by default that of the file"),
        "file": s.text("in the folder of the dataset or below it"),
        "columns": {
            "type": "object",
            "properties": dict.fromkeys(UNITS, one),
            "additionalProperties": one,
            "description": "which column is what; other names are settings of the rows",
        },
        "settings": _settings(),
        "static": s.mapping(
            {
                key: s.items(s.quantity(unit), s.in_unit("growing", unit), minItems=2)
                for key, unit in (("deflection", "m"), ("force", "N"))
            },
            ("deflection", "force"),
            "the static curve, by which preloads told as forces become deflections",
        ),
        "scatter": s.text("standard deviation of the stiffness, as 3 N/mm or 2 %: rows count by it"),
        "held_out": s.flag("keep it out of every fit"),
        "reader": s.choice(tuple(readers), "the format of the file, where its ending does not say it"),
        "file_options": _file_options(readers),
    }
    return s.mapping(keys, ("file", "columns"))


def _said(key: str) -> Schema:
    """What every run needs stands under the defaults or under each run."""
    each = {"properties": {"runs": {"items": {"required": [key]}}}}
    return {"if": {"properties": {"defaults": {"required": [key]}}}, "else": each}


def _run_keys(readers: Readers, channels: str) -> dict[str, Schema]:
    return {
        "name": s.text("by default that of the file"),
        "file": s.text("in the folder of the dataset or below it"),
        "kind": s.choice(KINDS, "what kind of test it is"),
        "channels": s.part(channels, "which column is what"),
        "sampling": s.quantity("Hz", "in place of a time channel"),
        "settings": _settings(),
        "repeats": s.text("the run that this one repeats"),
        "held_out": s.flag("keep it out of every fit"),
        "set_aside": s.text("why the run is not read"),
        "sensors": _sensors(),
        "rows": {
            "type": "array",
            "items": [s.integer(minimum=1), {"type": ["integer", "null"]}],
            "minItems": 2,
            "maxItems": 2,
            "description": "[first, last] from 1; null: to the end",
        },
        "start": s.quantity("s", "from this time on"),
        "stop": s.quantity("s", "up to this time"),
        "decimate": s.integer("every n-th sample after a low-pass", minimum=1, maximum=1000),
        "reader": s.choice(tuple(readers), "the format of the file, where its ending does not say it"),
        "file_options": _file_options(readers),
        "accept": s.items(s.choice(ACCEPTABLE), "what is known and harmless"),
    }


def _file_options(readers: Readers) -> Schema:
    """What any reader may be told; which of it a file takes depends on its format, and reading checks it."""
    meanings: dict[str, list[str]] = {}
    for word, options in readers.items():
        for key, meaning in options.items():
            meanings.setdefault(key, []).append(f"{word}: {meaning}")
    properties = {key: {"description": "; ".join(said)} for key, said in meanings.items()}
    return {"type": "object", "properties": properties, "description": "what the reader should know"}


def _settings() -> Schema:
    known = {key: s.quantity(unit, "of the test") for key, unit in SETTING_UNITS.items()}
    return {
        "type": "object",
        "properties": known,
        "additionalProperties": s.text(),
        "description": "of the test; any others may be added",
    }


def _sensors() -> Schema:
    return s.named(
        s.mapping({key: s.quantity("", about) for key, about in SENSOR_KEYS.items()}),
        "the data sheet of each channel: an error within it is ordinary",
    )


def _channels(*required: str) -> Schema:
    known = {name: _channel(unit, required) for name, unit in CHANNEL_UNITS.items()}
    found = {
        "type": "object",
        "properties": {"sampling": s.quantity("Hz", "in place of a time channel"), **known},
        "additionalProperties": _channel("", required),
    }
    if not required:
        return found
    at_nodes = {"not": {"propertyNames": {"pattern": "^[^@]*$"}}}
    return {**found, "anyOf": [{"required": ["displacement", "force"]}, at_nodes]}


def _hum(unit: str) -> Schema:
    keys = {"frequency": s.quantity("Hz"), **{key: s.quantity(unit) for key in ("cosine", "sine")}}
    return s.mapping(keys, ("frequency",), "taken off: cosine * cos(2 pi f t) + sine * sin(2 pi f t)")


def _channel(unit: str, required: Collection[str]) -> Schema:
    column = {**s.text(), "description": "its name in the file, or its number from 1"}
    keys = {
        "column": column,
        "unit": s.text("that of the file" + (f", of the kind of {unit}" if unit else "")),
        "sign": {"enum": [1, -1]},
        "gain": s.quantity("1", "value = sign * gain * number - offset"),
        "offset": s.quantity(unit, "value = sign * gain * number - offset"),
        "delay": s.quantity("s", "by how much the channel is late"),
        "drift": s.quantity(unit, "what the zero has moved by at the end of the run: taken off in proportion to time"),
        "hum": {"if": {"type": "array"}, "then": s.items(_hum(unit)), "else": _hum(unit)},
    }
    return {
        "if": {"type": "object"},
        "then": s.mapping(keys, required),
        "else": column,
    }

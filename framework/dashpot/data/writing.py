"""A dataset as files: a CSV for each run, and the dataset file over them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

import numpy as np

from dashpot.data.channel import unit_of_channel
from dashpot.data.declaration import SETTING_UNITS
from dashpot.data.run import Run
from dashpot.text.quantity import pretty

FORMAT = "dashpot-dataset/1"
UNITS = {**SETTING_UNITS, "added_mass": "kg", "speed": "m/s", "depth": "m"}
DIGITS = 9


def dataset_files(name: str, runs: Sequence[Run]) -> dict[str, str]:
    """The text of every file of a dataset by its name, ``dataset.yaml`` last. The same runs give the same bytes."""
    files = {f"{run.name}.csv": _table(run) for run in runs}
    return {**files, "dataset.yaml": _description(name, runs)}


def _table(run: Run) -> str:
    """SI, each number as the shortest text that reads back alike."""
    names = ["time", *run.channels]
    units = [unit_of_channel(name) or "1" for name in names]
    columns = np.array([run.time, *run.channels.values()])
    rows = (",".join(map(repr, row)) for row in columns.T.tolist())
    return "\n".join([",".join(names), ",".join(units), *rows]) + "\n"


def _description(name: str, runs: Sequence[Run]) -> str:
    lines = [f"format: {FORMAT}", f"name: {_quoted(name)}", "runs:"]
    return "\n".join([*lines, *(line for run in runs for line in _entry(run))]) + "\n"


def _entry(run: Run) -> list[str]:
    lines = [f"  - name: {_quoted(run.name)}", f"    file: {_quoted(run.name + '.csv')}", f"    kind: {run.kind}"]
    if run.repeats:
        lines.append(f"    repeats: {_quoted(run.repeats)}")
    if run.held_out is not None:
        lines.append(f"    held_out: {str(run.held_out).lower()}")
    settings = {key: _setting(key, value) for key, value in run.settings.items()}
    settings |= {key: _quoted(text) for key, text in run.notes.items()}
    if settings:
        lines.append(f"    settings: {_flow(settings)}")
    lines += ["    channels:", "      time: {column: time, unit: s}"]
    lines += [f"      {_quoted(channel)}: {_channel(channel)}" for channel in run.channels]
    if run.sensors:
        lines.append("    sensors:")
        lines += [f"      {_quoted(channel)}: {_sensor(channel, sheet)}" for channel, sheet in run.sensors.items()]
    return lines


def _channel(name: str) -> str:
    return _flow({"column": _quoted(name), "unit": unit_of_channel(name) or '"1"'})


def _sensor(channel: str, sheet: Mapping[str, float]) -> str:
    units = {
        "gain": "1",
        "zero": unit_of_channel(channel) or "1",
        "delay": "s",
        "noise": unit_of_channel(channel),
        "compliance": "m/N",
    }
    return _flow({key: _number(value, units[key] or "1") for key, value in sheet.items()})


def _setting(key: str, value: float) -> str:
    return _number(value, UNITS.get(key, "1"))


def _number(value: float, unit: str) -> str:
    return repr(value) if unit == "1" else pretty(value, unit, DIGITS)


def _flow(entries: Mapping[str, str]) -> str:
    return "{" + ", ".join(f"{key}: {text}" for key, text in entries.items()) + "}"


def _quoted(text: str) -> str:
    # a JSON text is a YAML text
    return text if text.replace("_", "").isalnum() and not text[0].isdigit() else json.dumps(text, ensure_ascii=False)

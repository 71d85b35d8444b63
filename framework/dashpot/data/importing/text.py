"""The text of a first dataset file, with remarks where something has to be confirmed."""

from __future__ import annotations

import json
import os
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from dashpot.data.declaration import SETTING_UNITS
from dashpot.data.description import FORMAT
from dashpot.data.importing.finding import ChannelFound, Finding
from dashpot.data.importing.imported import Imported, ImportedRun, ImportedTable
from dashpot.data.importing.roles import GUESSED as GUESSED_ROLE
from dashpot.data.importing.units import GUESSED
from dashpot.data.stiffness_table import NEEDED
from dashpot.text.quantity import pretty

_PLAIN = re.compile(r"[A-Za-zÀ-ÿ_][\wÀ-ÿ./-]*( [A-Za-zÀ-ÿ(][\wÀ-ÿ.()/-]*)*|[1-9]\d{0,5}")
_WORDS = {"null", "true", "false", "nan", "inf"}
_NEGLIGIBLE = 0.05


def dataset_text(imported: Imported, folder: Path, name: str) -> str:
    """The dataset file over these runs, to be written into `folder`."""
    common = _common(imported.runs) if imported.runs else []
    lines = [*_head(imported), f"format: {FORMAT}", f"name: {quoted(name)}"]
    lines += ["defaults:", *(f"  {line}" for line in common)] if common else []
    if imported.tables:
        lines += ["tables:", *(line for table in imported.tables for line in _table_lines(table, folder))]
    if imported.runs:
        lines += ["runs:", *(line for run in imported.runs for line in _run_lines(run, folder, common))]
    return "\n".join(lines) + "\n"


def leads_outside(imported: Imported, folder: Path) -> bool:
    """Whether a measured file does not lie in or below the folder."""
    return any(_relative(file, folder).startswith("..") for file in imported.files)


def _common(runs: Sequence[ImportedRun]) -> list[str]:
    """The channels that most runs have, where all others say everything that these say: a run inherits the rest."""
    blocks = {tuple(_channel_lines(run.finding)): set(run.finding.channels) for run in runs}
    counts = Counter(tuple(_channel_lines(run.finding)) for run in runs)
    block, count = counts.most_common(1)[0]
    overruled = all(blocks[block] <= names for names in blocks.values()) and "sign: " not in "".join(block)
    return list(block) if len(blocks) == 1 or (overruled and count > len(runs) / 2) else []


def quoted(text: str) -> str:
    """A text as YAML: plain where that is beyond doubt."""
    plain = _PLAIN.fullmatch(text) and text.lower() not in _WORDS
    # a JSON text is a YAML text
    return text if plain else json.dumps(text, ensure_ascii=False)


def _head(imported: Imported) -> Iterable[str]:
    yield "# A first dataset, written by `dashpot import`. Confirm before you trust a result:"
    count = len(imported.runs) + len(imported.tables)
    for remark, names in imported.confirm.items():
        yield f"# - CONFIRM {_one_line(remark)}{about_runs(names, count)}"


def about_runs(names: Iterable[str], count: int) -> str:
    """Which runs a remark is about, where it is not about all of them."""
    names = list(names)
    if len(names) == count:
        return ""
    return f" ({_one_line(', '.join(names[:6]))}{f' and {len(names) - 6} more' if len(names) > 6 else ''})"


def _run_lines(run: ImportedRun, folder: Path, common: list[str]) -> list[str]:
    finding = run.finding
    lines = [f"name: {quoted(run.name)}", f"file: {quoted(_relative(run.file, folder))}", f"kind: {finding.kind}"]
    lines += [f"reader: {run.reader}"] if run.reader else []
    lines += _options(run.options)
    lines += [f"repeats: {quoted(run.repeats)}"] if run.repeats else []
    settings = told_settings(finding.settings) | dict(finding.conditions)
    lines += [f"settings: {_flow(settings)}"] if settings and not run.repeats else []
    lines += [f"rows: [{run.rows[0]}, {run.rows[1]}]"] if run.rows else []
    channels = _channel_lines(finding)
    lines += channels if channels != common else []
    return ["  - " + lines[0], *("    " + line for line in lines[1:])]


def _table_lines(table: ImportedTable, folder: Path) -> list[str]:
    lines = [f"name: {quoted(table.name)}", f"file: {quoted(_relative(table.file, folder))}"]
    lines += [f"reader: {table.reader}"] if table.reader else []
    lines += _options(table.options)
    lines.append("columns:")
    for key, found in table.finding.columns.items():
        doubted = found.unit.by == GUESSED and found.unit.unit != "1"
        remark = "   # CONFIRM: the unit, which is not stated" if doubted else ""
        lines.append(f"  {key}: {_flow({'column': quoted(found.column), 'unit': quoted(found.unit.unit)})}{remark}")
    if table.finding.unused:
        lines.append(f"  # not used: {_one_line(', '.join(table.finding.unused[:12]))}")
    lines += [
        f"# CONFIRM: settings: {{{key}: ...}}   (no column was found)"
        for key in NEEDED
        if key not in table.finding.columns
    ]
    return ["  - " + lines[0], *("    " + line for line in lines[1:])]


def _options(options: Mapping[str, object]) -> list[str]:
    # between quotes a sheet called 2 is no number of a sheet
    entries = {key: json.dumps(value, ensure_ascii=False) for key, value in options.items()}
    return [f"file_options: {_flow(entries)}"] if entries else []


def _relative(file: Path, folder: Path) -> str:
    try:
        return Path(os.path.relpath(file.resolve(), folder.resolve())).as_posix()
    except ValueError:
        # another drive
        return file.resolve().as_posix()


def _channel_lines(finding: Finding) -> list[str]:
    lines = [*_timing(finding)]
    lines += [f"  {name}: {_channel(finding, found)}{_remark(found)}" for name, found in finding.channels.items()]
    return ["channels:", *lines, *_unused(finding)]


def _timing(finding: Finding) -> Iterable[str]:
    timing = finding.timing
    if timing.column is not None:
        remark = "   # CONFIRM: see above" if timing.confirm else ""
        entries = {"column": _column(finding, timing.column), "unit": quoted(timing.unit or "s")}
        yield f"  time: {_flow(entries)}{remark}"
    elif timing.sampling:
        yield f"  sampling: {timing.sampling:.10g} Hz"
    else:
        yield "  # CONFIRM: sampling: ... Hz   (no time and no sampling rate was found)"


def _column(finding: Finding, name: str) -> str:
    return quoted(str(finding.column(name)))


def _channel(finding: Finding, found: ChannelFound) -> str:
    entries = {"column": _column(finding, found.role.column), "unit": quoted(found.unit.unit)}
    return _flow(entries | ({"sign": "-1"} if found.sign < 0 else {}))


def _remark(found: ChannelFound) -> str:
    role = found.role
    doubts = ["the column"] if role.by == GUESSED_ROLE or role.rivals or role.namesakes else []
    unstated = f"the gain, as the file states {found.stated}" if found.stated else "the unit, which is not stated"
    doubts += [unstated] if found.unit.by == GUESSED else []
    doubts += ["the sign"] if found.sign < 0 else []
    return f"   # CONFIRM: {' and '.join(doubts)}" if doubts else ""


def _unused(finding: Finding) -> list[str]:
    if not finding.unused:
        return []
    shown = ", ".join(f"'{name}'" for name in finding.unused[:12]) + (" ..." if len(finding.unused) > 12 else "")
    return [f"  # not used: {_one_line(shown)}"]


def told_settings(settings: Mapping[str, float]) -> dict[str, str]:
    """The settings of a run in rig units, to two digits; a preload that hardly counts is zero."""
    small = _NEGLIGIBLE * settings.get("amplitude", 0.0)
    rounded = {key: 0.0 if key == "preload" and abs(value) < small else value for key, value in settings.items()}
    return {key: pretty(value, SETTING_UNITS[key], 2) for key, value in rounded.items()}


def _flow(entries: Mapping[str, str]) -> str:
    return "{" + ", ".join(f"{key}: {text}" for key, text in entries.items()) + "}"


def _one_line(text: str) -> str:
    return "".join(sign if sign.isprintable() else "?" for sign in text)

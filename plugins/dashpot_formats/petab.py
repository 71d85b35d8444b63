"""Measurement and condition tables of a PEtab problem."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from dashpot.contract.reader import Reader, ReadingError, Table
from dashpot.text.problem import nearest
from dashpot_formats.option import check_options, get_option

CONDITION, OBSERVABLE = "simulationConditionId", "observableId"
NEEDED = (OBSERVABLE, CONDITION, "measurement", "time")
NAMES = ("conditionId", "conditionName")

Row = Mapping[str, str]


class Petab(Reader):
    """Reads the measurement table of a PEtab problem: `time` and a column for each observable of one condition.

    `condition` is the `simulationConditionId` of the run, and may be left out where the table has one only;
    `conditions` a condition table in the same folder, whose numbers for it become constant columns. Observables of a
    condition have the same times, each once; steady states (`time` inf) and pre-equilibration do not map.
    """

    word = "petab"
    suffixes = ()
    options = {
        "condition": "the `simulationConditionId` of the run",
        "conditions": "a condition table in the same folder",
    }

    def read(self, path: Path, options: Mapping[str, object]) -> Table:
        check_options(options, self.options)
        rows = _rows(path, NEEDED)
        wanted = _condition(rows, get_option(options, "condition", str, None))
        own = [(line, row) for line, row in rows if row[CONDITION] == wanted]
        for line, row in own:
            if row.get("preequilibrationConditionId"):
                raise ReadingError(
                    f"condition '{wanted}' has a pre-equilibration, which dashpot does not know",
                    "a run begins at rest at its first deflection",
                    line,
                )
        columns = _columns(own, wanted)
        table = get_option(options, "conditions", str, None)
        size = columns["time"].size
        given = _settings(path, table, wanted) if table else {}
        return Table({**columns, **{key: np.full(size, number) for key, number in given.items()}})


def _rows(path: Path, needed: Sequence[str]) -> list[tuple[int, Row]]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise ReadingError("it is not a text in UTF-8", "write it again") from None
    reader = csv.DictReader(text.splitlines(), delimiter="\t")
    missing = [name for name in needed if name not in (reader.fieldnames or ())]
    if missing:
        known = ", ".join(reader.fieldnames or ()) or "nothing"
        raise ReadingError(
            f"expected a PEtab table with the column {', '.join(missing)}, got {known}", "separate by tabs"
        )
    rows: list[tuple[int, Row]] = list(enumerate(reader, 2))
    if not rows:
        raise ReadingError("expected rows below the header, got none", "export the table again")
    for line, row in rows:
        if any(row[name] is None for name in needed):
            raise ReadingError("the row ends before all columns are there", "export the table again", line)
    return rows


def _condition(rows: Sequence[tuple[int, Row]], wanted: str | None) -> str:
    known = list(dict.fromkeys(row[CONDITION] for _, row in rows))
    if wanted is None and len(known) == 1:
        return known[0]
    if wanted not in known:
        told = ", ".join(known[:12]) + (", ..." if len(known) > 12 else "")
        got = "none was named" if wanted is None else f"got '{wanted}'"
        hint = (nearest(wanted, known) if wanted else "") or "write 'file_options: {condition: ...}'"
        raise ReadingError(f"expected one of the conditions {told}, {got}", hint)
    return str(wanted)


def _columns(rows: Sequence[tuple[int, Row]], condition: str) -> dict[str, np.ndarray]:
    found: dict[str, dict[float, float]] = {}
    for line, row in rows:
        time, number = _number(row, "time", line), _number(row, "measurement", line)
        if not math.isfinite(time):
            raise ReadingError(f"expected a finite time, got '{row['time']}'", "a steady state is no run", line)
        known = found.setdefault(row[OBSERVABLE], {})
        if time in known:
            raise ReadingError(
                f"'{row[OBSERVABLE]}' of '{condition}' is measured twice at {time:g}",
                "give repeats a condition of their own",
                line,
            )
        known[time] = number
    times = [sorted(known) for known in found.values()]
    for name, own in zip(found, times, strict=True):
        if own != times[0]:
            raise ReadingError(
                f"expected the same times for all observables of '{condition}', '{name}' has others than "
                f"'{next(iter(found))}'",
                "resample one of them, or leave it out of the table",
            )
    columns = {name: np.array([known[time] for time in times[0]]) for name, known in found.items()}
    return {"time": np.array(times[0]), **columns}


def _settings(path: Path, table: str, condition: str) -> dict[str, float]:
    """The numbers of a condition; entries that are no number refer to a parameter and are refused."""
    if Path(table).name != table:
        raise ReadingError(f"expected 'conditions' as a file beside this one, got '{table}'", "move it there")
    if not (path.parent / table).is_file():
        raise ReadingError(f"there is no condition table '{table}' beside it", "check its name")
    rows = [(line, row) for line, row in _rows(path.parent / table, NAMES[:1]) if row[NAMES[0]] == condition]
    if len(rows) != 1:
        raise ReadingError(f"expected one row for '{condition}' in '{table}', got {len(rows)}", "correct the table")
    [(line, row)] = rows
    return {key: _number(row, key, line, f"'{table}', ") for key in row if key not in NAMES and row[key]}


def _number(row: Row, key: str, line: int, where: str = "") -> float:
    try:
        return float(row[key])
    except (TypeError, ValueError):
        raise ReadingError(f"{where}expected a number for '{key}', got '{row[key]}'", "correct it", line) from None

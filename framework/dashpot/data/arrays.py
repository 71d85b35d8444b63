"""A dataset of samples in memory: what files go through, with the keys that a run has in a dataset file."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dashpot.data.dataset import Dataset
from dashpot.data.declaration import ACCEPTABLE, RunDeclaration, read_declaration
from dashpot.data.groups import group_repeats
from dashpot.data.history import with_history
from dashpot.data.importing.motion import find_motion
from dashpot.data.measured import read_run
from dashpot.data.run import Run
from dashpot.data.table import Table
from dashpot.data.trouble import Trouble, Unusable
from dashpot.text.document import Document
from dashpot.text.problem import InputError, Place, Problem, nearest

MEMORY = "memory"  # stands in messages where the name of a file would


def dataset_of_arrays(columns: Mapping[str, ArrayLike], units: Mapping[str, str], keys: Mapping[str, Any]) -> Dataset:
    """The dataset of one run: ``columns`` (n,) by channel, ``time`` among them unless ``keys`` has ``sampling``.

    ``units`` by channel, SI where none is stated. ``keys`` are those of a run in a dataset file, without ``channels``
    and ``file``; without ``kind`` it is found from the motion. Raises InputError where a run in a file would be set
    aside.
    """
    table = Table({name: _column(name, values) for name, values in columns.items()})
    _refuse_unclear(table, keys)
    if keys.get("kind") is None:
        keys = {**keys, "kind": _kind_of(table, units, keys)}
    declaration = _declared(table, units, keys)
    run, troubles = _read(declaration, table)
    problems = tuple(_told(declaration.name, trouble) for trouble in troubles)
    faults = tuple((run.name, trouble) for trouble in troubles if trouble.fault)
    return Dataset(run.name, (replace(run, group=run.repeats or run.name, source=""),), problems, faults=faults)


def join(parts: Iterable[Dataset], name: str, aside: Mapping[str, InputError] | None = None) -> Dataset:
    """The runs of several datasets in one, in their order; repeats may be those of a run in another part.

    ``aside`` tells of runs that were set aside, by name. InputError for two runs of one name, for the repeat of a run
    that is none of them, and where no run is left.
    """
    parts, gone = tuple(parts), aside or {}
    runs = [run for part in parts for run in part.runs]
    known = {run.name: run for run in runs}
    told = [problem for error in gone.values() for problem in error.problems]
    wrong = [*_same_names(runs), *_lone_repeats(runs, {*known, *gone})]
    if wrong or not runs:
        raise InputError([*told, *wrong] or [Problem(Place(), f"the dataset '{name}' has no runs", "hand in some")])
    ordered = [replace(_like_first(run, known), order=order) for order, run in enumerate(runs)]
    grouped = group_repeats(list(with_history((run, True) for run in ordered)))
    problems = (*told, *(problem for part in parts for problem in part.problems))
    return Dataset(name, tuple(grouped), problems, faults=tuple(fault for part in parts for fault in part.faults))


def _column(name: str, values: ArrayLike) -> NDArray[np.float64]:
    try:
        column = np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError.at(
            Place(),
            f"the {name}: expected numbers, got {type(values).__name__} of something else",
            "hand in an array of floats",
        ) from None
    if column.ndim != 1:
        raise InputError.at(
            Place(),
            f"the {name}: expected samples (n,), got an array of shape {column.shape}",
            "hand in one run at a time, with one axis",
        )
    return column


def _refuse_unclear(table: Table, keys: Mapping[str, Any]) -> None:
    sizes = {channel: column.size for channel, column in table.columns.items()}
    if len(set(sizes.values())) > 1:
        listed = ", ".join(f"{channel} {size}" for channel, size in sizes.items())
        raise InputError.at(
            Place(),
            f"run '{keys['name']}': expected as many samples of each channel, got {listed}",
            "cut or resample them to one clock",
        )
    if ("time" in table.columns) == (keys.get("sampling") is not None):
        raise InputError.at(
            Place(),
            f"run '{keys['name']}': expected either a time (n,) or a sampling rate",
            "hand in time=... in s, or sampling=... in Hz",
        )


def _declared(table: Table, units: Mapping[str, str], keys: Mapping[str, Any]) -> RunDeclaration:
    for name in units:
        if name not in table.columns:
            known = nearest(name, table.columns) or f"channels are {', '.join(table.columns)}"
            raise InputError.at(Place(), f"a unit is stated of '{name}', which is no channel of the run", known)
    channels = {name: {"column": name} | ({"unit": units[name]} if name in units else {}) for name in table.columns}
    entries = {key: value for key, value in {**keys, "channels": channels}.items() if value is not None}
    text = json.dumps(entries, default=float, ensure_ascii=False)
    declaration, problems = read_declaration(Document.parse(text).root, None, MEMORY, 0)
    if declaration is None:
        # places in a text that nobody has written would only confuse
        raise InputError([replace(problem, place=Place()) for problem in problems])
    return declaration


def _kind_of(table: Table, units: Mapping[str, str], keys: Mapping[str, Any]) -> str:
    entire = {"name": keys["name"], "sampling": keys.get("sampling"), "kind": "transient", "accept": list(ACCEPTABLE)}
    run, _ = _read(_declared(table, units, entire), table)
    motions = [values for name, values in run.channels.items() if name.partition("@")[0] == "displacement"]
    return find_motion(motions[0], run.sample_time).kind if motions else "transient"


def _read(declaration: RunDeclaration, table: Table) -> tuple[Run, list[Trouble]]:
    try:
        return read_run(declaration, table)
    except Unusable as error:
        raise InputError([_told(declaration.name, trouble) for trouble in error.troubles]) from None


def _told(run: str, trouble: Trouble) -> Problem:
    return Problem(Place(), f"run '{run}': {trouble.message}", trouble.hint, trouble.severity)


def _same_names(runs: Sequence[Run]) -> Iterator[Problem]:
    for name, count in Counter(run.name for run in runs).items():
        if count > 1:
            yield Problem(Place(), f"{count} runs are called '{name}'", "give each run a name of its own")


def _lone_repeats(runs: Sequence[Run], names: Collection[str]) -> Iterator[Problem]:
    for run in runs:
        if run.repeats and run.repeats not in names:
            hint = nearest(run.repeats, names) or f"runs are: {', '.join(list(names)[:12])}"
            yield Problem(Place(), f"run '{run.name}' repeats '{run.repeats}', which is no run here", hint)


def _like_first(run: Run, known: Mapping[str, Run]) -> Run:
    """The run as a repeat of the very first one of a chain; what it does not say itself, that one says."""
    name, seen = run.repeats or "", {run.name}
    while name in known and name not in seen and known[name].repeats:
        seen.add(name)
        name = known[name].repeats or ""
    if name not in known or name == run.name:
        return run
    first = known[name]
    held_out = first.held_out if run.held_out is None else run.held_out
    return replace(
        run,
        repeats=name,
        settings={**first.settings, **run.settings},
        notes={**first.notes, **run.notes},
        units={**first.units, **run.units},
        held_out=held_out,
    )

"""A dataset: measured runs, read from files that are never changed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from dashpot.data.declaration import RunDeclaration
from dashpot.data.description import Description, read_description
from dashpot.data.digest import digest_runs
from dashpot.data.groups import group_repeats, resolve_repeats
from dashpot.data.measured import read_run
from dashpot.data.run import Run
from dashpot.data.source import choose_reader, find_file, locate
from dashpot.data.table import FileReader, ReadingError, Table
from dashpot.data.trouble import Trouble, Unusable
from dashpot.text.document import Document
from dashpot.text.problem import InputError, Place, Problem, in_text_order, nearest


@dataclass(frozen=True, eq=False)
class Dataset:
    """Runs in the order of the dataset file; `problems` tells which were set aside and what to know about the others.

    `folder` is where the dataset file is, None for a dataset made in memory. `faults` are the faults of the measurement
    itself that were found in reading, as (name of the run, finding).
    """

    name: str
    runs: tuple[Run, ...]
    problems: tuple[Problem, ...] = ()
    folder: Path | None = None
    faults: tuple[tuple[str, Trouble], ...] = ()

    @cached_property
    def digest(self) -> str:
        """sha256 of the samples and of what they mean, in hexadecimal; paths play no part."""
        return digest_runs(self.runs)

    def run(self, name: str) -> Run:
        """The run of this name. InputError when there is none."""
        for run in self.runs:
            if run.name == name:
                return run
        names = [run.name for run in self.runs]
        hint = nearest(name, names) or f"runs are: {', '.join(names[:12])}"
        raise InputError.at(Place(), f"the dataset '{self.name}' has no run '{name}'", hint)

    def select(self, names: Iterable[str]) -> Dataset:
        """The dataset with only these runs, in the order of the file. InputError when one is unknown."""
        wanted = {self.run(name).name for name in names}
        return replace(self, runs=tuple(run for run in self.runs if run.name in wanted))

    def dynamic(self) -> tuple[Run, ...]:
        """All runs but the quasi-static ones and the holds."""
        return tuple(run for run in self.runs if run.kind not in ("quasi_static", "hold"))

    def quasi_static(self) -> tuple[Run, ...]:
        """The quasi-static runs."""
        return tuple(run for run in self.runs if run.kind == "quasi_static")


def read_dataset(path: Path | str, readers: Mapping[str, FileReader]) -> Dataset:
    """Read a dataset: its description, a folder that holds one, or a data file with a sidecar `<file>.yaml`.

    `readers` are the readers of measurement files by their word. A run with a fault is set aside and told of in
    `problems`. Raises InputError, with everything that is wrong, when no run is left.
    """
    source = locate(Path(path))
    document = Document.read(source.description)
    description = read_description(document, source)
    problems = list(description.problems)
    measurements = _Measurements(description, source.folder, readers, problems)
    runs = measurements.read()
    if not runs:
        raise InputError(
            problems or [Problem(document.root.place, "the dataset has no runs", "list some under 'runs'")]
        )
    return Dataset(description.name, tuple(runs), in_text_order(problems), source.folder, tuple(measurements.faults))


class _Measurements:
    """The files of a dataset; a file that several runs are cut from is read once."""

    def __init__(
        self, description: Description, folder: Path, readers: Mapping[str, FileReader], problems: list[Problem]
    ) -> None:
        self._description = description
        self._folder = folder
        self._readers = readers
        self._problems = problems
        self.faults: list[tuple[str, Trouble]] = []
        self._last: tuple[object, Table] = (None, Table({}))

    def read(self) -> list[Run]:
        """All usable runs, grouped; the others are among the problems."""
        resolved, troubles = resolve_repeats(self._description.declarations, self._description.names)
        for declaration in self._description.declarations:
            if declaration.name in troubles:
                self._note(declaration, troubles[declaration.name])
        runs = [self._run(declaration) for declaration in resolved]
        return group_repeats([run for run in runs if run])

    def _run(self, declaration: RunDeclaration) -> Run | None:
        try:
            run, warnings = read_run(declaration, self._table(declaration))
        except Unusable as error:
            run, warnings = None, list(error.troubles)
        for trouble in warnings:
            self._note(declaration, trouble)
        return run

    def _table(self, declaration: RunDeclaration) -> Table:
        place = declaration.place("file")
        path = find_file(declaration.file, self._folder, self._description.allow_outside, place)
        said = declaration.place("reader" if declaration.reader else "file")
        reader = choose_reader(declaration.file, declaration.reader, self._readers, said)
        wanted = (path, reader, repr(declaration.file_options))
        if self._last[0] != wanted:
            self._last = (wanted, _read_file(reader, path, declaration.file_options))
        return self._last[1]

    def _note(self, declaration: RunDeclaration, trouble: Trouble) -> None:
        if trouble.fault:
            self.faults.append((declaration.name, trouble))
        state = " is set aside" if trouble.severity == "error" else ""
        message = f"run '{declaration.name}' ({declaration.file}){state}: {trouble.message}"
        place = trouble.place or declaration.place("file")
        self._problems.append(Problem(place, message, trouble.hint, trouble.severity))


def _read_file(reader: FileReader, path: Path, options: Mapping[str, object]) -> Table:
    try:
        return reader.read(path, options)
    except ReadingError as error:
        where = f"line {error.line}: " if error.line else ""
        raise Unusable([Trouble(where + error.message, error.hint)]) from None
    except OSError as error:
        raise Unusable([Trouble(f"the file cannot be read: {error.strerror}", "check its rights")]) from None

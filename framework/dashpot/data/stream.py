"""The runs of a dataset one at a time: read when they are asked for, and not kept."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from dashpot.data.declaration import RunDeclaration
from dashpot.data.description import Description, read_description
from dashpot.data.excitation import ORDER, mean_of, settings_of
from dashpot.data.groups import resolve_repeats
from dashpot.data.history import NOTHING, with_history
from dashpot.data.measured import read_run
from dashpot.data.run import Run
from dashpot.data.source import Source, choose_reader, find_file, locate, measured_folder
from dashpot.data.stiffness_table import TableDeclaration, read_table
from dashpot.data.table import FileReader, ReadingError, Table
from dashpot.data.trouble import Trouble, Unusable, refuse
from dashpot.text.document import Document
from dashpot.text.node import Mapping as MappingNode
from dashpot.text.problem import InputError, Problem, in_text_order


def open_dataset(path: Path | str, readers: Mapping[str, FileReader], allow_outside: bool = False) -> RunStream:
    """A dataset whose measurement files are still to be read; see `read_dataset`.

    Raises InputError when its description cannot be read.
    """
    source = locate(Path(path))
    document = Document.read(source.description)
    return RunStream(read_description(document, source), source, readers, document, allow_outside)


class RunStream:
    """An iterable of runs; every iteration reads the files again, one after the other.

    A run with a fault is set aside. When an iteration has ended, `problems` and `faults` tell of all that it found.
    It raises InputError, with everything that is wrong, when no run was left.
    """

    def __init__(
        self,
        description: Description,
        source: Source,
        readers: Mapping[str, FileReader],
        document: Document,
        allow_outside: bool,
    ) -> None:
        self.name, self.source, self.document = description.name, source, document
        self.references = description.references
        root = document.root
        place = root.entries.get("folder", root).place if isinstance(root, MappingNode) else root.place
        self.folder = measured_folder(source, description.folder, allow_outside, place)
        self._description, self._readers, self._allow_outside = description, readers, allow_outside
        self._begin()

    def _begin(self) -> None:
        self._problems = list(self._description.problems)
        self._faults: list[tuple[str, Trouble]] = []
        self._last: tuple[object, Table] = (None, Table({}))

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all runs whose declaration is sound; tables are read for it."""
        own = tuple(declaration.name for declaration in self._description.declarations)
        return (*own, *(run.name for run in self._rows()[0]))

    @property
    def conditions(self) -> dict[str, dict[str, float]]:
        """The settings of every run in SI before its file is read, named as by `settings_of`.

        The history and the means of further channels are not known yet: NaN.
        """
        resolved, _ = resolve_repeats(self._description.declarations, self._description.names)
        return {
            each.name: {
                ORDER: float(each.order),
                **dict.fromkeys(NOTHING, math.nan),
                **each.settings,
                **{mean_of(channel.name): math.nan for channel in each.channels},
            }
            for each in resolved
        } | {run.name: settings_of(run) for run in self._rows()[0]}

    @property
    def problems(self) -> tuple[Problem, ...]:
        """Which runs were set aside, and what to know about the others."""
        return in_text_order(self._problems)

    @property
    def faults(self) -> tuple[tuple[str, Trouble], ...]:
        """The faults of the measurement itself, as (name of the run, finding)."""
        return tuple(self._faults)

    def __iter__(self) -> Iterator[Run]:
        self._begin()
        resolved, troubles = resolve_repeats(self._description.declarations, self._description.names)
        for declaration in self._description.declarations:
            if declaration.name in troubles:
                self._note(declaration, troubles[declaration.name])
        some = False
        for run in with_history(self._made(resolved)):
            some = True
            yield run
        rows, problems = self._rows()
        self._problems += problems
        yield from rows
        if not some and not rows:
            raise InputError([*self._problems, *self._without_runs()])

    def _without_runs(self) -> Iterator[Problem]:
        if not self._description.declarations and not self._description.tables and not self._problems:
            yield Problem(self.document.root.place, "the dataset has no runs", "list some under 'runs'")
        elif all(problem.severity == "warning" for problem in self._problems):
            yield Problem(self.document.root.place, "every run of the dataset is set aside", "keep at least one")

    def _made(self, declarations: Iterable[RunDeclaration]) -> Iterator[tuple[Run, bool]]:
        """All runs that can be read, and whether they count: the specimen was moved in one that is set aside, too."""
        for declaration in declarations:
            if declaration.set_aside is not None:
                self._note(declaration, _wished(declaration))
            run = self._run(declaration) if declaration.set_aside is None else None
            if run:
                yield run, True
            elif moved := self._moved(declaration):
                yield moved, False

    def _moved(self, declaration: RunDeclaration) -> Run | None:
        """A run that is set aside, with its displacement alone where another channel is faulty."""
        alone = tuple(channel for channel in declaration.channels if channel.name == "displacement")
        for channels in filter(None, (declaration.channels, alone)):
            with suppress(Unusable, InputError):
                return read_run(replace(declaration, channels=channels), self._table(declaration))[0]
        return None

    def _run(self, declaration: RunDeclaration) -> Run | None:
        try:
            run, warnings = read_run(declaration, self._table(declaration))
        except Unusable as error:
            run, warnings = None, list(error.troubles)
        for trouble in warnings:
            self._note(declaration, trouble)
        return run

    def _rows(self) -> tuple[list[Run], list[Problem]]:
        """The rows of all tables, and what was set aside of them."""
        runs: list[Run] = []
        problems: list[Problem] = []
        for declaration in self._description.tables:
            first = len(self._description.declarations) + len(runs)
            try:
                found, troubles = read_table(declaration, self._table(declaration), first)
                refuse(
                    Trouble(f"one of its rows is called '{run.name}', as a run is", "give the table another name")
                    for run in found
                    if run.name in self._description.names
                )
            except Unusable as error:
                found, troubles = [], list(error.troubles)
            runs += found
            problems += [_told("table", declaration, trouble) for trouble in troubles]
        return runs, problems

    def _table(self, declaration: RunDeclaration | TableDeclaration) -> Table:
        place = declaration.place("file")
        path = find_file(declaration.file, self.folder, self._allow_outside, place)
        said = declaration.place("reader" if declaration.reader else "file")
        reader = choose_reader(declaration.file, declaration.reader, self._readers, said)
        wanted = (path, reader, repr(declaration.file_options))
        if self._last[0] != wanted:
            self._last = (wanted, _read_file(reader, path, declaration.file_options))
        return self._last[1]

    def _note(self, declaration: RunDeclaration, trouble: Trouble) -> None:
        if trouble.fault:
            self._faults.append((declaration.name, trouble))
        self._problems.append(_told("run", declaration, trouble, declaration.set_aside is not None))


def _told(what: str, declaration: RunDeclaration | TableDeclaration, trouble: Trouble, aside: bool = False) -> Problem:
    state = " is set aside" if trouble.severity == "error" or aside else ""
    message = f"{what} '{declaration.name}' ({declaration.file}){state}: {trouble.message}"
    return Problem(trouble.place or declaration.place("file"), message, trouble.hint, trouble.severity)


def _wished(declaration: RunDeclaration) -> Trouble:
    assert declaration.set_aside is not None
    return Trouble(declaration.set_aside, "", declaration.place("set_aside"), "warning")


def _read_file(reader: FileReader, path: Path, options: Mapping[str, object]) -> Table:
    try:
        return reader.read(path, options)
    except ReadingError as error:
        where = f"line {error.line}: " if error.line else ""
        raise Unusable([Trouble(where + error.message, error.hint)]) from None
    except OSError as error:
        raise Unusable([Trouble(f"the file cannot be read: {error.strerror}", "check its rights")]) from None

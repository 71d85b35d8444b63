"""A dataset: measured runs, read from files that are never changed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from dashpot.data.digest import digest_runs
from dashpot.data.groups import group_repeats
from dashpot.data.reference import Reference
from dashpot.data.run import Run
from dashpot.data.stream import open_dataset
from dashpot.data.table import FileReader
from dashpot.data.trouble import Trouble
from dashpot.text.document import Document
from dashpot.text.problem import InputError, Place, Problem, nearest


@dataclass(frozen=True, eq=False)
class Dataset:
    """Runs in the order of the dataset file; `problems` tells which were set aside and what to know about the others.

    `folder` is where its measured files lie and `document` the text that describes them, `file` the only measured file
    that this text stands beside; all None for a dataset made in memory. `faults` are the faults of the measurement
    itself that were found in reading, as (name of the run, finding). `references` are what was measured of the
    specimen by other means, by the path of the parameter.
    """

    name: str
    runs: tuple[Run, ...]
    problems: tuple[Problem, ...] = ()
    folder: Path | None = None
    faults: tuple[tuple[str, Trouble], ...] = ()
    document: Document | None = None
    file: str | None = None
    references: Mapping[str, Reference] = field(default_factory=dict)

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


def read_dataset(path: Path | str, readers: Mapping[str, FileReader], allow_outside: bool = False) -> Dataset:
    """Read a dataset: its description, a folder that holds one, or a data file with a sidecar `<file>.yaml`.

    `readers` are the readers of measurement files by their word. Files outside of the folder of the dataset are
    read only where `allow_outside` says that its text is to be trusted. A run with a fault is set aside and told of in
    `problems`. Raises InputError, with everything that is wrong, when no run is left.
    """
    stream = open_dataset(path, readers, allow_outside)
    runs = group_repeats(list(stream))
    return Dataset(
        stream.name,
        tuple(runs),
        stream.problems,
        stream.folder,
        stream.faults,
        stream.document,
        stream.source.file,
        stream.references,
    )

"""Reading the measurements in measured files: one in a file, or several, as the sheets of a workbook."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from dashpot.data.checks import FEWEST_SAMPLES
from dashpot.data.importing.rows import numeric
from dashpot.data.importing.stiffness import find_stiffness
from dashpot.data.source import choose_reader
from dashpot.data.table import FileReader, ReadingError, Table
from dashpot.data.trouble import Unusable
from dashpot.text.problem import InputError, Place, Problem


@dataclass(frozen=True, eq=False)
class Measured:
    """A measurement: its file, the options with which it is read where there are several, and its columns."""

    file: Path
    options: Mapping[str, object]
    table: Table

    @property
    def title(self) -> str:
        """What the file calls it."""
        return "_".join(map(str, (self.file.stem, *self.options.values())))


def read_all(
    files: Sequence[Path], readers: Mapping[str, FileReader], word: str | None
) -> tuple[list[Measured], list[Problem]]:
    """The measurements in the files, and what could not be read; ``word`` names the reader of all.

    Raises InputError where nothing can be read.
    """
    measured: list[Measured] = []
    problems: list[Problem] = []
    for file in files:
        with _collected(problems, file, {}):
            reader = choose_reader(file.name, word, readers, Place(str(file)))
            for options in reader.parts(file):
                with _collected(problems, file, options):
                    measured.append(Measured(file, options, _with_numbers(reader.read(file, options))))
    if not measured:
        raise InputError(problems)
    return measured, problems


@contextmanager
def _collected(problems: list[Problem], file: Path, options: Mapping[str, object]) -> Iterator[None]:
    """What keeps a measurement from being read is noted, and the next one is tried."""
    place, which = Place(str(file)), "".join(f"{key} '{value}': " for key, value in options.items())
    try:
        yield
    except Unusable as error:
        problems += [Problem(place, which + trouble.message, trouble.hint) for trouble in error.troubles]
    except ReadingError as error:
        problems.append(Problem(replace(place, line=error.line), which + error.message, error.hint))
    except OSError as error:
        problems.append(Problem(place, f"{which}it cannot be read: {error.strerror}", "check its rights"))


def _with_numbers(table: Table) -> Table:
    if find_stiffness(table):
        return table
    counts = [int(np.isfinite(numeric(values)).sum()) for values in table.columns.values()]
    if max(counts, default=0) < FEWEST_SAMPLES:
        message = f"it holds no column of numbers of at least {FEWEST_SAMPLES} samples"
        raise ReadingError(message, "check that this is the file of the measurement")
    return table

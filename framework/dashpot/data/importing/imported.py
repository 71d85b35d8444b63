"""From measured files to a first dataset file and what has to be confirmed in it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from dashpot.data.importing.files import find_files, run_names
from dashpot.data.importing.finding import NEEDED, Agreed, Finding, find_all
from dashpot.data.importing.likeness import find_repeats
from dashpot.data.source import choose_reader
from dashpot.data.table import FileReader, ReadingError, Table
from dashpot.data.trouble import Unusable
from dashpot.text.problem import InputError, Place, Problem

DIRECTION = "that deflection > 0 squeezes the specimen and force > 0 presses its ends apart; else write 'sign: -1'"


@dataclass(frozen=True, eq=False)
class ImportedRun:
    """A run: its name, file, and what was found; the earlier run that it repeats."""

    name: str
    file: Path
    reader: str | None
    finding: Finding
    repeats: str | None = None


@dataclass(frozen=True, eq=False)
class Imported:
    """Runs, what has to be confirmed with the runs that it is about, and files that could not be read."""

    runs: tuple[ImportedRun, ...]
    confirm: Mapping[str, tuple[str, ...]]
    problems: tuple[Problem, ...]


def import_files(
    given: Iterable[Path], readers: Mapping[str, FileReader], word: str | None = None, sampling: float | None = None
) -> Imported:
    """Read files and find out what they hold. `word` names their reader, `sampling` in Hz overrules their clock.

    Raises InputError when no file can be read.
    """
    files = find_files(list(given), readers)
    tables, problems = _read(files, readers, word)
    names = run_names(list(tables))
    found = _agree({file: find_all(table, sampling) for file, table in tables.items()}, tables, sampling)
    findings = {names[file]: finding for file, finding in found.items()}
    repeats, copies = find_repeats(findings)
    runs = tuple(ImportedRun(names[file], file, word, found[file], repeats.get(names[file])) for file in tables)
    return Imported(runs, _confirm(runs, copies), tuple(problems))


def _read(
    files: Sequence[Path], readers: Mapping[str, FileReader], word: str | None
) -> tuple[dict[Path, Table], list[Problem]]:
    tables: dict[Path, Table] = {}
    problems: list[Problem] = []
    for file in files:
        place = Place(str(file))
        try:
            table = choose_reader(file.name, word, readers, place).read(file, {})
            find_all(table)
            tables[file] = table
        except Unusable as error:
            problems += [Problem(place, trouble.message, trouble.hint) for trouble in error.troubles]
        except ReadingError as error:
            problems.append(Problem(replace(place, line=error.line), error.message, error.hint))
        except OSError as error:
            problems.append(Problem(place, f"it cannot be read: {error.strerror}", "check its rights"))
    if not tables:
        raise InputError(problems)
    return tables, problems


def _agree(
    findings: Mapping[Path, Finding], tables: Mapping[Path, Table], sampling: float | None
) -> dict[Path, Finding]:
    """Files with the same columns get the units and signs that most of them tell."""
    alike: dict[object, list[Path]] = {}
    for file, finding in findings.items():
        alike.setdefault(_columns(finding), []).append(file)
    agreed: dict[Path, Finding] = dict(findings)
    for files in alike.values():
        common = _most_common([findings[file] for file in files])
        for file in files:
            if _told(findings[file]) != common:
                agreed[file] = find_all(tables[file], sampling, common)
    return agreed


def _columns(finding: Finding) -> object:
    return finding.timing.column, tuple((name, found.role.column) for name, found in finding.channels.items())


def _told(finding: Finding) -> Agreed:
    return {name: (found.unit, found.sign) for name, found in finding.channels.items()}


def _most_common(findings: Sequence[Finding]) -> Agreed:
    """Unit by unit, and the signs of displacement and force together."""
    signs = Counter(tuple(f.channels[name].sign for name in NEEDED if name in f.channels) for f in findings)
    by_name = dict(
        zip((name for name in NEEDED if name in findings[0].channels), signs.most_common(1)[0][0], strict=True)
    )
    units = {
        name: Counter(f.channels[name].unit for f in findings).most_common(1)[0][0] for name in findings[0].channels
    }
    return {name: (unit, by_name.get(name, 1)) for name, unit in units.items()}


def _confirm(runs: Sequence[ImportedRun], copies: Mapping[str, str]) -> dict[str, tuple[str, ...]]:
    """What a person has to look at, each with the runs that it is about; the most general first."""
    about: dict[str, list[str]] = {DIRECTION: [run.name for run in runs]}
    for run in runs:
        for remark in run.finding.confirm:
            about.setdefault(remark, []).append(run.name)
        if run.finding.rows:
            first, last = run.finding.rows
            about.setdefault(f"rows {first + 1} to {last} are used: others hold no numbers", []).append(run.name)
        if run.repeats:
            about.setdefault("the runs that repeat others: they do so after motion and force", []).append(run.name)
        if run.name in copies:
            about.setdefault("a run is a copy of another one to the last digit: remove one of them", []).append(
                run.name
            )
    about["the kinds and settings of the runs: they were found from the motion"] = [run.name for run in runs]
    return {remark: tuple(names) for remark, names in about.items()}

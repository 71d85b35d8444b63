"""From measured files to a first dataset file and what has to be confirmed in it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from dashpot.data.checks import FEWEST_SAMPLES
from dashpot.data.importing.files import find_files, run_names
from dashpot.data.importing.finding import NEEDED, Agreed, Finding, find_all
from dashpot.data.importing.likeness import find_repeats
from dashpot.data.importing.names import stated_by_all
from dashpot.data.importing.pairs import explained
from dashpot.data.importing.roles import GUESSED as BY_MOTION
from dashpot.data.importing.roles import Role, named_roles
from dashpot.data.importing.rows import numeric
from dashpot.data.importing.stiffness import StiffnessFound, find_stiffness
from dashpot.data.importing.timing import pieces
from dashpot.data.importing.units import GUESSED
from dashpot.data.source import choose_reader
from dashpot.data.table import FileReader, ReadingError, Table
from dashpot.data.trouble import Unusable
from dashpot.text.problem import InputError, Place, Problem

# rates of tests are set apart by no less than this
_OTHER_RATE = 2.0
# a clock in more pieces than that is no clock
_MOST_PIECES = 50

DIRECTION = "that deflection > 0 squeezes the specimen and force > 0 presses its ends apart; else write 'sign: -1'"


@dataclass(frozen=True, eq=False)
class ImportedRun:
    """A run: its name, file, and what was found; its rows where they are not all; the earlier run that it repeats."""

    name: str
    file: Path
    reader: str | None
    finding: Finding
    rows: tuple[int, int] | None = None
    repeats: str | None = None


@dataclass(frozen=True, eq=False)
class ImportedTable:
    """A table of dynamic stiffness: its name, file, and what was found."""

    name: str
    file: Path
    reader: str | None
    finding: StiffnessFound


@dataclass(frozen=True, eq=False)
class _Part:
    """A file, or a piece of one between two gaps: its rows (from 0), and which of how many pieces it is."""

    file: Path
    table: Table
    finding: Finding
    first: int = 0
    whole: bool = True
    number: int = 1
    count: int = 1

    def rows(self, finding: Finding) -> tuple[int, int] | None:
        """First row from 1 and last one, None for all."""
        if self.whole and finding.rows is None:
            return None
        first, last = finding.rows or (0, len(next(iter(self.table.columns.values()))))
        return self.first + first + 1, self.first + last


@dataclass(frozen=True, eq=False)
class Imported:
    """Runs and tables, what has to be confirmed with those that it is about, and files that could not be read."""

    runs: tuple[ImportedRun, ...]
    tables: tuple[ImportedTable, ...]
    confirm: Mapping[str, tuple[str, ...]]
    problems: tuple[Problem, ...]

    @property
    def files(self) -> list[Path]:
        """The measured files of all runs and tables."""
        return [run.file for run in self.runs] + [table.file for table in self.tables]


def import_files(
    given: Iterable[Path], readers: Mapping[str, FileReader], word: str | None = None, sampling: float | None = None
) -> Imported:
    """Read files and find out what they hold. `word` names their reader, `sampling` in Hz overrules their clock.

    Raises InputError when no file can be read.
    """
    files = find_files(list(given), readers)
    tables, problems = _read(files, readers, word)
    names = run_names(list(tables))
    stiffness = {file: found for file, table in tables.items() if (found := find_stiffness(table))}
    parts: dict[str, _Part] = {}
    for file, table in tables.items():
        if file in stiffness:
            continue
        for part in _parts(file, table, sampling):
            parts[f"{names[file]}_{part.number}" if part.count > 1 else names[file]] = part
    findings = _slow_ones(_with_conditions(_agree(_of_one_mind(parts, sampling), sampling), parts))
    repeats, copies = find_repeats(findings)
    runs = tuple(
        ImportedRun(name, part.file, word, findings[name], part.rows(findings[name]), repeats.get(name))
        for name, part in parts.items()
    )
    rows = tuple(ImportedTable(names[file], file, word, finding) for file, finding in stiffness.items())
    return Imported(runs, rows, _confirm(runs, copies, rows), tuple(problems))


def _parts(file: Path, table: Table, sampling: float | None) -> list[_Part]:
    """A file as one, or the pieces between the gaps of its clock."""
    whole = _Part(file, table, find_all(table, sampling))
    named = named_roles(list(table.columns), table.units).get("time")
    clock = named.column if named else whole.finding.timing.column
    time = numeric(table.columns[clock]) if clock is not None else np.zeros(0)
    found = pieces(time)
    if sampling or found == [(0, time.size)] or not 1 <= len(found) <= _MOST_PIECES:
        return [whole]
    cut = [(first, _cut(table, first, last)) for first, last in found]
    return [
        _Part(file, piece, find_all(piece, sampling), first, False, number, len(found))
        for number, (first, piece) in enumerate(cut, 1)
    ]


def _cut(table: Table, first: int, last: int) -> Table:
    return replace(table, columns={name: values[first:last] for name, values in table.columns.items()}, lines=None)


def _read(
    files: Sequence[Path], readers: Mapping[str, FileReader], word: str | None
) -> tuple[dict[Path, Table], list[Problem]]:
    tables: dict[Path, Table] = {}
    problems: list[Problem] = []
    for file in files:
        place = Place(str(file))
        try:
            tables[file] = _with_numbers(choose_reader(file.name, word, readers, place).read(file, {}))
        except Unusable as error:
            problems += [Problem(place, trouble.message, trouble.hint) for trouble in error.troubles]
        except ReadingError as error:
            problems.append(Problem(replace(place, line=error.line), error.message, error.hint))
        except OSError as error:
            problems.append(Problem(place, f"it cannot be read: {error.strerror}", "check its rights"))
    if not tables:
        raise InputError(problems)
    return tables, problems


def _with_numbers(table: Table) -> Table:
    if find_stiffness(table):
        return table
    counts = [int(np.isfinite(numeric(values)).sum()) for values in table.columns.values()]
    if max(counts, default=0) < FEWEST_SAMPLES:
        message = f"it holds no column of numbers of at least {FEWEST_SAMPLES} samples"
        raise ReadingError(message, "check that this is the file of the measurement")
    return table


def _of_one_mind(parts: Mapping[str, _Part], sampling: float | None) -> dict[str, _Part]:
    """Files with the same columns have displacement and force in the columns that explain most of all their forces.

    Columns whose names tell what they are mean the same in all files. Of others a file keeps its own if the common ones
    clearly do not fit it: its channels may have been plugged otherwise.
    """
    alike: dict[object, list[str]] = {}
    for name, part in parts.items():
        alike.setdefault((*part.table.columns,), []).append(name)
    settled = dict(parts)
    for names in alike.values():
        told = {name: roles for name in names if len(roles := _roles(parts[name].finding)) == len(NEEDED)}
        if len({_names_of(roles) for roles in told.values()}) <= 1:
            continue
        counts = Counter(map(_names_of, told.values()))
        shares = {
            _names_of(roles): np.mean([_share(parts[name].table, roles) for name in told]) for roles in told.values()
        }
        # to two digits: one signal in volts and in newtons is explained alike
        usual = max(told.values(), key=lambda roles: (round(shares[_names_of(roles)], 2), counts[_names_of(roles)]))
        for name, roles in told.items():
            if _names_of(roles) != _names_of(usual) and (_are_named(usual) or _fit(parts[name].table, usual, roles)):
                rivals = tuple({*roles[1].rivals, roles[1].column} - {usual[1].column})
                known = {usual[0].channel: usual[0], usual[1].channel: replace(usual[1], rivals=rivals)}
                settled[name] = replace(parts[name], finding=find_all(parts[name].table, sampling, None, known))
    return settled


def _names_of(roles: Sequence[Role]) -> tuple[str, ...]:
    return tuple(role.column for role in roles)


def _are_named(roles: Sequence[Role]) -> bool:
    return all(role.by != BY_MOTION for role in roles)


def _fit(table: Table, usual: Sequence[Role], own: Sequence[Role]) -> bool:
    """Whether the common columns explain a force as well as those of the file itself, as far as these leave open."""
    return _share(table, usual) >= 2.0 * _share(table, own) - 1.0


def _share(table: Table, roles: Sequence[Role]) -> float:
    """The share of the force that the motion explains."""
    motion, force = (numeric(table.columns[role.column]) for role in roles)
    sound = np.isfinite(motion) & np.isfinite(force)
    return explained(motion[sound], force[sound])


def _roles(finding: Finding) -> list[Role]:
    return [finding.channels[name].role for name in NEEDED if name in finding.channels]


def _with_conditions(findings: Mapping[str, Finding], parts: Mapping[str, _Part]) -> dict[str, Finding]:
    """With the conditions that the names of all files state."""
    stated = stated_by_all(part.file.stem for part in parts.values())
    remark = "settings that the names of the files state"
    return {
        name: replace(finding, conditions=told, confirm=(*finding.confirm, remark)) if told else finding
        for name, finding in findings.items()
        for told in [stated[parts[name].file.stem]]
    }


def _slow_ones(findings: Mapping[str, Finding]) -> dict[str, Finding]:
    """Of runs at clearly different rates only the slowest are quasi-static; the rate matters in the others."""
    rates = {name: _rate(finding) for name, finding in findings.items() if finding.kind == "quasi_static"}
    slowest = min(rates.values(), default=0.0)
    fast = {name for name, rate in rates.items() if rate > _OTHER_RATE * slowest}
    remark = "the run is like slow ones but faster than the slowest: 'quasi_static' if its rate does not matter"
    return {
        name: replace(finding, kind="transient", confirm=(*finding.confirm, remark)) if name in fast else finding
        for name, finding in findings.items()
    }


def _rate(finding: Finding) -> float:
    """The mean speed over the stroke, in 1/s."""
    x = finding.signals["displacement"]
    return float(np.mean(np.abs(np.diff(x)))) / ((finding.timing.step or 1.0) * float(np.ptp(x)))


def _agree(parts: Mapping[str, _Part], sampling: float | None) -> dict[str, Finding]:
    """Runs with the same columns get the units and signs that most of them tell."""
    agreed = {name: part.finding for name, part in parts.items()}
    alike: dict[object, list[str]] = {}
    for name, finding in agreed.items():
        alike.setdefault(_columns(finding), []).append(name)
    for names in alike.values():
        common = _most_common([agreed[name] for name in names])
        for name in names:
            if _told(agreed[name]) != common:
                known = {role.channel: role for role in _roles(agreed[name])}
                agreed[name] = find_all(parts[name].table, sampling, common, known)
    return agreed


def _columns(finding: Finding) -> object:
    return finding.timing.column, tuple((name, found.role.column) for name, found in finding.channels.items())


def _told(finding: Finding) -> Agreed:
    return {name: (found.unit.unit, found.sign) for name, found in finding.channels.items()}


def _most_common(findings: Sequence[Finding]) -> Agreed:
    """Unit by unit, where stated ones come before guesses, and the signs of displacement and force together."""
    names = list(findings[0].channels)
    signs = Counter(tuple(finding.channels[name].sign for name in names) for finding in findings).most_common(1)[0][0]
    units: dict[str, str] = {}
    for name in names:
        found = [finding.channels[name].unit for finding in findings]
        stated = [unit.unit for unit in found if unit.by != GUESSED]
        units[name] = Counter(stated or [unit.unit for unit in found]).most_common(1)[0][0]
    return {name: (units[name], sign) for name, sign in zip(names, signs, strict=True)}


def _confirm(
    runs: Sequence[ImportedRun], copies: Mapping[str, str], tables: Sequence[ImportedTable]
) -> dict[str, tuple[str, ...]]:
    """What a person has to look at, each with the runs and tables that it is about; the most general first."""
    about: dict[str, list[str]] = {DIRECTION: [run.name for run in runs]} if runs else {}
    for table in tables:
        for remark in table.finding.confirm:
            about.setdefault(remark, []).append(table.name)
    for run in runs:
        for remark in run.finding.confirm:
            about.setdefault(remark, []).append(run.name)
        if run.rows:
            remark = (
                "only the rows under 'rows' are used: others lie beyond a break of the clock, hold no numbers, or are "
                "the zeros that fill up the last block"
            )
            about.setdefault(remark, []).append(run.name)
        if run.repeats:
            about.setdefault("the runs that repeat others: they do so after motion and force", []).append(run.name)
        if run.name in copies:
            about.setdefault("a run is a copy of another one to the last digit: remove one of them", []).append(
                run.name
            )
    if runs:
        about["the kinds and settings of the runs: they were derived from the motion"] = [run.name for run in runs]
    return {remark: tuple(names) for remark, names in about.items()}

"""From measured files to a first dataset file and what has to be confirmed in it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from dashpot.data.importing.files import find_files, free_name, run_names
from dashpot.data.importing.finding import NEEDED, Agreed, Finding, find_all
from dashpot.data.importing.likeness import Likeness, find_repeats
from dashpot.data.importing.names import stated_by_all
from dashpot.data.importing.pairs import explained, is_like
from dashpot.data.importing.reading import Measured, read_all
from dashpot.data.importing.roles import GUESSED as BY_MOTION
from dashpot.data.importing.roles import Role, named_roles
from dashpot.data.importing.rows import numeric
from dashpot.data.importing.stiffness import StiffnessFound, find_stiffness
from dashpot.data.importing.timing import pieces
from dashpot.data.importing.units import GUESSED
from dashpot.data.reversals import strokes
from dashpot.data.table import FileReader, Table
from dashpot.data.triangles import TURNS
from dashpot.text.problem import Problem

# rates of tests are set apart by no less than this
_OTHER_RATE = 2.0
# a clock in more pieces than that is no clock
_MOST_PIECES = 50

DIRECTION = "that deflection > 0 squeezes the specimen and force > 0 presses its ends apart; else write 'sign: -1'"


@dataclass(frozen=True, eq=False)
class ImportedRun:
    """A run: its name, file, and what was found; its rows where they are not all; the earlier run that it repeats.

    ``options`` are the file options with which its measurement is read, where a file holds several.
    """

    name: str
    file: Path
    reader: str | None
    finding: Finding
    rows: tuple[int, int] | None = None
    repeats: str | None = None
    options: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class ImportedTable:
    """A table of dynamic stiffness: its name, file, what was found, and the file options, as for a run."""

    name: str
    file: Path
    reader: str | None
    finding: StiffnessFound
    options: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class _Part:
    """A measurement, or a piece of one between two gaps: its rows (from 0), and which of how many pieces it is."""

    measured: Measured
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
        first, last = finding.rows or (0, self.length)
        return self.first + first + 1, self.first + last

    @property
    def length(self) -> int:
        """The number of its rows."""
        return len(next(iter(self.table.columns.values())))


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
    measured, problems = read_all(files, readers, word)
    stiffness, parts = _sorted(measured, sampling)
    findings = _slow_ones(_with_conditions(_agree(_of_one_mind(parts, sampling), sampling), parts))
    alike = find_repeats(findings)
    runs = tuple(
        ImportedRun(
            name,
            part.measured.file,
            word,
            findings[name],
            part.rows(findings[name]),
            alike.repeats.get(name),
            part.measured.options,
        )
        for name, part in parts.items()
    )
    tables = tuple(
        ImportedTable(name, each.file, word, found, each.options) for name, (each, found) in stiffness.items()
    )
    return Imported(runs, tables, _confirm(runs, alike, tables), tuple(problems))


def _sorted(
    measured: Sequence[Measured], sampling: float | None
) -> tuple[dict[str, tuple[Measured, StiffnessFound]], dict[str, _Part]]:
    """The tables of dynamic stiffness and the runs, by their names."""
    names = run_names(list(dict.fromkeys(each.file for each in measured)))
    stiffness: dict[str, tuple[Measured, StiffnessFound]] = {}
    parts: dict[str, _Part] = {}
    for each in measured:
        name = "_".join(map(str, (names[each.file], *each.options.values())))
        if found := find_stiffness(each.table):
            stiffness[free_name(name, {*stiffness, *parts})] = each, found
            continue
        for part in _parts(each, sampling):
            parts[free_name(f"{name}_{part.number}" if part.count > 1 else name, {*stiffness, *parts})] = part
    return stiffness, parts


def _parts(measured: Measured, sampling: float | None) -> list[_Part]:
    """A measurement as one, or the pieces between the gaps of its clock."""
    table = measured.table
    whole = _Part(measured, table, find_all(table, sampling))
    named = named_roles(list(table.columns), table.units).get("time")
    clock = named.column if named else whole.finding.timing.column
    time = numeric(table.columns[clock]) if clock is not None else np.zeros(0)
    found = pieces(time)
    if sampling or found == [(0, time.size)] or not 1 <= len(found) <= _MOST_PIECES:
        return [whole]
    cut = [(first, _cut(table, first, last)) for first, last in found]
    return [
        _Part(measured, piece, find_all(piece, sampling), first, False, number, len(found))
        for number, (first, piece) in enumerate(cut, 1)
    ]


def _cut(table: Table, first: int, last: int) -> Table:
    return replace(table, columns={name: values[first:last] for name, values in table.columns.items()}, lines=None)


def _of_one_mind(parts: Mapping[str, _Part], sampling: float | None) -> dict[str, _Part]:
    """Files with the same columns have displacement and force in the columns that explain most of all their forces.

    Columns whose names tell what they are mean the same in all files. Of others a file keeps its own if the common ones
    clearly do not fit it: its channels may have been plugged otherwise. Its longest piece tells for all of its pieces.
    """
    alike: dict[object, list[str]] = {}
    for name, part in parts.items():
        if len(_roles(part.finding)) == len(NEEDED):
            alike.setdefault((*part.table.columns,), []).append(name)
    settled = dict(parts)
    for names in alike.values():
        if len({_names_of(_roles(parts[name].finding)) for name in names}) <= 1:
            continue
        longest = _longest_pieces({name: parts[name] for name in names})
        usual = _usual([parts[name] for name in dict.fromkeys(longest.values())])
        for name, first in longest.items():
            own = _roles(parts[first].finding)
            common = _are_named(usual) or _fit(parts[first].table, usual, own)
            settled[name] = _with_roles(parts[name], usual if common else own, sampling)
    return settled


def _longest_pieces(parts: Mapping[str, _Part]) -> dict[str, str]:
    """The longest piece of the same measurement for each part, by their names."""
    longest: dict[int, str] = {}
    for name, part in sorted(parts.items(), key=lambda entry: entry[1].length):
        longest[id(part.measured)] = name
    return {name: longest[id(part.measured)] for name, part in parts.items()}


def _usual(parts: Sequence[_Part]) -> list[Role]:
    """The roles that explain most of all forces."""
    told = [_roles(part.finding) for part in parts]
    counts = Counter(map(_names_of, told))
    shares = {_names_of(roles): np.mean([_share(part.table, roles) for part in parts]) for roles in told}
    # to two digits: one signal in volts and in newtons is explained alike
    return max(told, key=lambda roles: (round(shares[_names_of(roles)], 2), counts[_names_of(roles)]))


def _with_roles(part: _Part, roles: Sequence[Role], sampling: float | None) -> _Part:
    """A part with displacement and force in these columns; the force that it told itself is a rival."""
    told = _roles(part.finding)
    if _names_of(told) == _names_of(roles):
        return part
    columns = {name: numeric(values) for name, values in part.table.columns.items()}
    rivals = tuple(
        name
        for name in (told[1].column, *told[1].rivals)
        if not any(name == other or is_like(columns[name], columns[other]) for other in _names_of(roles))
    )
    known = {roles[0].channel: roles[0], roles[1].channel: replace(roles[1], rivals=rivals)}
    return replace(part, finding=find_all(part.table, sampling, None, known))


def _names_of(roles: Sequence[Role]) -> tuple[str, ...]:
    return tuple(role.column for role in roles)


def _are_named(roles: Sequence[Role]) -> bool:
    return all(role.by != BY_MOTION for role in roles)


def _fit(table: Table, usual: Sequence[Role], own: Sequence[Role]) -> bool:
    """Whether the common columns explain a force as well as those of the file itself, as far as these leave open."""
    return _share(table, usual) >= 2.0 * _share(table, own) - 1.0


def _share(table: Table, roles: Sequence[Role]) -> float:
    """The share of the force that the motion explains; none of a copy of the motion, which is no force."""
    motion, force = (numeric(table.columns[role.column]) for role in roles)
    sound = np.isfinite(motion) & np.isfinite(force)
    return 0.0 if is_like(motion[sound], force[sound]) else explained(motion[sound], force[sound])


def _roles(finding: Finding) -> list[Role]:
    return [finding.channels[name].role for name in NEEDED if name in finding.channels]


def _with_conditions(findings: Mapping[str, Finding], parts: Mapping[str, _Part]) -> dict[str, Finding]:
    """With the conditions that the names of all files state."""
    stated = stated_by_all(part.measured.title for part in parts.values())
    remark = "settings that the names of the files state"
    return {
        name: replace(finding, conditions=told, confirm=(*finding.confirm, remark)) if told else finding
        for name, finding in findings.items()
        for told in [stated[parts[name].measured.title]]
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
    """The mean speed from turn to turn over the stroke, in 1/s: what a sensor scatters by is no way."""
    x = finding.signals["displacement"]
    span = float(np.ptp(x))
    return float(np.sum(strokes(x, TURNS * span))) / (span * len(x) * (finding.timing.step or 1.0))


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
    runs: Sequence[ImportedRun], alike: Likeness, tables: Sequence[ImportedTable]
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
        if run.name in alike.copies:
            about.setdefault("a run is a copy of another one to the last digit: remove one of them", []).append(
                run.name
            )
        if run.name in alike.apart:
            differ = " and ".join(alike.apart[run.name])
            remark = (
                f"a run has the motion and force of an earlier one, but another {differ}: add 'repeats' where that "
                "does not matter"
            )
            about.setdefault(remark, []).append(run.name)
    if runs:
        about["the kinds and settings of the runs: they were derived from the motion"] = [run.name for run in runs]
    if len(runs) > 1:
        about["the order of the runs: it is that of the files; a diagnosis takes it for the order of the tests"] = [
            run.name for run in runs
        ]
    return {remark: tuple(names) for remark, names in about.items()}

"""``dashpot import``: a first dataset file from measured files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dashpot.cli import complete
from dashpot.cli.columns import in_columns
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, switches
from dashpot.text.problem import InputError, Place

if TYPE_CHECKING:
    from dashpot.data.importing.imported import Imported, ImportedRun, ImportedTable

FORMAT = "dashpot-import/1"


@click.command("import")
@click.argument("files", nargs=-1, required=True, metavar="FILE...", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    metavar="OUT",
    type=click.Path(path_type=Path),
    help="The dataset file; by default dataset.yaml beside the files.",
)
@click.option("--sampling", metavar="RATE", help="The sampling rate, e.g. '1 kHz', where the files do not state it.")
@click.option(
    "--reader",
    metavar="NAME",
    help="The format, where the names do not show it: `dashpot list formats`.",
    shell_complete=complete.installed("formats"),
)
@switches("json", "quiet", "force")
def verb(
    files: tuple[Path, ...], output: Path | None, sampling: str | None, reader: str | None, switches: Switches
) -> None:
    """Write a first dataset over measured files.

    It holds channels, units, clock, kinds of runs and repeats; a file with columns of frequency, dynamic stiffness and
    loss angle (or storage and loss) becomes a table. FILE is a measured file or a folder of them. Nothing is asked:
    names, units and values are evaluated, and guesses are marked for confirmation, here and in the file. No measured
    file is changed.

    \b
    Example:
      dashpot import my/*.csv
      dashpot import my/rig_files -o my/dataset.yaml --sampling '2 kHz'
    """
    from dashpot.data.importing.files import common_folder
    from dashpot.data.importing.imported import import_files
    from dashpot.data.importing.text import dataset_text, leads_outside

    session = Session(switches)
    with session.watch("reading the files"):
        imported = import_files(files, session.readers(), reader, read_rate(sampling))
    target = place_of(output, common_folder(imported.files))
    folder = session.claim_beside(target)
    written = folder.write(
        target.name, dataset_text(imported, target.parent, target.resolve().parent.name or "dataset")
    )
    allowed = " --allow-outside" if leads_outside(imported, target.parent) else ""
    for problem in imported.problems:
        session.talk.warn(f"left out: {problem}")
    session.talk.result(as_text(imported), as_dict(imported, written))
    shown = written.relative_to(Path.cwd()) if written.is_relative_to(Path.cwd()) else written
    session.talk.say(f"\nwritten: {shown}\nNext: dashpot check {shown}{allowed}")


def read_rate(sampling: str | None) -> float | None:
    """Hz; click.UsageError for anything that is no rate."""
    from dashpot.text.quantity import si

    if sampling is None:
        return None
    try:
        rate = si(sampling, "Hz")
    except ValueError as error:
        raise click.UsageError(f"--sampling: {error}") from None
    if rate <= 0:
        raise click.UsageError(f"--sampling: expected a rate above 0, got {sampling}")
    return rate


def place_of(output: Path | None, folder: Path) -> Path:
    """Where the dataset file goes: a name ending in .yaml, or a folder."""
    if output is None:
        return folder / "dataset.yaml"
    if output.suffix in (".yaml", ".yml"):
        return output
    if output.suffix and not output.is_dir():
        raise InputError.at(Place(str(output)), "expected a file ending in .yaml, or a folder", "choose another -o")
    return output / "dataset.yaml"


def as_text(imported: Imported) -> str:
    """The channels, the tables, the runs, and what has to be confirmed."""
    from dashpot.data.importing.text import about_runs

    alike: dict[str, list[str]] = {}
    for run in imported.runs:
        alike.setdefault(in_columns(channel_rows(run)), []).append(run.name)
    parts = []
    for rows, names in alike.items():
        title = "channels" if len(alike) == 1 else f"channels of {names[0]}"
        parts.append(
            f"{title}{f' and {len(names) - 1} more' if len(alike) > 1 and names[1:] else ''}\n{indented(rows)}"
        )
    parts += [f"table {table.name}\n{indented(in_columns(column_rows(table)))}" for table in imported.tables]
    if imported.runs:
        parts.append("runs\n" + indented(in_columns([run_row(run) for run in imported.runs])))
    count = len(imported.runs) + len(imported.tables)
    remarks = [f"- {text}{about_runs(names, count)}" for text, names in imported.confirm.items()]
    return "\n\n".join([*parts, "Confirm before you trust a result:\n" + indented("\n".join(remarks))])


def channel_rows(run: ImportedRun) -> list[list[str]]:
    """A line for the clock and each channel: column, unit, sign, and what told so."""
    timing = run.finding.timing
    clock = ["sampling", f"{timing.sampling:g} Hz" if timing.sampling else "not found"]
    rows = [["time", f"'{timing.column}'", timing.unit or "", "", ""] if timing.column is not None else clock]
    for name, found in run.finding.channels.items():
        sign = "sign -1" if found.sign < 0 else ""
        rows.append(
            [name, f"'{found.role.column}'", found.unit.unit, sign, f"by {found.role.by}; unit {found.unit.by}"]
        )
    return rows


def column_rows(table: ImportedTable) -> list[list[str]]:
    """A line for each column of a table of dynamic stiffness: what it is, its name, unit, and what told it."""
    return [
        [key, f"'{found.column}'", found.unit.unit, f"unit {found.unit.by}"]
        for key, found in table.finding.columns.items()
    ]


def run_row(run: ImportedRun) -> list[str]:
    """A line for a run: name, kind, and its settings or the run that it repeats."""
    from dashpot.data.importing.text import told_settings

    settings = told_settings(run.finding.settings) | dict(run.finding.conditions)
    about = f"repeats {run.repeats}" if run.repeats else ", ".join(f"{key} {value}" for key, value in settings.items())
    return [run.name, run.finding.kind, about]


def indented(text: str) -> str:
    """The lines of a text, set in."""
    return "\n".join("  " + line for line in text.splitlines())


def as_dict(imported: Imported, written: Path) -> dict[str, Any]:
    """What was found, for programs; settings in SI."""
    return {
        "format": FORMAT,
        "dataset": str(written),
        "runs": [run_entry(run) for run in imported.runs],
        "tables": [table_entry(table) for table in imported.tables],
        "confirm": [{"what": text, "runs": list(names)} for text, names in imported.confirm.items()],
        "problems": list(imported.problems),
    }


def table_entry(table: ImportedTable) -> dict[str, Any]:
    """What was found about one table of dynamic stiffness."""
    columns = {key: {"column": found.column, "unit": found.unit.unit} for key, found in table.finding.columns.items()}
    return {"name": table.name, "file": str(table.file), "columns": columns, "unused": list(table.finding.unused)}


def run_entry(run: ImportedRun) -> dict[str, Any]:
    """What was found about one run."""
    from dashpot.text.quantity import measure

    finding = run.finding
    return {
        "name": run.name,
        "file": str(run.file),
        "file_options": dict(run.options),
        "kind": finding.kind,
        "settings": dict(finding.settings) | {key: measure(text) for key, text in finding.conditions.items()},
        "repeats": run.repeats,
        "time": {"column": finding.timing.column, "unit": finding.timing.unit, "sampling": finding.timing.sampling},
        "channels": {
            name: {"column": found.role.column, "unit": found.unit.unit, "sign": found.sign, "found_by": found.role.by}
            for name, found in finding.channels.items()
        },
        "unused": list(finding.unused),
    }

"""``dashpot study``: a staged identification, or a sensitivity study, from a file."""

from __future__ import annotations

from glob import escape
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import click

from dashpot.cli.arguments import study_and_dataset
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, output_option, switches

if TYPE_CHECKING:
    from dashpot.cli.output import OutputFolder
    from dashpot.data.dataset import Dataset
    from dashpot.fit.study.declaration import StudySpec
    from dashpot.fit.study.run import StudyResult
    from dashpot.study.sensitivity.declaration import SensitivitySpec

RECORDS = "checkpoint"


@click.command("study")
@study_and_dataset()
@click.option("--dry-run", is_flag=True, help="Only predict what the data can and cannot identify.")
@output_option(
    "Folder for study.json, the identified networks, report.html and the checkpoint; of a sensitivity study for "
    "sensitivity.json, curves.csv, bands.csv and report.html.",
    required=False,
)
@switches("jobs", "scheduler", "json", "quiet", "force", "backend", "allow_outside", "pdf")
def verb(study: str, dataset: str | None, dry_run: bool, output: Path | None, switches: Switches) -> None:
    """Run a study: models in stages, or a test that varies.

    STUDY is a file or the name of a shipped study; DATASET takes the place of the one that the study names. After an
    interruption the same command goes on where it stopped, and the results are the same to the last byte.

    A sensitivity study, such as `inspection`, varies the parameters of a network and tells what becomes of the metrics
    of a test, with bands for specimens that scatter; the metrics of the runs in a DATASET stand beside them.

    \b
    Example:
      dashpot study paper_tire --dry-run
      dashpot study paper_tire -o tire
      dashpot study inspection -o inspection
    """
    from dashpot.fit.study.reading import find_study
    from dashpot.study.sensitivity.declaration import SensitivitySpec
    from dashpot.study.sensitivity.reading import read_either

    session = Session(switches)
    planned = read_either(find_study(study), session.registry)
    if isinstance(planned, SensitivitySpec):
        return vary(planned, dataset, dry_run, output, session)
    if dry_run:
        with TemporaryDirectory() as scratch:
            return preview(planned, data_of(planned, dataset, Path(scratch), session), session)
    names = (f"{escape(plan.name)}.yaml" for plan in planned.models)
    folder = session.claim(output or Path(planned.name), "study.json", "report.html", "models.csv", *names)
    conduct(planned, data_of(planned, dataset, folder.path, session), folder, session)


def vary(planned: SensitivitySpec, dataset: str | None, dry_run: bool, output: Path | None, session: Session) -> None:
    """Run a sensitivity study and write its results."""
    from dashpot.compare.metrics import named_rows
    from dashpot.data.ends import one_force_each
    from dashpot.report.json_text import json_text
    from dashpot.report.page import render
    from dashpot.report.sensitivity import bands_grid, curves_grid, sensitivity_page, sensitivity_text
    from dashpot.report.tables import to_csv
    from dashpot.study.sensitivity.content import sensitivity_content
    from dashpot.study.sensitivity.run import run_sensitivity

    if dry_run:
        told = {"format": "dashpot-sensitivity-preview/1", "study": planned.name, "parameter_vectors": planned.lanes}
        return session.talk.result(f"{planned.name}: {planned.lanes} parameter vectors are simulated", told)
    measured = named_rows(planned.metrics, one_force_each(session.dataset(dataset)).runs) if dataset else []
    names = ("sensitivity.json", "curves.csv", "bands.csv", "report.html")
    folder = session.claim(output or Path(planned.name), *names)
    with session.watch("compiling") as progress:
        result = run_sensitivity(planned, progress)
    content = sensitivity_content(result, measured)
    with folder.together() as results:
        results.write("sensitivity.json", json_text(content))
        for grid in (curves_grid(content), bands_grid(content)):
            results.write(grid.csv_name, to_csv(grid.rows, grid.columns))
        report = results.write("report.html", render(sensitivity_page(content)))
    session.talk.result(sensitivity_text(content), content)
    session.tell_report(report)


def data_of(planned: StudySpec, dataset: str | None, folder: Path, session: Session) -> Dataset:
    """The dataset named on the command line, else the one of the study; a specimen is measured into the folder."""
    if dataset is not None:
        return session.dataset(dataset)
    source = planned.data
    if source.path is not None:
        return session.dataset(source.path)
    specimen = session.registry.specimens[source.specimen]()
    return session.dataset(specimen.measure(folder / "data" / f"{source.specimen}-{source.seed}", source.seed))


def preview(planned: StudySpec, measured: Dataset, session: Session) -> None:
    """Say what the data can and cannot identify."""
    from dashpot.fit.study.preview import preview_study
    from dashpot.study.study import preview_content, preview_text

    with session.watch("looking at the data"):
        previews = preview_study(planned, measured, session.switches.jobs)
    session.talk.result(preview_text(previews), preview_content(planned.name, previews))


def conduct(planned: StudySpec, measured: Dataset, folder: OutputFolder, session: Session) -> None:
    """Run the study and write its results; the checkpoint goes when they are complete."""
    from dashpot.fit.study.checkpoint import Checkpoint
    from dashpot.fit.study.run import run_study

    records = folder.path / RECORDS
    if session.switches.force:
        Checkpoint(records).discard()
    with session.workers(parts=planned.together) as jobs, session.watch("compiling") as progress:
        result = run_study(
            planned,
            measured,
            registry=session.registry,
            jobs=jobs,
            here=session.switches.jobs if session.switches.scheduler is None else 1,
            checkpoint=records,
            progress=progress,
        )
    write_study(result, folder, session)
    Checkpoint(records).discard()


def write_study(result: StudyResult, folder: OutputFolder, session: Session) -> None:
    """Write the networks, the result file, the table and the report."""
    from dashpot.cli.results import told_of_models
    from dashpot.report.grids import comparison_grid
    from dashpot.report.json_text import json_text
    from dashpot.report.page import render
    from dashpot.report.study import study_page
    from dashpot.report.tables import plain_table, to_csv
    from dashpot.study.masses import mass_sentence
    from dashpot.study.study import comparison_of, study_content, study_evidence

    comparison = comparison_of(result)
    content = study_content(result, comparison)
    grid = comparison_grid(content)
    page = render(study_page(content, study_evidence(result, comparison)))
    with folder.together() as results:
        for model in result.models:
            results.write(f"{model.fit.declared.name}.yaml", model.fit.identified_text)
        results.write("study.json", json_text(content))
        results.write("models.csv", to_csv(grid.rows, grid.columns))
        report = results.write("report.html", page)
    answers = [mass_sentence(mass) for mass in content["masses"]]
    answers += [step["reason"] for step in content["ladder"] if step["reason"]]
    answers += told_of_models(content)
    session.talk.result("\n".join([plain_table(grid), *answers]), content)
    session.tell_report(report)

"""``dashpot campaign``: the same models on many specimens, here or on a cluster."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import click

from dashpot.cli import complete
from dashpot.cli.output import OutputFolder
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, output_option, switches

if TYPE_CHECKING:
    from dashpot.campaign.declaration import CampaignSpec
    from dashpot.campaign.run import CampaignResult
    from dashpot.contract.registry import Registry
    from dashpot.kernel.workers import Jobs

RECORDS, JOBS = "checkpoint", "jobs"
FILES = ("campaign.json", "campaign.html", "specimens.csv", "population.csv", "specimens.parquet")


@click.command("campaign")
@click.argument("campaign", shell_complete=complete.campaigns)
@click.option("--dry-run", is_flag=True, help="Run the first job of each kind, and estimate the time of all.")
@click.option("--parquet", is_flag=True, help="Write the table of specimens as Parquet, too.")
@output_option(
    "Folder for campaign.json, campaign.html, the tables, a folder for each job and the checkpoint.", required=False
)
@switches("jobs", "scheduler", "json", "quiet", "force", "backend")
def verb(campaign: str, dry_run: bool, parquet: bool, output: Path | None, switches: Switches) -> None:
    """Evaluate many specimens as a population.

    Each is fitted, compared or diagnosed by itself. CAMPAIGN is a file. Without --scheduler jobs run one after the
    other in this process. After an interruption the same command goes on where it stopped, and the results are the same
    to the last byte; a job that failed is set aside with its message and tried again by the same command.

    \b
    Example:
      dashpot campaign mounts.yaml --dry-run
      dashpot campaign mounts.yaml -o mounts --scheduler local:8
    """
    from dashpot.campaign.reading import read_campaign

    session = Session(switches)
    planned = read_campaign(Path(campaign), session.registry)
    if dry_run:
        return preview(planned, session)
    if parquet:
        from dashpot.report.parquet import require_parquet

        require_parquet()
    conduct(planned, claimed(output or Path(planned.name), session), parquet, session)


def claimed(output: Path, session: Session) -> OutputFolder:
    """The result folder; one with a checkpoint is gone on with, whatever else is in it."""
    from dashpot.fit.study.checkpoint import Checkpoint

    if session.switches.force:
        Checkpoint(output / RECORDS).discard()
    unfinished = (output / RECORDS).is_dir()
    return session.claim(output, *(() if unfinished else FILES))


def count_of(workers: Jobs) -> int:
    """How many jobs are done at once."""
    return max(sum(workers.nthreads().values()), 1) if hasattr(workers, "nthreads") else 1


def preview(planned: CampaignSpec, session: Session) -> None:
    """Tell what the campaign would cost."""
    from dashpot.campaign.preview import preview_campaign, preview_content, preview_text

    with session.workers(planned.memory) as jobs:
        count = count_of(jobs)
        with session.watch("doing a first job of each kind"):
            costs = preview_campaign(planned, jobs, write_and_discard)
    content = preview_content(planned, costs, count)
    session.talk.result(preview_text(content), content)


def conduct(planned: CampaignSpec, folder: OutputFolder, parquet: bool, session: Session) -> None:
    """Do the jobs and write the results; the checkpoint goes when none has failed."""
    from dashpot.campaign.run import run_campaign
    from dashpot.fit.study.checkpoint import Checkpoint

    records = folder.path / RECORDS
    write = JobWriter(str(folder.path.resolve() / JOBS))
    with session.workers(planned.memory) as jobs, session.watch("jobs") as progress:
        result = run_campaign(planned, jobs=jobs, checkpoint=records, write=write, progress=progress)
    write_campaign(result, folder, parquet, session)
    if not result.failures:
        Checkpoint(records).discard()


@dataclass(frozen=True)
class JobWriter:
    """Writes what a job found into a folder of its own, where the job is done."""

    folder: str

    def __call__(self, found: Any, job: str, registry: Registry) -> None:
        from dashpot.cli.results import write_comparison, write_diagnosis, write_fit
        from dashpot.compare.comparison import Comparison
        from dashpot.diagnose.diagnosis import Diagnosis

        folder = OutputFolder(Path(self.folder) / job, force=True)
        folder.claim()
        if isinstance(found, Diagnosis):
            write_diagnosis(found, folder)
        elif isinstance(found, Comparison):
            write_comparison(found, folder)
        else:
            write_fit(found, folder)


def write_and_discard(found: Any, job: str, registry: Registry) -> None:
    """The same for the time that it takes."""
    with TemporaryDirectory(prefix="dashpot-") as folder:
        JobWriter(folder)(found, job, registry)


def write_campaign(result: CampaignResult, folder: OutputFolder, parquet: bool, session: Session) -> None:
    """Write the result file, the tables and the report."""
    from dashpot.campaign.content import campaign_content
    from dashpot.report.campaign import campaign_headline, campaign_page, named_grid, population_grid, specimens_grid
    from dashpot.report.json_text import json_text
    from dashpot.report.page import render
    from dashpot.report.tables import plain_table, to_csv

    with session.watch("looking at the population"):
        content = campaign_content(result)
    specimens, population = specimens_grid(content), population_grid(content)
    with folder.together() as results:
        results.write("campaign.json", json_text(content))
        for grid in (specimens, population):
            results.write(grid.csv_name, to_csv(grid.rows, grid.columns))
        if parquet:
            from dashpot.report.parquet import to_parquet

            results.write_bytes("specimens.parquet", to_parquet(specimens))
        report = results.write("campaign.html", render(campaign_page(content)))
    tables = [plain_table(grid) for grid in (population, named_grid(content)) if grid.rows]
    session.talk.result("\n".join([*tables, campaign_headline(content)]), content)
    for failure in content["failures"]:
        session.talk.warn(f"{failure['job']}: set aside: {failure['reason']}")
    session.talk.say(f"report: {report}")

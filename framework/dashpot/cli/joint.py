"""``dashpot joint``: identify several specimens together, with parameters in common."""

from __future__ import annotations

from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING

import click

from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, output_option, switches

if TYPE_CHECKING:
    from dashpot.cli.output import OutputFolder
    from dashpot.fit.joint.run import JointResult


@click.command("joint")
@click.argument("file", metavar="JOINT", type=click.Path(path_type=Path))
@output_option("Folder for the identified networks SPECIMEN.yaml, joint.json, shared.csv and report.html.")
@switches("jobs", "scheduler", "json", "quiet", "force", "backend", "allow_outside")
def verb(file: Path, output: Path, switches: Switches) -> None:
    """Identify specimens with parameters in common.

    JOINT is a file with specimens, each a network and a dataset, and the parameters that are one number for all of
    them. Each specimen is fitted alone first; the report tells whether the specimens contradict one another.

    \b
    Example:
      dashpot joint two_bushings.yaml -o together
    """
    from dashpot.fit.joint.reading import read_joint
    from dashpot.fit.joint.run import fit_joint

    session = Session(switches)
    spec = read_joint(file, session.registry)
    datasets = {each.name: session.sound_dataset(each.data) for each in spec.specimens}
    names = [f"{escape(each.name)}.yaml" for each in spec.specimens]
    folder = session.claim(output, "joint.json", "shared.csv", "report.html", *names)
    with session.workers() as jobs, session.watch("compiling", len(names) + 1) as progress:
        found = fit_joint(spec, datasets, jobs=jobs, progress=progress)
    write(found, folder, session)


def write(found: JointResult, folder: OutputFolder, session: Session) -> None:
    """Write the networks, the result file, the table and the report."""
    from dashpot.report.joint import joint_page, shared_grid, specimens_grid
    from dashpot.report.json_text import json_text
    from dashpot.report.page import render
    from dashpot.report.tables import plain_table, to_csv

    content = found.as_dict()
    grid = shared_grid(content)
    with folder.together() as results:
        for name, fit in found.fits.items():
            results.write(f"{name}.yaml", fit.identified_text)
        results.write("joint.json", json_text(content))
        results.write(grid.csv_name, to_csv(grid.rows, grid.columns))
        report = results.write("report.html", render(joint_page(content)))
    session.talk.result("\n".join([plain_table(grid), plain_table(specimens_grid(content)), found.ending]), content)
    session.tell_report(report)

"""``dashpot compare``: the RMSE table of several networks."""

from __future__ import annotations

from pathlib import Path

import click

from dashpot.cli.arguments import models_and_dataset
from dashpot.cli.family import with_families
from dashpot.cli.results import COMPARISON_FILES, comparison_text, write_comparison
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, optimizer_options, output_option, switches


@click.command("compare")
@models_and_dataset()
@output_option("Folder for compare.json, compare.csv and report.html.")
@optimizer_options
@switches("seed", "jobs", "scheduler", "json", "quiet", "force", "backend", "allow_outside", "pdf")
def verb(
    models: tuple[str, ...],
    dataset: str,
    output: Path,
    optimizer: str | None,
    settings: tuple[str, ...],
    switches: Switches,
) -> None:
    """Compare several networks on one dataset.

    All are fitted to the same runs. Each MODEL is a network file, a shipped name, or a family of shipped networks such
    as tires, mounts or bushing. Errors are given on the runs that were fitted and on the runs held out, next to the
    noise floor.

    \b
    Example:
      dashpot compare kelvin_voigt gehmann tire_model_5 my/dataset.yaml -o comparison
      dashpot compare bushing my/dataset.yaml -o comparison
    """
    from dashpot.compare.comparison import compare

    session = Session(switches, optimizer, settings)
    networks = [session.network(model) for model in with_families(models, session)]
    measured = session.sound_dataset(dataset)
    folder = session.claim(output, *COMPARISON_FILES)
    comparison = session.run(compare, networks, measured)
    with session.watch("writing the report"):
        report = write_comparison(comparison, folder)
    session.talk.result(comparison_text(comparison), comparison.as_dict())
    session.tell_report(report)

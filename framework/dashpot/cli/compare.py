"""``dashpot compare``: the RMSE table of several networks."""

from __future__ import annotations

from pathlib import Path

import click

from dashpot.cli import complete
from dashpot.cli.results import COMPARISON_FILES, comparison_text, write_comparison
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, optimizer_options, output_option, switches


@click.command("compare")
@click.argument("specs", nargs=-1, required=True, metavar="SPEC...", shell_complete=complete.networks)
@click.option("--data", "dataset", metavar="DATASET", required=True, help="The measured runs.",
              shell_complete=complete.datasets)  # fmt: skip
@output_option("Folder for compare.json, compare.csv and report.html.")
@optimizer_options
@switches("seed", "jobs", "json", "quiet", "force", "backend", "allow_outside", "pdf")
def verb(
    specs: tuple[str, ...],
    dataset: str,
    output: Path,
    optimizer: str | None,
    settings: tuple[str, ...],
    switches: Switches,
) -> None:
    """Fit several networks to the same measurements and compare their errors.

    Each SPEC is a network file or a shipped name. Errors are given on the runs that were fitted and on the runs held
    out, next to the noise floor.

    \b
    Example:
      dashpot compare kelvin_voigt gehmann tire_model_5 --data my/dataset.yaml -o comparison
    """
    from dashpot.compare.comparison import compare

    session = Session(switches, optimizer, settings)
    networks = [session.network(spec) for spec in specs]
    measured = session.sound_dataset(dataset)
    folder = session.claim(output, *COMPARISON_FILES)
    comparison = session.run(compare, networks, measured)
    with session.watch("writing the report"):
        report = write_comparison(comparison, folder)
    session.talk.result(comparison_text(comparison), comparison.as_dict())
    session.tell_report(report)

"""``dashpot fit``: identify the parameters of a network."""

from __future__ import annotations

from pathlib import Path

import click

from dashpot.cli import complete
from dashpot.cli.results import fit_files, write_fit
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, optimizer_options, output_option, switches


@click.command("fit")
@click.argument("spec", shell_complete=complete.networks)
@click.argument("dataset", shell_complete=complete.datasets)
@output_option("Folder for the identified network NAME.yaml, fit.json, tables and report.html.")
@optimizer_options
@switches("seed", "jobs", "json", "quiet", "force", "backend", "allow_outside", "pdf")
def verb(
    spec: str, dataset: str, output: Path, optimizer: str | None, settings: tuple[str, ...], switches: Switches
) -> None:
    """Identify the parameters of a network from measurements.

    SPEC is a network file or a shipped name. The identified network is the same file with its numbers filled in, their
    uncertainty and where they come from.

    \b
    Example:
      dashpot fit tire_model_1 my/dataset.yaml --seed 7 -o identified
    """
    from dashpot.fit.api import fit_network

    session = Session(switches, optimizer, settings)
    network, measured = session.network(spec), session.sound_dataset(dataset)
    folder = session.claim(output, *fit_files(network.name))
    found = session.run(fit_network, network, measured)
    with session.watch("writing the report"):
        report = write_fit(found, folder)
    session.talk.result(found.summary(), found.as_dict())
    session.talk.say(f"identified network: {folder.path / network.name}.yaml")
    session.tell_report(report)

"""``dashpot diagnose``: what a network gets wrong, the causes, and the extended network."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import click

from dashpot.cli.arguments import model_and_dataset
from dashpot.cli.results import checked, diagnosis_files, diagnosis_text, write_diagnosis
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, optimizer_options, output_option, switches


@click.command("diagnose")
@model_and_dataset()
@output_option("Folder for diagnosis.json, the extended network and report.html.")
@optimizer_options
@click.option(
    "--relevance",
    metavar="PERCENT",
    type=click.FloatRange(0.0, 100.0),
    default=0.15,
    show_default=True,
    help="Causes whose removal increases the error by less are not named.",
)
@switches("seed", "jobs", "json", "quiet", "force", "backend", "allow_outside", "pdf")
def verb(
    model: str,
    dataset: str,
    output: Path,
    optimizer: str | None,
    settings: tuple[str, ...],
    relevance: float,
    switches: Switches,
) -> None:
    """Diagnose the residual of a network.

    Causes are named, the network is extended, and the gain is measured. MODEL is a network file or a shipped name. The
    gain is measured on held-out runs. That nothing is missing, or that no known cause fits, are ordinary answers.

    \b
    Example:
      dashpot diagnose kelvin_voigt my/dataset.yaml -o diagnosis
    """
    from dashpot.diagnose.diagnose import diagnose

    session = Session(switches, optimizer, settings)
    network, measured = session.network(model), session.dataset(dataset)
    priors = [slot.path for slot in network.slots() if slot.value.prior]
    if priors:
        session.talk.warn(f"a diagnosis asks what the data say: the priors of {', '.join(priors)} do not count in it")
    folder = session.claim(output, *diagnosis_files(network.name))
    diagnosis = session.run(partial(diagnose, relevance=relevance / 100.0), network, measured)
    with session.watch("writing the report"):
        report = write_diagnosis(diagnosis, folder)
        check = checked(diagnosis, folder, session.registry)
    session.talk.result(diagnosis_text(diagnosis), diagnosis.as_dict())
    for remark in diagnosis.remarks:
        session.talk.say(remark)
    session.talk.say(check)
    session.tell_report(report)

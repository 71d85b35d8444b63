"""``dashpot fit``: identify the parameters of a network."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import click

from dashpot.cli.arguments import model_and_dataset
from dashpot.cli.family import fit_family, refuse_family
from dashpot.cli.results import fit_files, write_fit
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, optimizer_options, output_option, switches
from dashpot.model.shipped import family_of


@click.command("fit")
@model_and_dataset()
@output_option("Folder for the identified network NAME.yaml, fit.json, tables and report.html.")
@click.option(
    "--prior",
    "earlier",
    metavar="NETWORK",
    type=click.Path(path_type=Path),
    help="Identified network of an earlier fit to other data: its intervals become priors.",
)
@click.option("--sampler", metavar="NAME", help="Draw from the posterior of the fit, too: emcee (extra sampler).")
@click.option(
    "--sampler-steps",
    "steps",
    metavar="N",
    type=click.IntRange(min=1),
    help="Steps of the sampler at most; it ends when it has converged. 10000 by default.",
)
@optimizer_options
@switches("seed", "jobs", "json", "quiet", "force", "backend", "allow_outside", "pdf")
def verb(
    model: str,
    dataset: str,
    output: Path,
    earlier: Path | None,
    sampler: str | None,
    steps: int | None,
    optimizer: str | None,
    settings: tuple[str, ...],
    switches: Switches,
) -> None:
    """Identify the parameters of a network from measurements.

    MODEL is a network file or a shipped name. The identified network is the same file with the
    identified parameters, their 95 % intervals, and the data and range of the identification.
    Of a family of shipped networks, such as bushing or mounts, all are fitted and compared.

    \b
    Example:
      dashpot fit tire_model_1 my/dataset.yaml --seed 7 -o identified
      dashpot fit bushing my/dataset.yaml -o bushings
    """
    from dashpot.fit.api import fit_network
    from dashpot.fit.posterior import STEPS, require_sampler
    from dashpot.fit.prior import with_earlier

    if sampler:
        require_sampler(sampler, steps or STEPS)
    elif steps:
        raise click.UsageError("--sampler-steps is for a sampler: name it with --sampler")
    for option in ["--prior"] * bool(earlier) + ["--sampler"] * bool(sampler):
        refuse_family(model, option)
    session = Session(switches, optimizer, settings)
    if family_of(model):
        return fit_family(model, session.sound_dataset(dataset), output, session)
    network, measured = session.network(model), session.sound_dataset(dataset)
    if earlier:
        network = with_earlier(network, session.network(str(earlier)), measured.digest, earlier.name)
    folder = session.claim(output, *fit_files(network.name))
    work = partial(fit_network, sampler=sampler, sampler_steps=steps or STEPS)
    found = session.run(work, network, measured)
    with session.watch("writing the report"):
        report = write_fit(found, folder)
    session.talk.result(found.summary(), found.as_dict())
    session.talk.say(f"identified network: {folder.path / network.name}.yaml")
    session.tell_report(report)

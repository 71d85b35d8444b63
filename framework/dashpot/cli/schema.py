"""``dashpot schema``: what editors need to complete and check the YAML files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from dashpot.cli.complete import beginning
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, output_option, switches
from dashpot.text.problem import nearest

if TYPE_CHECKING:
    from dashpot.contract.registry import Registry

Schemas = dict[str, Callable[["Registry"], dict[str, Any]]]


@click.command("schema")
@click.argument("kind", required=False, metavar="[KIND]", shell_complete=lambda _, __, typed: beginning(KINDS, typed))
@click.option("--all", "every", is_flag=True, help="Write the schemas of all kinds of files.")
@output_option("A folder for KIND.schema.json; without it standard output.", required=False)
@switches("quiet", "force")
def verb(kind: str | None, every: bool, output: Path | None, switches: Switches) -> None:
    """Print the JSON schema of a kind of file.

    With it an editor completes and checks YAML files. KIND is network, dataset, rig, study, sensitivity, joint or
    campaign. The schema knows the elements, rigs, optimizers and formats that are installed. Editors with the
    yaml-language-server use it where the first line of a file says:

    \b
      # yaml-language-server: $schema=schemas/network.schema.json

    \b
    Example:
      dashpot schema network
      dashpot schema --all -o schemas
    """
    if every == (kind is not None):
        raise click.UsageError(f"Say either a kind ({', '.join(KINDS)}) or --all")
    if every and output is None:
        raise click.UsageError("--all writes several files: say -o FOLDER")
    if kind is not None and kind not in KINDS:
        raise click.UsageError(f"No schema of '{kind}', {nearest(kind, KINDS) or 'there are: ' + ', '.join(KINDS)}")
    session = Session(switches)
    texts = {f"{name}.schema.json": text_of(name, session.registry) for name in (KINDS if every else [str(kind)])}
    if output is None:
        return click.echo("".join(texts.values()), nl=False)
    folder = session.claim(output, *texts)
    with folder.together() as results:
        written = [results.write(name, text) for name, text in texts.items()]
    for path in written:
        session.talk.say(f"written: {path}")


def text_of(kind: str, registry: Registry) -> str:
    """The schema of a kind of file as text."""
    from dashpot.report.json_text import json_text

    return json_text(KINDS[kind](registry))


def network(registry: Registry) -> dict[str, Any]:
    """The schema of a network file."""
    from dashpot.model.schema import network_schema

    return network_schema(registry.elements)


def dataset(registry: Registry) -> dict[str, Any]:
    """The schema of a dataset file."""
    from dashpot.data.schema import dataset_schema

    return dataset_schema({word: reader.options for word, reader in registry.formats.items()})


def rig(registry: Registry) -> dict[str, Any]:
    """The schema of a bench file."""
    from dashpot.contract.bench_schema import bench_schema

    return bench_schema(registry.rigs)


def study(registry: Registry) -> dict[str, Any]:
    """The schema of a study file."""
    from dashpot.fit.study.schema import study_schema

    return study_schema(registry.optimizers, tuple(registry.specimens))


def sensitivity(registry: Registry) -> dict[str, Any]:
    """The schema of a sensitivity study."""
    from dashpot.study.sensitivity.schema import sensitivity_schema

    return sensitivity_schema(tuple(registry.metrics))


def campaign(_: Registry) -> dict[str, Any]:
    """The schema of a campaign file."""
    from dashpot.campaign.schema import campaign_schema

    return campaign_schema()


def joint(_: Registry) -> dict[str, Any]:
    """The schema of a joint file."""
    from dashpot.fit.joint.schema import joint_schema

    return joint_schema()


KINDS: Schemas = {
    "network": network,
    "dataset": dataset,
    "rig": rig,
    "study": study,
    "sensitivity": sensitivity,
    "joint": joint,
    "campaign": campaign,
}

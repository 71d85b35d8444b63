"""``dashpot export``: a network for another program."""

from __future__ import annotations

from glob import escape
from pathlib import Path

import click

from dashpot.cli import complete
from dashpot.cli.session import Session, split_setting
from dashpot.cli.switches import Switches, output_option, switches
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import nearest


@click.command("export")
@click.argument("model", shell_complete=complete.networks)
@click.option(
    "--to",
    "target",
    metavar="TARGET",
    required=True,
    help="See `dashpot list exports`.",
    shell_complete=complete.installed("exports"),
)
@click.option(
    "--set",
    "settings",
    metavar="KEY=VALUE",
    multiple=True,
    help="An option of the target.",
    shell_complete=complete.settings,
)
@click.option(
    "--at",
    "conditions",
    metavar="SETTING=VALUE",
    multiple=True,
    help="A setting on which parameters depend, with its unit.",
)
@output_option("A folder.")
@switches("json", "quiet", "force", "backend")
def verb(
    model: str, target: str, settings: tuple[str, ...], conditions: tuple[str, ...], output: Path, switches: Switches
) -> None:
    """Write a network for another program.

    Its parameters are those of the file. MODEL is a network file or a shipped name. What a target cannot express is
    refused before anything is written.

    \b
    Example:
      dashpot export identified.yaml --to c -o my_controller
      dashpot export identified.yaml --to fmu -o my_vehicle
      dashpot export identified.yaml --to fmu --at "pressure=2.2 bar" -o my_vehicle
    """
    from dashpot.contract.options import read_options

    session = Session(switches)
    exports = session.registry.exports
    if target not in exports:
        known = f"there are: {', '.join(exports)}" if exports else "no plugin gives any"
        raise click.UsageError(f"No export to '{target}', {nearest(target, exports) or known}")
    try:
        export = exports[target](**read_options(exports[target], dict(map(split_setting, settings))))
    except ValueError as error:
        raise click.UsageError(str(error)) from error
    network = _at(session.network(model), conditions)
    with session.watch("exporting"):
        files = export.files(network)
    folder = session.claim(output, *map(escape, files))
    with folder.together() as results:
        for name, content in files.items():
            results.write_bytes(name, content)
    told = {"format": "dashpot-export/1", "network": network.name, "target": target, "files": sorted(files)}
    session.talk.result(f"exported: {', '.join(str(output / name) for name in sorted(files))}", told)


def _at(network: NetworkSpec, conditions: tuple[str, ...]) -> NetworkSpec:
    """The network under the conditions told; as it is where none are told."""
    from dashpot.kernel.settings import at_settings
    from dashpot.text.quantity import measure

    if not conditions:
        return network
    try:
        given = {key: measure(value) for key, value in (split_setting(each, "--at") for each in conditions)}
        return at_settings(network, given)
    except ValueError as error:
        raise click.UsageError(f"--at: {error}") from error

"""``dashpot show``: a network as it is declared."""

from __future__ import annotations

from typing import Any

import click

from dashpot.cli import complete
from dashpot.cli.draw import text_for_terminal
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, switches
from dashpot.model.network import NetworkSpec, Slot


@click.command("show")
@click.argument("model", shell_complete=complete.networks)
@switches("json", "quiet")
def verb(model: str, switches: Switches) -> None:
    """Show a network with its parameters.

    Shown are what it is for, its source, its schematic, and its parameters with meaning, range and unit.

    MODEL is a network file or a shipped name. `dashpot draw` writes the schematic as a picture.

    \b
    Example:
      dashpot show gehmann
    """
    session = Session(switches)
    network = session.network(model)
    session.talk.result(as_text(network), content_of(network))


def as_text(network: NetworkSpec) -> str:
    """The network for the terminal."""
    from dashpot.report.parameters import parameters_grid
    from dashpot.report.tables import plain_table

    source = f"Source: {network.source}" if network.source else ""
    head = "\n".join(filter(None, [network.name, network.about, source, f"File: {network.file}"]))
    drawing, parameters = text_for_terminal(network, plain=False), plain_table(parameters_grid(network))
    return "\n".join([head, "", drawing, parameters]).rstrip()


def content_of(network: NetworkSpec) -> dict[str, Any]:
    """What ``--json`` tells; numbers in SI."""
    return {
        "format": "dashpot-show/1",
        "network": network.name,
        "about": network.about,
        "source": network.source,
        "file": network.file,
        "parameters": [_parameter(slot) for slot in network.slots()],
        "curves": {path: curve.form for path, curve in network.curves().items()},
    }


def _parameter(slot: Slot) -> dict[str, Any]:
    value = slot.value
    return {
        "path": slot.path,
        "value": value.number,
        "unit": value.unit,
        "role": value.role,
        "bounds": value.bounds,
        "interval": value.interval,
        **({"expression": value.expression} if value.expression else {}),
    }

"""``dashpot draw``: the rheological schematic of a network."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from dashpot.cli import complete
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, output_option, switches
from dashpot.model.network import NetworkSpec

WRITTEN = (".svg", ".txt")


@click.command("draw")
@click.argument("model", shell_complete=complete.networks)
@output_option(
    "A file ending in .svg for a picture, or in .txt; without it the terminal.", files=WRITTEN, required=False
)
@click.option("--ascii", "plain", is_flag=True, help="Draw with ASCII characters only.")
@switches("json", "quiet", "force")
def verb(model: str, output: Path | None, plain: bool, switches: Switches) -> None:
    """Draw the schematic of a network.

    It shows springs, dashpots, sliders, masses, names and values. MODEL is a network file or a shipped name. Where the
    terminal knows ASCII only, the drawing does without more.

    \b
    Example:
      dashpot draw tire_model_5
      dashpot draw tire_model_5 -o tire_model_5.svg
    """
    if output is not None and output.suffix not in WRITTEN:
        raise click.UsageError(f"-o expected a file ending in {' or '.join(WRITTEN)}, got '{output.name}'")
    session = Session(switches)
    network = session.network(model)
    if output is None:
        text = text_for_terminal(network, plain)
        if switches.json:
            return session.talk.result("", content_of(network, None, text))
        return click.echo(text, nl=False)
    folder = session.claim_beside(output)
    text = drawing(network, output.suffix, plain)
    folder.write(output.name, text)
    session.talk.result(f"drawn: {output}", content_of(network, output, text))


def content_of(network: NetworkSpec, output: Path | None, text: str) -> dict[str, Any]:
    """What ``--json`` tells: the drawing, and the file that it is in."""
    file = str(output) if output else None
    return {"format": "dashpot-drawing/1", "network": network.name, "file": file, "drawing": text}


def drawing(network: NetworkSpec, suffix: str, plain: bool) -> str:
    """The content of a file with this ending."""
    from dashpot.report.schematic.svg import svg
    from dashpot.report.schematic.terminal import text_drawing

    return svg(network) if suffix == ".svg" else text_drawing(network, plain)


def text_for_terminal(network: NetworkSpec, plain: bool) -> str:
    """The drawing in characters that standard output can carry."""
    from dashpot.report.schematic.terminal import text_drawing

    text = text_drawing(network, plain)
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:
        return text_drawing(network, ascii_only=True)
    return text

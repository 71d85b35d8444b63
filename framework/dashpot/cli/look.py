"""``dashpot look``: pictures of measured runs before any model."""

from __future__ import annotations

from pathlib import Path

import click

from dashpot.cli import complete
from dashpot.cli.results import LOOK_FILES, look_text, write_look
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, output_option, switches


@click.command("look")
@click.argument("dataset", metavar="DATASET", shell_complete=complete.datasets)
@output_option("Folder for look.json and report.html.")
@switches("seed", "json", "quiet", "force", "allow_outside", "pdf")
def verb(dataset: str, output: Path, switches: Switches) -> None:
    """Look at measured runs before any model.

    Loops, force over velocity at mid stroke, over deflection at low speed and after reversals, dynamic stiffness,
    energy per cycle, repeats and spectra; and the explainable error.

    \b
    Example:
      dashpot look my/dataset.yaml -o look
    """
    from dashpot.compare.look import look

    session = Session(switches)
    measured = session.dataset(dataset)
    folder = session.claim(output, *LOOK_FILES)
    with session.watch("looking"):
        seen = look(measured, switches.seed, session.registry.metrics.values())
        report = write_look(seen, folder)
    session.talk.result(look_text(seen), seen.as_dict())
    session.tell_report(report)

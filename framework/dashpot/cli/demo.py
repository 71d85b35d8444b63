"""``dashpot demo``: measurement, comparison and diagnosis of a virtual specimen."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from dashpot.cli import complete
from dashpot.cli.results import (
    COMPARISON_FILES,
    comparison_text,
    diagnosis_files,
    diagnosis_text,
    write_comparison,
    write_diagnosis,
)
from dashpot.cli.session import Session
from dashpot.cli.switches import Switches, output_option, switches
from dashpot.text.problem import nearest

if TYPE_CHECKING:
    from dashpot.contract.registry import Registry
    from dashpot.contract.specimen import Specimen


@click.command("demo")
@click.option(
    "--specimen", metavar="NAME", help="See `dashpot list specimens`.", shell_complete=complete.installed("specimens")
)
@output_option("Folder for the data, the comparison and the diagnosis.", default="dashpot-demo", show_default=True)
@switches("seed", "jobs", "json", "quiet", "force", "backend")
def verb(specimen: str | None, output: Path, switches: Switches) -> None:
    """Measure, compare and diagnose on a virtual rig.

    The shipped networks are compared on a virtual specimen, and the simplest one is diagnosed. The specimen is a
    program of its own with more effects than any network.

    \b
    Example:
      dashpot demo -o dashpot-demo
    """
    from dashpot.compare.comparison import compare
    from dashpot.diagnose.diagnose import diagnose

    session = Session(switches)
    chosen = choose_specimen(specimen, session.registry)
    session.claim(output)
    tables = session.claim(output / "comparison", *COMPARISON_FILES)
    causes = session.claim(output / "diagnosis", *diagnosis_files(chosen.suspect))
    session.talk.say(f"{chosen.word}: {chosen.about}")
    data = chosen().measure(output / "data" / f"{chosen.word}-{switches.seed}", switches.seed)
    measured = session.dataset(data)

    comparison = session.run(compare, [session.network(name) for name in chosen.networks], measured)
    diagnosis = session.run(diagnose, session.network(chosen.suspect), measured)
    with session.watch("writing the reports"):
        first_report = write_comparison(comparison, tables)
        second_report = write_diagnosis(diagnosis, causes)

    content = {"format": "dashpot-demo/1", "comparison": comparison.as_dict(), "diagnosis": diagnosis.as_dict()}
    told = [comparison_text(comparison), "", diagnosis_text(diagnosis), *diagnosis.remarks]
    session.talk.result("\n".join(told), content)
    session.talk.say(f"\nOpen in a browser:\n  {first_report.resolve()}\n  {second_report.resolve()}")


def choose_specimen(word: str | None, registry: Registry) -> type[Specimen]:
    """The specimen of that word, or the first one offered for demonstrations."""
    offered = {name: made for name, made in registry.specimens.items() if made.demo}
    if word is None and offered:
        return next(iter(offered.values()))
    if word in offered:
        return offered[word]
    hint = nearest(word or "", offered) or f"there are: {', '.join(offered) or 'none'}"
    raise click.UsageError(
        f"No specimen '{word}' to demonstrate with, {hint}" if word else "No plugin gives a specimen"
    )

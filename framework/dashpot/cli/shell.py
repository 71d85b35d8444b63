"""The group of verbs. Each verb is imported when it is called for, so that the command starts at once."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from keyword import iskeyword
from typing import Any

import click

from dashpot import __version__
from dashpot.cli.outcome import exit_code_of
from dashpot.text.problem import of_family

VERBS = (
    "demo",
    "list",
    "show",
    "import",
    "check",
    "look",
    "draw",
    "simulate",
    "export",
    "fit",
    "compare",
    "diagnose",
    "study",
    "joint",
    "campaign",
    "schema",
    "doctor",
    "warm",
    "completion",
)


class Verbs(click.Group):
    """Finds the verb ``fit`` in the module ``dashpot.cli.fit``."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """All verbs, in the order in which one meets them."""
        return list(VERBS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The verb's command, imported now."""
        # a module cannot be called after a keyword of the language
        module = f"dashpot.cli.{cmd_name}{'_' * iskeyword(cmd_name)}"
        return import_module(module).verb if cmd_name in VERBS else None

    def resolve_command(self, ctx: click.Context, args: list[str]) -> tuple[Any, ...]:
        """As click does, with the nearest verb for one that is unknown."""
        word = args[0]
        if word not in VERBS and not word.startswith("-"):
            ctx.fail(f"No such verb '{word}', {of_family(word, VERBS) or 'there are: ' + ', '.join(VERBS)}")
        return super().resolve_command(ctx, args)


@click.group(cls=Verbs, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="dashpot")
def dashpot() -> None:
    """Rheological models: fit them to measurements, compare them, and diagnose their residuals.

    \b
    First steps:
      dashpot demo                            compare and diagnose models of a virtual tire
      dashpot import my                       describe the measured files in the folder my
      dashpot look my -o look                 look at them
      dashpot list models                     networks that are shipped
      dashpot compare spring gehmann my -o comparison
      dashpot diagnose gehmann my -o diagnosis

    `dashpot VERB --help` explains a verb. Arguments stand in one order, MODEL...
    DATASET; a MODEL is a YAML file or the name of a shipped network, see `dashpot list models`.
    """


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command; its exit code."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    return exit_code_of(lambda: dashpot.main(args=words, prog_name="dashpot", standalone_mode=False), "--json" in words)

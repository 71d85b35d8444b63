"""``dashpot completion``: the shell completes verbs, options, names and files."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

SHELLS = ("bash", "zsh", "fish")
VARIABLE = "_DASHPOT_COMPLETE"


@click.command("completion")
@click.argument("shell", type=click.Choice(SHELLS))
def verb(shell: str) -> None:
    """Print the completion script of a shell.

    With it the shell completes verbs, options, networks, optimizers, rigs, their options and files.

    In bash and zsh put this line into ~/.bashrc or ~/.zshrc, in fish write the text into
    ~/.config/fish/completions/dashpot.fish; then open a new terminal.

    \b
    Example:
      dashpot completion bash
      eval "$(dashpot completion bash)"
    """
    from dashpot.cli.shell import dashpot

    made = get_completion_class(shell)
    assert made is not None
    click.echo(made(dashpot, {}, "dashpot", VARIABLE).source())

"""The result on standard output, and what is said beside it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import click

from dashpot.cli.switches import Switches
from dashpot.text.name import visible

LINES = "\n\t"  # of a text of several lines


@dataclass(frozen=True)
class Talk:
    """Tells the result as text or JSON, and everything else where it does not mix with JSON."""

    switches: Switches

    def say(self, text: str) -> None:
        """Something good to know."""
        if not self.switches.quiet:
            click.echo(visible(text, LINES), err=self.switches.json)

    def warn(self, text: str) -> None:
        """Something the user should see, even when quiet."""
        told = text if text.startswith("warning") else f"warning: {text}"
        click.echo(visible(told, LINES), err=True)

    def result(self, text: str, content: Mapping[str, Any]) -> None:
        """What the user asked for: text to read or, with ``--json``, the content."""
        if self.switches.json:
            from dashpot.report.json_text import json_text

            click.echo(json_text(content), nl=False)
        elif text:
            self.say(text)

"""Every verb has its page, with all its options; test_site runs the commands of its example."""

from __future__ import annotations

import re
import sys

import click
import pytest
from architecture.source import ROOT

from dashpot.cli.shell import VERBS
from dashpot.cli.shell import dashpot as command

sys.path.insert(0, str(ROOT / "docs"))

from building.verbs import reference  # noqa: E402

SOURCES = ROOT / "docs" / "verbs"
OVERVIEW = (ROOT / "docs" / "reference" / "command-line.md").read_text(encoding="utf-8")
INDEX = (ROOT / "docs" / "index.md").read_text(encoding="utf-8")


def test_every_page_belongs_to_a_verb():
    assert {path.stem for path in SOURCES.glob("*.md")} == set(VERBS)


@pytest.mark.parametrize("name", VERBS)
def test_the_overview_and_the_index_lead_to_every_page(name):
    assert f"[`{name}`](../generated/verbs/{name}.md)" in OVERVIEW
    assert f"\ngenerated/verbs/{name}\n" in INDEX


@pytest.mark.parametrize("name", VERBS)
def test_a_page_has_every_option_and_argument(name):
    text = "\n".join(reference(name))
    verb = command.get_command(click.Context(command), name)
    assert verb is not None
    context = click.Context(verb, info_name=name)
    words = [word for option in verb.params if isinstance(option, click.Option) for word in option.opts]
    shown = [one.make_metavar(context) for one in verb.params if isinstance(one, click.Argument)]
    arguments = " ".join(shown).split()
    assert not [word for word in words if not re.search(rf"^\| `(?:-\w, )?{word}[` ,]", text, flags=re.MULTILINE)]
    assert not [word for word in arguments if "| `" + word.replace("|", r"\|") + "` |" not in text]

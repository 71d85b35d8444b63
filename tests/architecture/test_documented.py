"""What is not documented fails."""

from __future__ import annotations

import re

import click
import pytest
from architecture.source import ROOT

from dashpot.cli.shell import VERBS
from dashpot.cli.shell import dashpot as command
from dashpot.contract.loading import KINDS

README = (ROOT / "README.md").read_text(encoding="utf-8")
COMMANDS = re.findall(r"^dashpot (.+)$", README, flags=re.MULTILINE)


def verb(name: str) -> click.Command:
    """The command behind a verb."""
    found = command.get_command(click.Context(command), name)
    assert found is not None
    return found


@pytest.mark.parametrize("name", VERBS)
def test_the_readme_shows_every_verb(name):
    assert any(line.split()[0] == name for line in COMMANDS)


@pytest.mark.parametrize("line", COMMANDS)
def test_the_readme_uses_only_what_the_command_knows(line):
    name, *arguments = line.split()
    verb(name).make_context(name, arguments)


@pytest.mark.parametrize("name", VERBS)
def test_every_option_says_what_it_does(name):
    options = [parameter for parameter in verb(name).params if isinstance(parameter, click.Option)]
    assert options and all(option.help for option in options)


@pytest.mark.parametrize("switch", ["--seed", "--jobs", "--json", "--quiet", "--force", "--optimizer", "--set"])
def test_the_readme_explains_every_common_switch(switch):
    assert f"`{switch}" in README


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_every_hook_is_explained_to_plugin_authors(kind):
    assert f"`{kind.hook}`" in (ROOT / "framework" / "README.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("variable", ["DASHPOT_PLUGINS", "DASHPOT_DEBUG"])
def test_every_environment_variable_is_documented(variable):
    assert variable in README

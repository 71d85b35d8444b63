"""What the written pages tell to type and to write is what dashpot takes."""

from __future__ import annotations

import re
from pathlib import Path

import click
import pytest
from architecture.source import MANUAL, ROOT

import dashpot as dp
from dashpot.cli.shell import dashpot as command

PAGES = [
    path
    for path in sorted((ROOT / "docs").rglob("*.md"))
    if not {"generated", "_build"} & set(path.relative_to(ROOT).parts)
]


def blocks(page: Path, language: str, start: str = "") -> list[str]:
    """The code blocks of a language that begin with ``start``."""
    text = page.read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n({re.escape(start)}.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)


def typed(page: Path) -> list[str]:
    """The commands of a page."""
    return [line for block in blocks(page, "sh") for line in block.splitlines() if line.startswith("dashpot ")]


COMMANDS = [line for page in PAGES for line in typed(page)]
# those of the reference name files beside them, and one is wrong on purpose: the journeys check them
NETWORKS = [text for page in PAGES if page not in MANUAL for text in blocks(page, "yaml", "format: dashpot-network/1")]


def test_there_is_something_to_test():
    assert len(PAGES) >= 10 and len(COMMANDS) >= 7 and NETWORKS


@pytest.mark.parametrize("line", [line for line in COMMANDS if line != "dashpot --version"])
def test_every_command_is_known(line):
    _, name, *arguments = line.split()
    verb = command.get_command(click.Context(command), name)
    assert verb is not None
    verb.make_context(name, arguments)


def test_the_tutorial_types_what_the_tour_of_the_readme_runs():
    tour = typed(ROOT / "README.md")
    lines = [line for line in typed(ROOT / "docs" / "tutorial.md") if line != "dashpot --version"]
    assert lines and not [line for line in lines if line not in tour]


@pytest.mark.parametrize("text", NETWORKS)
def test_every_network_is_good(text):
    assert dp.declare(text).weaknesses() == []


def test_every_quoted_file_is_one_that_the_tests_use():
    quoted = [(page, file) for page in PAGES for file in re.findall(r"literalinclude\} (\S+)", page.read_text())]
    example = ROOT / "tests" / "example_plugin"
    assert len(quoted) >= 4
    assert all((page.parent / file).resolve().is_relative_to(example) for page, file in quoted)

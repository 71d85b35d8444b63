"""What is not documented fails."""

from __future__ import annotations

import re

import click
import pytest
from architecture.source import FRAMEWORK, MANUAL, PLUGINS, ROOT, manual, modules, texts
from architecture.test_layers import LAYERS
from architecture.written import PAGES, renewed, things
from architecture.written import modules as module_index

import dashpot as dp
from dashpot.cli.list import KINDS as LISTS
from dashpot.cli.outcome import ExitCode
from dashpot.cli.shell import VERBS
from dashpot.cli.shell import dashpot as command
from dashpot.contract.loading import KINDS
from dashpot.data.channel import Channel
from dashpot.data.declaration import ACCEPTABLE, RunDeclaration
from dashpot.data.run import KINDS as RUNS
from dashpot.report.headline import SENTENCES
from dashpot.report.schematic.svg import svg

README = (ROOT / "README.md").read_text(encoding="utf-8")
TOLD = manual()
INSIDE = (ROOT / "framework" / "README.md").read_text(encoding="utf-8")
HOW = (ROOT / "docs" / "explanation" / "inside.md").read_text(encoding="utf-8")
COMMANDS = re.findall(r"^(?:\$ )?dashpot (.+)$", TOLD, flags=re.MULTILINE)
VARIABLES = {
    found
    for folder in (FRAMEWORK, PLUGINS)
    for path in modules(folder)
    for text, _ in texts(path)
    for found in re.findall(r"\bDASHPOT_[A-Z]+\b", text)
}


def verb(name: str) -> click.Command:
    """The command behind a verb."""
    found = command.get_command(click.Context(command), name)
    assert found is not None
    return found


def options(name: str) -> list[click.Option]:
    """What a verb can be told."""
    return [parameter for parameter in verb(name).params if isinstance(parameter, click.Option)]


def mentioned(word: str, page: str = TOLD) -> bool:
    """Whether a word stands in a page as code, alone or with something behind it."""
    return re.search(rf"`{re.escape(word)}[` =]", page) is not None


# --- commands ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", VERBS)
def test_the_manual_shows_every_verb(name):
    assert any(line.split()[0] == name for line in COMMANDS)
    assert mentioned(name)


@pytest.mark.parametrize("line", COMMANDS)
def test_the_manual_uses_only_what_the_command_knows(line):
    name, *arguments = line.split()
    verb(name).make_context(name, arguments)


@pytest.mark.parametrize("name", VERBS)
def test_every_option_says_what_it_does(name):
    assert not [option.opts for option in options(name) if not option.help]


@pytest.mark.parametrize("kind", LISTS)
def test_the_manual_names_everything_that_can_be_listed(kind):
    assert mentioned(kind)


def test_the_manual_tells_every_exit_code():
    [sentence] = re.findall(r"^Exit codes: (.+?\.)$", TOLD, flags=re.MULTILINE)
    assert {int(number) for number in re.findall(r"\d+", sentence)} == {int(code) for code in ExitCode}


@pytest.mark.parametrize("variable", sorted(VARIABLES))
def test_every_environment_variable_is_documented(variable):
    assert f"| `{variable}` |" in TOLD


def test_the_readme_is_short_and_leads_to_the_whole_manual():
    assert README.count("\n") <= 250
    assert all(page.relative_to(ROOT).as_posix() in README for page in MANUAL[1:])


def test_the_picture_of_the_readme_is_that_of_its_network():
    [text] = re.findall(r"```yaml\n(format: dashpot-network/1\n.*?)```", README, flags=re.DOTALL)
    [picture] = re.findall(r"\]\((docs/_static/\w+\.svg)\)", README)
    assert (ROOT / picture).read_text(encoding="utf-8") == svg(dp.declare(text))


# --- files ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("word", RUNS)
def test_every_kind_of_run_is_explained(word):
    assert mentioned(word)


# what is read out of other keys, or counted
NO_KEYS = {"time", "notes", "units", "order", "places"}


@pytest.mark.parametrize("key", sorted(set(RunDeclaration.__dataclass_fields__) - NO_KEYS))
def test_every_key_of_a_run_is_explained(key):
    assert re.search(rf"^\| [^|]*`{key}`", TOLD, flags=re.MULTILINE)


def test_every_key_of_a_channel_is_explained():
    [keys] = re.findall(r"`\{(column, .+?)\}` with value", TOLD)
    assert set(keys.split(", ")) == set(Channel.__dataclass_fields__) - {"name", "place"}


@pytest.mark.parametrize("word", ACCEPTABLE)
def test_everything_that_can_be_accepted_is_explained(word):
    assert f"`[{word}]`" in TOLD


@pytest.mark.parametrize("verdict", SENTENCES)
def test_every_verdict_is_explained(verdict):
    assert f"| `{verdict}` |" in TOLD


# --- plugins and modules -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_every_hook_is_explained_to_plugin_authors(kind):
    assert f"| `{kind.hook}` |" in INSIDE


def test_the_page_of_the_framework_shows_the_order_of_imports():
    assert INSIDE.count("\n") <= 110
    [order] = re.findall(r"^    (text, expr <- .+)$", INSIDE, flags=re.MULTILINE)
    assert [set(names.split(", ")) for names in order.split(" <- ")] == list(LAYERS)


def test_the_flow_and_its_page_name_every_package():
    [flow] = re.findall(r"```text\n(.+?)```", INSIDE, flags=re.DOTALL)
    missing = [name for layer in LAYERS for name in layer if not re.search(rf"\b{name}\b", flow)]
    assert missing == ["contract"]  # the door of the plugins takes no part in the flow


@pytest.mark.parametrize("page", [INSIDE, HOW], ids=["framework/README.md", "inside.md"])
def test_modules_that_a_page_sends_to_are_there(page):
    packages = "|".join(sorted(name for layer in LAYERS for name in layer))
    named = set(re.findall(rf"`((?:{packages})/[\w/]+)`", page))
    assert len(named) > 5
    assert not [name for name in named if not any((FRAMEWORK / name).with_suffix(end).exists() for end in ("", ".py"))]


def test_the_index_lists_every_module_with_its_first_sentence():
    index = "\n".join(module_index())
    found = [path.relative_to(FRAMEWORK) for path in modules(FRAMEWORK) if path.parent != FRAMEWORK]
    names = [path.with_suffix("").as_posix().partition("/") for path in found if path.name != "__init__.py"]
    sections = dict(re.findall(r"### `(\w+)/`\n(.+?)(?=\n### |\Z)", index, flags=re.DOTALL))
    lines = {layer: re.findall(r"^- `(.+?)` \S", text, flags=re.MULTILINE) for layer, text in sections.items()}
    listed = {f"{layer}/{name}" for layer, names_of_layer in lines.items() for name in names_of_layer}
    assert listed == {"".join(name) for name in names}


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_everything_built_in_has_a_section(kind):
    page = (PLUGINS / "README.md").read_text(encoding="utf-8")
    sections = re.findall(r"^### `(\w+)`$", page, flags=re.MULTILINE)
    assert set(things(kind.name)) <= set(sections)


@pytest.mark.parametrize("word", sorted(things("causes")))
def test_the_manual_names_every_cause(word):
    assert mentioned(word)


@pytest.mark.parametrize("page", PAGES)
def test_what_is_written_from_the_code_is_up_to_date(page):
    # otherwise: python tests/architecture/written.py
    assert renewed(page) == (ROOT / page).read_text(encoding="utf-8")


def test_every_folder_of_the_tests_is_explained():
    page = (ROOT / "tests" / "README.md").read_text(encoding="utf-8")
    folders = {path.name for path in (ROOT / "tests").iterdir() if path.is_dir() and path.name[0] not in "._"}
    assert not [name for name in sorted(folders) if f"`{name}/`" not in page]


# --- links ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "page", sorted(ROOT.glob("*.md")) + sorted(ROOT.glob("*/README.md")), ids=lambda page: str(page)
)
def test_every_link_leads_somewhere(page):
    text = page.read_text(encoding="utf-8")
    targets = [link for link in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in link]
    assert not [link for link in targets if not _exists(page, link)]


def _exists(page, link: str) -> bool:
    file, _, heading = link.partition("#")
    target = page.parent / file if file else page
    if not heading:
        return target.exists()
    headings = re.findall(r"^#+ (.+)$", target.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return heading in {re.sub(r"[^\w\- ]", "", title).strip().lower().replace(" ", "-") for title in headings}

"""A page for each verb of the command: its help and its options from click, its example with what it prints."""

from __future__ import annotations

import contextlib
import inspect
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path

import click
from architecture import written
from click.testing import CliRunner

from building.parts import folded, put
from dashpot.cli import main
from dashpot.cli.shell import VERBS
from dashpot.cli.shell import dashpot as command

FILES = Path(__file__).resolve().parents[1] / "verbs" / "files"
SHOWN_LINES = 40
SETTINGS = {"COLUMNS": "100", "NO_COLOR": "1"}
TELLS_ITS_MEMORY = ("campaign",)  # that of the process in which it runs
MEASURED: Mapping[str, str] = {
    "mount": "dashpot simulate specimen.yaml --rig bench.yaml --seed 1 -o mount",
    "mount_2": "dashpot simulate specimen.yaml --rig bench.yaml --seed 2 -o mount_2",
}
ARGUMENTS: Mapping[str, str] = {
    "MODEL": "a network file, or the name of a shipped network",
    "DATASET": "a `dataset.yaml`, or its folder",
    "MODEL|DATASET": "a network file, the name of a shipped network, a `dataset.yaml` or its folder",
    "FILE": "a measured file, or a folder of them",
    "KIND": "the kind, one of those above",
    "STUDY": "a study file, or the name of a shipped study",
    "JOINT": "a joint file",
    "CAMPAIGN": "a campaign file",
}


def write_verbs(sources: Path, folder: Path) -> None:
    """Write the page of every verb; each example runs in a folder of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as place:
        bench = prepared(Path(place) / "bench")
        for name in VERBS:
            source = (sources / f"{name}.md").read_text(encoding="utf-8")
            work = shutil.copytree(bench, Path(place) / name)
            put(folder / f"{name}.md", "\n\n".join(page(name, source, work)) + "\n")


def prepared(folder: Path) -> Path:
    """The folder in which examples run: the files, and two virtual measurements."""
    shutil.copytree(FILES, folder)
    for line in MEASURED.values():
        run(line, folder)
    return folder


def page(name: str, source: str, folder: Path) -> Iterator[str]:
    """The page of a verb."""
    yield f"# `dashpot {name}`"
    yield from reference(name)
    yield filled(source, folder).replace("](../", "](../../").strip()
    yield from needed(commands(source))


def reference(name: str) -> Iterator[str]:
    """What a verb is for, how it is called, its arguments and options, as click knows them."""
    context = click.Context(command, info_name="dashpot")
    verb = command.get_command(context, name)
    assert verb is not None
    inner = click.Context(verb, info_name=name, parent=context)
    yield from told(_without_example(inspect.cleandoc(verb.help or "")))
    yield "## Usage"
    yield f"```text\n{' '.join(verb.get_usage(inner).split()).removeprefix('Usage: ')}\n```"
    yield from _arguments(verb, inner)
    yield from _options(verb, inner)


def filled(source: str, folder: Path) -> str:
    """The text of a page with the output of its commands below each of them."""
    return re.sub(r"^\$ (.+)$", lambda found: f"{found[0]}\n{shown(run(found[1], folder))}", source, flags=re.MULTILINE)


def commands(source: str) -> list[str]:
    """The commands of a page that are executed."""
    return re.findall(r"^\$ (.+)$", source, flags=re.MULTILINE)


def run(line: str, folder: Path) -> str:
    """What a command prints on standard output; a fault of it goes through with its messages."""
    words = line.split()[1:]
    code, printed, told_besides = (_alone if words[0] in TELLS_ITS_MEMORY else _here)(words, folder)
    if code:
        raise RuntimeError(f"{line}: exit code {code}\n{printed}{told_besides}")
    return printed


def _here(words: list[str], folder: Path) -> tuple[int, str, str]:
    """The exit code of a command in this process, and what it prints on standard output and standard error."""
    with CliRunner().isolation(env=SETTINGS) as (printed, told_besides, _), contextlib.chdir(folder):
        code = main(words)
    return code, printed.getvalue().decode(), told_besides.getvalue().decode()


def _alone(words: list[str], folder: Path) -> tuple[int, str, str]:
    """The same of a command in a process of its own."""
    command = [sys.executable, "-m", "dashpot", *words]
    settings = {**os.environ, **SETTINGS, "PYTHONIOENCODING": "utf-8"}
    done = subprocess.run(command, cwd=folder, env=settings, capture_output=True, text=True, encoding="utf-8")
    return done.returncode, done.stdout, done.stderr


def shown(text: str) -> str:
    """The first lines of an output."""
    lines = [line.rstrip() for line in text.strip("\n").splitlines()]
    return "\n".join([*lines[:SHOWN_LINES], *(["..."] if len(lines) > SHOWN_LINES else [])])


def needed(lines: list[str]) -> Iterator[str]:
    """The files that the commands of an example read, and where its measurements come from."""
    files = _files(" ".join(lines))
    words = set(re.findall(r"\w+(?![\w.])", " ".join([*lines, *files.values()])))
    measured = [line for name, line in MEASURED.items() if name in words]
    if files or measured:
        yield "## Files of the example"
    if measured:
        files = {**_files(" ".join(measured)), **files}
        yield "The data are virtual measurements:"
        yield "```sh\n" + "\n".join(measured) + "\n```"
    for name, text in files.items():
        yield from folded(name, Path(name).suffix.removeprefix(".").replace("csv", "text"), text.rstrip())


def _files(text: str) -> dict[str, str]:
    """The shipped files that a text names, and those that these name."""
    found: dict[str, str] = {}
    waiting = [text]
    while waiting:
        looked_at = waiting.pop()
        for path in sorted(FILES.iterdir()):
            if path.name not in found and re.search(rf"(?<![\w/]){re.escape(path.name)}\b", looked_at):
                found[path.name] = path.read_text(encoding="utf-8")
                waiting.append(found[path.name])
    return found


def told(words: str) -> Iterator[str]:
    """The help of a verb: what click is told to leave as it is stands as code."""
    for paragraph in words.split("\n\n"):
        title, mark, block = paragraph.partition("\b\n")
        if not mark:
            yield title
            continue
        head, _, rest = block.partition("\n")
        if rest and not head.startswith(" ") and head.endswith(":"):
            yield head
            block = rest
        yield f"```sh\n{inspect.cleandoc(block)}\n```"


def _arguments(verb: click.Command, context: click.Context) -> Iterator[str]:
    shown = [one.make_metavar(context) for one in verb.params if isinstance(one, click.Argument)]
    rows = [(f"`{word}`", _meaning(word)) for word in " ".join(shown).split()]
    if rows:
        yield written.table(("argument", "meaning"), rows)


def _meaning(word: str) -> str:
    """What stands for an argument, and how many of it."""
    optional, several = word.startswith("["), word.endswith("...")
    number = {(True, True): "; any number", (False, True): "; one or more", (True, False): "; optional"}
    return _kind(word.strip("[].")) + number.get((optional, several), "")


def _kind(word: str) -> str:
    choices = word.strip("{}").split("|")
    return f"one of {', '.join(f'`{choice}`' for choice in choices)}" if word.startswith("{") else ARGUMENTS[word]


def _options(verb: click.Command, context: click.Context) -> Iterator[str]:
    records = [option.get_help_record(context) for option in verb.params if isinstance(option, click.Option)]
    rows = [(f"`{record[0]}`", record[1]) for record in records if record]
    if rows:
        yield written.table(("option", "meaning"), rows)


def _without_example(words: str) -> str:
    """The help without its own example, since the page has one that runs."""
    return "\n\n".join(part for part in words.split("\n\n") if not part.startswith("\b\nExample"))

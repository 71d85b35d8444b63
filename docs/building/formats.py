"""A page for each file format: what its reader declares, and a file that is written, imported and shown."""

from __future__ import annotations

import contextlib
import re
import tempfile
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from architecture import written

from building.parts import put
from building.verbs import filled

BLOCK = re.compile(r"^```(python|console|text|yaml)\n(.*?)^```\n", flags=re.MULTILINE | re.DOTALL)
NEEDED = re.compile(r"^(?:import|from) (\w+)", flags=re.MULTILINE)
RATE = 200.0  # Hz


def write_formats(sources: Path, folder: Path) -> None:
    """Write the page of every format; each example runs in a folder of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    for word, made in written.things("formats").items():
        source = (sources / f"{word}.md").read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as place:
            put(folder / f"{word}.md", "\n\n".join(page(word, made, source, Path(place))) + "\n")


def page(word: str, made: type[Any], source: str, folder: Path) -> Iterator[str]:
    """The page of a format."""
    yield f"# `{word}`"
    yield from written.format_of_files(word, made)
    yield played(source, folder).replace("](../", "](../../").strip()


def overview() -> Iterator[str]:
    """All formats in a table, each with its endings and its extra."""
    rows = [
        (
            f"[`{word}`](formats/{word}.md)",
            ", ".join(f"`{suffix}`" for suffix in made.suffixes) or f"`reader: {word}`",
            f"`dashpot[{made.extra}]`" if made.extra else "",
            written.one_line(made).removeprefix("Reads ").rstrip("."),
        )
        for word, made in written.things("formats").items()
    ]
    yield written.table(("format", "files", "needs", "what is read"), rows)
    names = "\n".join(f"formats/{word}" for word in written.things("formats"))
    yield f"```{{toctree}}\n:hidden:\n\n{names}\n```"


def played(source: str, folder: Path) -> str:
    """The text with its Python executed in ``folder``, its commands answered and its files shown.

    A block that begins with ``<<< FILE`` shows a file, with a number its first lines. Where a library that the example
    imports is missing, commands and files are left unanswered.
    """
    missing = [name for name in NEEDED.findall(source) if find_spec(name) is None]
    names = example_signals()

    def play(found: re.Match[str]) -> str:
        language, body = found[1], found[2]
        if missing:
            return "" if body.startswith("<<< ") else found[0]
        if language == "python":
            with contextlib.chdir(folder):
                exec(compile(body, "example", "exec"), names)
        if language == "console":
            body = filled(body, folder).rstrip() + "\n"
        if body.startswith("<<< "):
            file, *lines = body.removeprefix("<<< ").split()
            text = (folder / file).read_text(encoding="utf-8").splitlines()
            shown = text[: int(lines[0])] if lines else text
            body = "\n".join([*shown, *(["..."] if len(shown) < len(text) else [])]) + "\n"
        return f"```{language}\n{body}```\n"

    text = BLOCK.sub(play, source)
    note = f"The answers are left out: {', '.join(missing)} was not installed where this page was built."
    return f"{text}\n{note}" if missing else text


def example_signals() -> dict[str, Any]:
    """Three sines around a preload: ``time`` (n,) in s, ``displacement`` (n,) in mm and ``force`` (n,) in N."""
    time = np.arange(0.0, 6.0, 1.0 / RATE)
    phase = 2.0 * np.pi * np.array([1.0, 2.0, 4.0])[(time // 2.0).astype(int)] * time
    displacement = 5.0 + 1.5 * np.sin(phase)
    force = 60.0 * displacement + 12.0 * np.cos(phase)
    return {
        "np": np,
        "time": time,
        "displacement": displacement.round(4),
        "force": force.round(3),
        "__name__": "example",
    }

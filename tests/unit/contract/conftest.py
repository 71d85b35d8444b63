"""Plugins written into a folder and installed there, as a package installer would."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from importlib.metadata import EntryPoint, distributions
from pathlib import Path
from textwrap import dedent

import pytest

Install = Callable[..., list[EntryPoint]]


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Install]:
    """``install(name, source)`` installs a one-module distribution and gives the entry points of all so far."""
    monkeypatch.syspath_prepend(str(tmp_path))
    modules: list[str] = []

    def write(name: str, source: str | None, distribution: str = "") -> list[EntryPoint]:
        modules.append(name)
        if source is not None:
            (tmp_path / f"{name}.py").write_text(dedent(source), encoding="utf-8")
        distribution = distribution or f"dist_of_{name}"
        info = tmp_path / f"{distribution}-1.5.dist-info"
        info.mkdir(exist_ok=True)
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {distribution}\nVersion: 1.5\n", encoding="utf-8")
        with (info / "entry_points.txt").open("a", encoding="utf-8") as file:
            file.write(f"[dashpot]\n{name} = {name}\n" if not file.tell() else f"{name} = {name}\n")
        return [entry for found in distributions(path=[str(tmp_path)]) for entry in found.entry_points]

    yield write
    for module in modules:
        sys.modules.pop(module, None)

"""Every command that a page tells to type runs, on small data; the README and the reference have their journey."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from architecture.source import ROOT

import dashpot as dp
from dashpot.cli import main
from dashpot.fit.study.reading import shipped_studies

DOCS = ROOT / "docs"
PAGES = [*sorted((DOCS / "how-to").glob("*.md")), *sorted((DOCS / "verbs").glob("*.md"))]
TAKES_MINUTES = "dashpot study hydro_mount -o mounts"
TWO_BRANCHES = """\
format: dashpot-network/1
name: small
branches:
  rubber: {element: spring, stiffness: 200 N/mm}
  damping: {element: damper, damping: 0.6 N*s/mm}
"""
ELSEWHERE = "tcp://10.0.0.1:8786"  # somebody's cluster


def text_of(page: Path, language: str) -> list[str]:
    """The code blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def commands(page: Path) -> list[str]:
    """What a page tells to type; test_verbs runs the ``console`` blocks, whose output is shown."""
    lines = [line for block in text_of(page, "sh") for line in block.splitlines() if line.startswith("dashpot ")]
    return [line for line in lines if line != TAKES_MINUTES and ELSEWHERE not in line]


class Small(dp.Specimen):
    """A demonstration of seconds: a spring and a damper on the bench of the documentation."""

    word, about, demo = "small", "a spring and a damper", True
    networks, suspect = ("spring", "kelvin_voigt"), "spring"

    def measure(self, folder: Path, seed: int) -> Path:
        model = dp.declare(TWO_BRANCHES)
        data = dp.measure(model, "bench.yaml", seed=seed)
        return dp.write_dataset(data, folder)


def supplier(folder: Path) -> None:
    """The table of a supplier that the page about tables describes."""
    shutil.rmtree(folder / "mount")
    (folder / "mount").mkdir()
    [text] = text_of(DOCS / "how-to" / "stiffness-tables.md", "yaml")
    (folder / "mount" / "dataset.yaml").write_text(text, encoding="utf-8")
    rows = [f"{f},{amplitude},{220 + 4 * f},{5 + 0.3 * f},23" for f in (2, 8, 20) for amplitude in (0.2, 1.0)]
    (folder / "mount" / "mount.csv").write_text("f,A,Kdyn,delta,T\n" + "\n".join(rows) + "\n", encoding="utf-8")


def named(folder: Path) -> None:
    """The files of one's own that the page about other programs names."""
    for name in ("my_mount", "identified"):
        shutil.copy(folder / "specimen.yaml", folder / f"{name}.yaml")
    shutil.copytree(folder / "mount", folder / "my")


def one_specimen(folder: Path) -> None:
    """A campaign of one specimen."""
    (folder / "specimens.csv").write_text("specimen,data,batch\nm01,mount,A\n", encoding="utf-8")


def with_fewer_cars(folder: Path) -> Path:
    """The shipped study of inspection tests with 5 in place of 200 cars at each place: one run is like another."""
    text, fewer = shipped_studies()["inspection"].read_text(encoding="utf-8"), folder / "fewer_cars.yaml"
    assert text.endswith("\ndraws: 200\n")
    fewer.write_text(text.replace("\ndraws: 200\n", "\ndraws: 5\n"), encoding="utf-8")
    return fewer


BEFORE: dict[str, Callable[[Path], None]] = {
    "stiffness-tables": supplier,
    "use-elsewhere": named,
    "campaign": one_specimen,
}


@pytest.mark.parametrize(
    "page", [page for page in PAGES if commands(page)], ids=lambda page: f"{page.parent.name}-{page.stem}"
)
def test_the_commands_of_a_page_run(page, bench, tmp_path, monkeypatch, capfd):
    folder = shutil.copytree(bench, tmp_path / "bench")
    monkeypatch.chdir(folder)
    monkeypatch.setattr("dashpot.cli.demo.choose_specimen", lambda word, registry: Small)
    studies = {**shipped_studies(), "inspection": with_fewer_cars(folder)}
    monkeypatch.setattr("dashpot.fit.study.reading.shipped_studies", lambda: studies)
    BEFORE.get(page.stem, lambda _: None)(folder)
    for line in commands(page):
        # how many processes is the reader's affair: one is enough to see that it runs
        words = line.replace("local:8", "local:1").split()[1:]
        assert main([*words, *(["--force"] if "-o" in words else [])]) == 0, f"{line}\n{capfd.readouterr().err}"


@pytest.mark.slow
def test_the_study_of_hydraulic_mounts_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert TAKES_MINUTES in text_of(DOCS / "how-to" / "hydraulic-mount.md", "sh")[0]
    assert main(TAKES_MINUTES.split()[1:]) == 0

"""What the README shows works as it stands there."""

from __future__ import annotations

import re

import pytest

from dashpot import load_registry

from .conftest import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str, start: str = "") -> list[str]:
    """The code blocks of a language that begin with ``start``."""
    return re.findall(rf"^```{language}\n({re.escape(start)}.*?)^```$", README, flags=re.MULTILINE | re.DOTALL)


@pytest.mark.slow
def test_the_tour_runs_from_its_first_line_to_its_last(installation, tmp_path):
    [tour] = blocks("sh", "dashpot ")
    for line in tour.splitlines():
        done = installation.run(tmp_path, *line.split(), DASHPOT_DEBUG="1")
        assert done.returncode == 0, f"{line}\n{done.stderr}"
    for report in ("comparison/report.html", "diagnosis/report.html"):
        assert (tmp_path / report).is_file()


def test_the_network_is_good():
    from dashpot.model.reading import parse_network

    [text] = blocks("yaml", "format: dashpot-network/1")
    network = parse_network(text, load_registry().elements)
    assert [branch.name for branch in network.leaves()] == ["rubber", "relaxation", "friction"]


def test_the_dataset_is_read_without_complaint(tmp_path):
    from dashpot import read_dataset

    [text] = blocks("yaml", "format: dashpot-dataset/1")
    (tmp_path / "dataset.yaml").write_text(text, encoding="utf-8")
    for name in ("slow", "a1", "a1_b"):
        rows = [f"{i / 1000!r},{i % 100 / 50!r},{i % 97!r}" for i in range(2000)]
        (tmp_path / f"{name}.csv").write_text("\n".join(["t,x,F", *rows]) + "\n", encoding="utf-8")
    readers = {word: reader() for word, reader in load_registry().formats.items()}
    dataset = read_dataset(tmp_path / "dataset.yaml", readers)
    assert [run.name for run in dataset.runs] == ["slow", "a1", "a1_b"]
    assert dataset.problems == ()

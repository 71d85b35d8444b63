"""The folder in which the examples of the documentation run: a small measurement, and a model of it."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from architecture.source import ROOT

import dashpot as dp


@pytest.fixture(scope="session")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The files of the pages of verbs with the dataset ``mount/``, and three specimens of it for the campaign."""
    folder = shutil.copytree(ROOT / "docs" / "verbs" / "files", tmp_path_factory.mktemp("bench") / "files")
    (folder / "specimens.csv").write_text("specimen,data,batch\nm01,mount,A\nm02,mount,A\nm03,mount,B\n")
    data = dp.measure(dp.load(folder / "specimen.yaml"), str(folder / "bench.yaml"), seed=3)
    dp.write_dataset(data, folder / "mount")
    return folder

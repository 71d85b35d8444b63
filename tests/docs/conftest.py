"""The folder in which the examples of the documentation run: a small measurement, and a model of it."""

from __future__ import annotations

from pathlib import Path

import pytest

import dashpot as dp

MODEL = """\
format: dashpot-network/1
name: mount
branches:
  rubber: {element: spring, stiffness: {start: 150 N/mm}}
  damping: {element: damper, damping: {start: 0.5 N*s/mm}}
"""
SPECIMEN = """\
format: dashpot-network/1
name: specimen
branches:
  rubber: {element: spring, stiffness: 200 N/mm}
  damping: {element: damper, damping: 0.4 N*s/mm}
  relaxation: {element: maxwell, stiffness: 60 N/mm, relaxation_time: 20 ms}
"""
BENCH = """\
format: dashpot-rig/1
name: small bench
tests:
  - {rig: hydropulser, amplitudes: [0.5 mm, 1 mm], preloads: [2 mm, 4 mm], direction: up, duration: 3 s,
     sampling: 500 Hz}
measuring: {force_noise: 4 N, repeats: 2}
"""
STUDY = """\
format: dashpot-study/1
name: ladder
data: mount
stages:
  - {name: all, free: "*", budget: 200}
models:
  - mount.yaml
"""


CAMPAIGN = """\
format: dashpot-campaign/1
name: mounts
specimens: specimens.csv
models: [mount.yaml]
"""


@pytest.fixture(scope="session")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the dataset ``mount/``, the model ``mount.yaml`` that lacks relaxation, a study and a campaign."""
    folder = tmp_path_factory.mktemp("bench")
    (folder / "mount.yaml").write_text(MODEL)
    (folder / "ladder.yaml").write_text(STUDY)
    (folder / "bench.yaml").write_text(BENCH)
    (folder / "mounts.yaml").write_text(CAMPAIGN)
    (folder / "specimens.csv").write_text("specimen,data,batch\nm01,mount,A\nm02,mount,A\nm03,mount,B\n")
    data = dp.measure(dp.declare(SPECIMEN), str(folder / "bench.yaml"), seed=3)
    dp.write_dataset(data, folder / "mount")
    return folder

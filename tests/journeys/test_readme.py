"""What the README and the pages of reference show works as it stands there."""

from __future__ import annotations

import json
import os
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from architecture.source import MANUAL
from seeds import seed_of

from dashpot import load_registry
from dashpot.cli import main
from dashpot.data.dataset import read_dataset

from .conftest import ROOT, Installation, install

README, NETWORKS, DATASETS, *_ = MANUAL
PLUGIN = ROOT / "docs" / "how-to" / "own-plugin.md"
TAKES_MINUTES = ("demo", "diagnose", "study")
OWN_FILES = ("campaign", "joint")


def blocks(language: str, start: str = "", pages: tuple[Path, ...] = MANUAL) -> list[str]:
    """The code blocks of a language that begin with ``start``."""
    text = "\n".join(page.read_text(encoding="utf-8") for page in pages)
    return re.findall(rf"^```{language}\n({re.escape(start)}.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)


def tour() -> list[list[str]]:
    """The commands of the README and of the reference in order, without those that need files of one's own."""
    lines = [line.split() for block in blocks("sh", "dashpot ") for line in block.splitlines()]
    return [line for line in lines if line[1] not in OWN_FILES]


def named(text: str) -> str:
    """The name that a network gives itself."""
    return re.search(r"^name: (.+)$", text, flags=re.MULTILINE)[1]


@pytest.fixture
def seed() -> int:
    """Drawn anew for every test; README_SEED repeats it."""
    value = int(os.environ.get("README_SEED") or seed_of("test_readme"))
    print(f"seed {value}: README_SEED={value} repeats it")
    return value


# --- the tour ------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_tour_runs_from_its_first_line_to_its_last(installation, tmp_path):
    walk(tour(), installation, tmp_path)
    for report in ("comparison/report.html", "diagnosis/report.html"):
        assert (tmp_path / report).is_file()


def test_the_short_commands_of_the_tour_run(tmp_path, monkeypatch, capfd):
    # the files of the demonstration with shorter runs: how good a fit is, is the affair of other tests
    monkeypatch.setattr("dashpot_specimens.test_tire.SWEEP_DURATION", 3.0)
    monkeypatch.setattr("dashpot_specimens.test_tire.LOOP_DURATION", 12.0)
    load_registry().specimens["test_tire"]().measure(tmp_path / "dashpot-demo" / "data" / "test_tire-0", 0)
    monkeypatch.chdir(tmp_path)
    for line in tour():
        if line[1] not in TAKES_MINUTES:
            assert line[0] == "dashpot" and main(line[1:]) == 0, f"{' '.join(line)}\n{capfd.readouterr().err}"
    assert (tmp_path / "comparison" / "report.html").is_file()


def walk(lines: list[list[str]], installation: Installation, folder: Path) -> None:
    """Run commands as a user does, in one folder."""
    for line in lines:
        done = installation.run(folder, *line, DASHPOT_DEBUG="1")
        assert done.returncode == 0, f"{' '.join(line)}\n{done.stderr}"


# --- network files -------------------------------------------------------------------------------------------------


def test_every_network_is_good(tmp_path, monkeypatch, capsys):
    names = [name for name in write_networks(tmp_path) if name != "wrong"]
    monkeypatch.chdir(tmp_path)
    assert names
    assert main(["check", *(f"{name}.yaml" for name in names)]) == 0, capsys.readouterr().err


def test_the_mistakes_are_told_as_shown(tmp_path, monkeypatch, capsys):
    write_networks(tmp_path)
    monkeypatch.chdir(tmp_path)
    [shown] = blocks("text", "wrong.yaml", (NETWORKS,))
    assert main(["check", "wrong.yaml"]) == 1
    assert capsys.readouterr().err == shown


def write_networks(folder: Path) -> list[str]:
    """Write the networks of the README and of the reference under their names."""
    texts = {named(text): text for text in blocks("yaml", "format: dashpot-network/1")}
    for name, text in texts.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    return list(texts)


# --- datasets ------------------------------------------------------------------------------------------------------


def readers() -> dict:
    """The installed readers."""
    return {word: reader() for word, reader in load_registry().formats.items()}


def write_table(
    path: Path, head: list[str], columns: list[np.ndarray], delimiter: str = ",", decimal: str = "."
) -> None:
    """Write a text table."""
    rows = [delimiter.join(f"{value:.5f}".replace(".", decimal) for value in row) for row in zip(*columns, strict=True)]
    path.write_text("\n".join([*head, *rows]) + "\n", encoding="utf-8")


def test_the_dataset_is_read_without_complaint(tmp_path):
    [text] = blocks("yaml", "format: dashpot-dataset/1", (README,))
    (tmp_path / "dataset.yaml").write_text(text, encoding="utf-8")
    time = np.arange(2000) / 1000.0
    for name in ("slow", "a1", "a1_b"):
        write_table(tmp_path / f"{name}.csv", ["t,x,F"], [time, np.sin(9.0 * time), np.sin(9.0 * time + 0.1)])
    dataset = read_dataset(tmp_path, readers())
    assert [(run.name, run.group) for run in dataset.runs] == [("slow", "slow"), ("a1", "a1"), ("a1_b", "a1")]
    assert dataset.problems == ()


def test_every_key_of_a_dataset_means_what_is_said(tmp_path):
    [text] = blocks("yaml", "format: dashpot-dataset/1", (DATASETS,))
    (tmp_path / "dataset.yaml").write_text(text, encoding="utf-8")
    time = np.arange(5000) / 1000.0
    columns = [time, -10.0 - np.sin(20.0 * time), 2.0 + 0.2 * np.sin(20.0 * time), np.full(time.size, 20.0)]
    for name in ("long", "noted"):
        write_table(tmp_path / f"{name}.csv", ["Time,Travel,Load,Temp"], columns)
    write_table(tmp_path / "logged.rpt", ["3 1", "4 1", "Weg;Kraft;T"], columns[1:], ";", ",")
    dataset = read_dataset(tmp_path, readers())
    [set_aside] = dataset.problems
    assert set_aside.severity == "warning" and "the clamp was loose" in set_aside.message
    before, after, logged, noted = dataset.runs
    assert [run.kind for run in dataset.runs] == ["sweep", "sweep", "sweep", "hold"]
    # -1 * (-10 mm) - 2 mm;  1.002 * 2 kN - 12 N, 2 ms earlier, less the hum, which begins with its cosine of 1 N
    assert before.displacement[0] == pytest.approx(8e-3, abs=1e-9)
    assert before.force[0] == pytest.approx(1.002 * (2000.0 + 200.0 * np.sin(0.04)) - 12.0 - 1.0, abs=0.05)
    assert before.time[-1] == pytest.approx(2.0, abs=0.01) and before.held_out
    assert before.settings["inflation"] == 230e3 and before.notes["tire"] == "205/55 R16"
    assert after.sample_time == logged.sample_time == 0.002
    assert after.displacement[0] == pytest.approx(8e-3 + 1e-3 * np.sin(40.0), abs=1e-5)
    assert noted.channels["temperature@air"][0] == pytest.approx(293.15)
    assert logged.sensors["force"] == {"gain": 0.002, "zero": 3.0, "delay": 50e-6}


def test_a_single_file_does_without_a_folder(tmp_path):
    time = np.arange(2000) / 1000.0
    write_table(tmp_path / "a1.csv", ["t,x,F"], [time, np.sin(9.0 * time), np.sin(9.0 * time + 0.1)])
    channels = "{time: {column: t, unit: s}, displacement: {column: x, unit: mm}, force: {column: F, unit: N}}"
    sidecar = f"format: dashpot-dataset/1\nkind: sweep\nchannels: {channels}\n"
    (tmp_path / "a1.csv.yaml").write_text(sidecar, encoding="utf-8")
    [run] = read_dataset(tmp_path / "a1.csv", readers()).runs
    assert (run.name, run.kind) == ("a1", "sweep")


# --- a mount with a bumper that nobody modelled --------------------------------------------------------------------

MOUNT = """\
format: dashpot-network/1
name: mount
branches:
  rubber: {element: spring, stiffness: {start: 150 N/mm, bounds: [10 N/mm, 1 kN/mm]}}
  damping: {element: damper, damping: {start: 0.5 N*s/mm, bounds: [0.01 N*s/mm, 10 N*s/mm]}}
"""
CHANNELS = "{time: {column: t, unit: s}, displacement: {column: x, unit: mm}, force: {column: F, unit: N}}"
STIFFNESS, LENGTH = 5.0, 2.5
BUMPER = f"  bumper: {{element: bumper, stiffness: {STIFFNESS} N/mm, length: {LENGTH} mm}}\n"


def write_mount(folder: Path, seed: int, ending: str) -> Path:
    """Sweeps over a spring of 200 N/mm, a damper of 0.8 N s/mm and a bumper; returns the folder."""
    folder.mkdir()
    rng, time, runs = np.random.default_rng(seed), np.arange(0.0, 4.0, 0.002), []
    for number, (amplitude, preload) in enumerate([(1, 3), (2, 5), (3, 6), (2, 7), (1, 9)]):
        angle = 2.0 * np.pi * (time + time**2)
        x = preload + amplitude * np.sin(angle)
        v = amplitude * 2.0 * np.pi * (1.0 + 2.0 * time) * np.cos(angle)
        bumper = STIFFNESS * LENGTH * (np.exp(x / LENGTH) - 1.0)
        force = 200.0 * x + 0.8 * v + bumper + 5.0 * rng.standard_normal(time.size)
        delimiter = " " if ending == "bench" else ","
        write_table(folder / f"r{number}.{ending}", [delimiter.join("txF")], [time, x, force], delimiter)
        runs.append(f"  - {{name: r{number}, file: r{number}.{ending}, kind: sweep}}")
    head = ["format: dashpot-dataset/1", "name: mount", f"defaults: {{channels: {CHANNELS}}}", "runs:"]
    (folder / "dataset.yaml").write_text("\n".join([*head, *runs]) + "\n", encoding="utf-8")
    return folder


def test_the_python_lines_run(tmp_path, monkeypatch, capsys, seed):
    write_mount(tmp_path / "my", seed, "csv")
    monkeypatch.chdir(tmp_path)
    found: dict = {}
    [lines] = blocks("python", pages=(README,))
    exec(lines, found)
    assert "RMSE" in capsys.readouterr().out
    assert found["forces"]["r0"].shape == (2000,)
    assert [fit.declared.name for fit in found["comparison"].fits] == ["spring", "kelvin_voigt"]
    assert found["diagnosis"].named[0].cause.word == "viscous_damping"
    assert (tmp_path / "kelvin_voigt_fitted.yaml").is_file()


# --- the plugin ----------------------------------------------------------------------------------------------------


def plugin_source() -> str:
    """``my_mounts.py`` as its page writes it, piece by piece."""
    *pieces, _ = blocks("python", pages=(PLUGIN,))
    return "\n\n".join(pieces)


@pytest.fixture(scope="module")
def with_plugin(installation: Installation, tmp_path_factory: pytest.TempPathFactory) -> Installation:
    """The installation with the plugin of the documentation beside it."""
    source, target = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("target")
    [project] = blocks("toml", pages=(PLUGIN,))
    (source / "pyproject.toml").write_text(project, encoding="utf-8")
    (source / "my_mounts.py").write_text(plugin_source(), encoding="utf-8")
    install(installation.python, "--target", target, source)
    return replace(installation, also=(target,))


def test_everything_in_the_plugin_is_found(with_plugin, tmp_path):
    done = with_plugin.run(tmp_path, "dashpot", "list", "plugins")
    assert (done.returncode, done.stderr) == (0, "")
    [line] = [line for line in done.stdout.splitlines() if line.startswith("my_mounts ")]
    assert {word.strip(",") for word in line.split()[4:]} == {"bumper", "compass", "bench"}


def test_the_element_conforms():
    found: dict = {}
    exec(plugin_source() + "\n" + blocks("python", "from dashpot import check_element", (PLUGIN,))[0], found)


def test_element_optimizer_and_reader_work_from_the_command_line(with_plugin, tmp_path, seed):
    (tmp_path / "mount.yaml").write_text(MOUNT + BUMPER, encoding="utf-8")
    data = write_mount(tmp_path / "data", seed, "bench")
    settings = ["--optimizer", "compass", "--set", "step=0.2", "--json"]
    done = with_plugin.run(tmp_path, "dashpot", "fit", "mount.yaml", data, "-o", "out", *settings)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["optimizer"] == "compass"
    assert found["parameters"]["rubber.stiffness"]["value"] == pytest.approx(200e3, rel=0.01)
    assert found["parameters"]["damping.damping"]["value"] == pytest.approx(800.0, rel=0.05)


def test_the_cause_is_named_first(with_plugin, tmp_path, seed):
    (tmp_path / "mount.yaml").write_text(MOUNT, encoding="utf-8")
    data = write_mount(tmp_path / "data", seed, "bench")
    done = with_plugin.run(tmp_path, "dashpot", "diagnose", "mount.yaml", data, "-o", "out", "--json")
    assert done.returncode == 0, done.stderr
    first = json.loads(done.stdout)["causes"][0]
    assert first["cause"] == "bumper" and first["gain"] > 0.5
    assert first["parameters"]["length"]["value"] == pytest.approx(1e-3 * LENGTH, rel=0.1)

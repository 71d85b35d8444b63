"""A campaign that is killed, loses a worker or its scheduler ends with the same bytes as one that was left alone."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from unit.campaign.bushings import draw_population, write_population

distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")
psutil = pytest.importorskip("psutil", reason="the extra cluster is not installed")

COUNT = 6
PATIENCE = 120.0
WITHOUT_REPORTS = "reports: false\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A campaign, and its results when nobody interferes: with reports in ``whole``, without in ``plain``."""
    made = tmp_path_factory.mktemp("campaign")
    file = write_population(made, draw_population(2, COUNT), 2)
    (made / "plain.yaml").write_text(file.read_text() + WITHOUT_REPORTS)
    for name, output in (("campaign.yaml", "whole"), ("plain.yaml", "plain")):
        code, said = finished(made, name, "-o", output, "--jobs", "1")
        assert code == 0, said
    return made


def command(folder: Path, *arguments: str) -> subprocess.Popen:
    """A campaign under way."""
    return subprocess.Popen(
        [sys.executable, "-m", "dashpot", "campaign", *arguments],
        cwd=folder,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def finished(folder: Path, *arguments: str) -> tuple[int, str]:
    """Exit code and everything said."""
    process = command(folder, *arguments)
    said = "".join(process.communicate(timeout=PATIENCE))
    return process.returncode, said


def interfered(
    folder: Path, name: str, output: str, where: str, records: int, how: Callable[[int], None]
) -> tuple[int, str]:
    """Start a campaign, do something when it has so many records, and wait for its end."""
    process = command(folder, name, "-o", output, "--scheduler", where)
    kept, deadline = folder / output / "checkpoint", time.monotonic() + PATIENCE
    while process.poll() is None and len(list(kept.glob("*.json"))) < records and time.monotonic() < deadline:
        time.sleep(0.005)
    how(process.pid)
    said = "".join(process.communicate(timeout=PATIENCE))
    return process.returncode, said


def assert_alike(one: Path, other: Path) -> None:
    names = sorted(path.relative_to(other) for path in other.rglob("*") if path.is_file())
    assert sorted(path.relative_to(one) for path in one.rglob("*") if path.is_file()) == names
    assert not [name for name in names if (one / name).read_bytes() != (other / name).read_bytes()]


def kill_the_workers(process: int) -> None:
    workers = [
        child for child in psutil.Process(process).children(recursive=True) if "spawn_main" in " ".join(child.cmdline())
    ]
    assert len(workers) == 2
    for worker in workers:
        worker.kill()


def kill(process: int) -> None:
    os.kill(process, signal.SIGKILL)


def test_it_was_killed_and_goes_on(folder):
    code, _ = interfered(folder, "campaign.yaml", "cut", "local:2", 2, kill)
    assert code == -signal.SIGKILL and (folder / "cut" / "checkpoint").exists()
    assert not (folder / "cut" / "campaign.json").exists()
    code, said = finished(folder, "campaign.yaml", "-o", "cut", "--jobs", "1")
    assert code == 0, said
    assert_alike(folder / "cut", folder / "whole")


def test_all_workers_died(folder):
    code, said = interfered(folder, "plain.yaml", "poorer", "local:2", 1, kill_the_workers)
    assert code == 0, said
    assert_alike(folder / "poorer", folder / "plain")


@pytest.mark.slow
def test_an_interrupted_campaign_says_so(folder):
    code, said = interfered(folder, "plain.yaml", "stopped", "local:2", 1, lambda pid: os.kill(pid, signal.SIGINT))
    assert code == 3 and "interrupted; the same command goes on" in said
    code, said = finished(folder, "plain.yaml", "-o", "stopped", "--jobs", "1")
    assert code == 0, said
    assert_alike(folder / "stopped", folder / "plain")


@contextmanager
def cluster(port: int) -> Iterator[subprocess.Popen]:
    """A scheduler with one worker, each a process of its own."""
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    scheduler = subprocess.Popen(
        [sys.executable, "-m", "dask", "scheduler", "--port", str(port), "--no-dashboard"], **quiet
    )
    worker = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "dask",
            "worker",
            f"tcp://127.0.0.1:{port}",
            "--nthreads",
            "1",
            "--no-nanny",
            "--no-dashboard",
        ],
        **quiet,
    )
    try:
        yield scheduler
    finally:
        for process in (worker, scheduler):
            process.kill()
            process.wait(PATIENCE)


def free_port() -> int:
    with socket.socket() as trial:
        trial.bind(("127.0.0.1", 0))
        return trial.getsockname()[1]


@pytest.mark.slow
def test_the_scheduler_was_lost_and_started_again(folder):
    port = free_port()
    where = f"tcp://127.0.0.1:{port}"
    with cluster(port) as scheduler:
        code, said = interfered(folder, "plain.yaml", "lost", where, 2, lambda _: scheduler.kill())
    assert code == 1 and "the scheduler was lost; what a checkpoint holds is kept" in said, said
    with cluster(port):
        code, said = finished(folder, "plain.yaml", "-o", "lost", "--scheduler", where)
    assert code == 0, said
    assert_alike(folder / "lost", folder / "plain")


def test_a_scheduler_that_does_not_answer_is_told(folder, monkeypatch):
    monkeypatch.setattr("dashpot.campaign.scheduler.PATIENCE", 0.5)
    from dashpot.campaign.scheduler import scheduled
    from dashpot.text.problem import InputError

    with pytest.raises(InputError, match="no scheduler answers"), scheduled(f"tcp://127.0.0.1:{free_port()}"):
        pass


def test_a_dry_run_writes_nothing_and_tells_the_cost(folder):
    before = sorted(folder.iterdir())
    code, said = finished(folder, "campaign.yaml", "--dry-run")
    assert code == 0 and re.search(r"6 specimens, 6 jobs\n  6 x fit solid: [\d.]+ s each", said), said
    assert sorted(folder.iterdir()) == before


def test_results_are_not_overwritten_unasked(folder):
    code, said = finished(folder, "campaign.yaml", "-o", "whole")
    assert code == 1 and "campaign.json: exists already" in said


def test_a_failed_job_is_told_and_done_by_the_same_command(folder):
    data = folder / "b05" / "dataset.yaml"
    sound = data.read_text()
    data.write_text(sound.replace("column: F", "column: G"))
    code, said = finished(folder, "plain.yaml", "-o", "mended")
    assert code == 0 and "b05-fit-solid: set aside" in said, said
    assert json.loads((folder / "mended" / "campaign.json").read_text())["failures"][0]["specimen"] == "b05"
    data.write_text(sound)
    code, said = finished(folder, "plain.yaml", "-o", "mended")
    assert code == 0, said
    assert_alike(folder / "mended", folder / "plain")


def test_a_row_of_the_report_opens_the_report_of_its_specimen(folder):
    page = (folder / "whole" / "campaign.html").read_text()
    links = re.findall(r'href="(jobs/[^"]+)"', page)
    assert len(links) == COUNT and all((folder / "whole" / link).is_file() for link in links)
    assert 'href="jobs/' not in (folder / "plain" / "campaign.html").read_text()


def test_tables_hold_every_specimen_and_parquet_the_same(folder):
    parquet = pytest.importorskip("pyarrow.parquet", reason="the extra parquet is not installed")
    code, said = finished(folder, "plain.yaml", "-o", "table", "--parquet")
    assert code == 0, said
    lines = (folder / "table" / "specimens.csv").read_text().splitlines()
    table = parquet.read_table(folder / "table" / "specimens.parquet")
    assert len(lines) == COUNT + 1 == table.num_rows + 1
    assert lines[0].split(",") == table.column_names
    where = lines[0].split(",").index("solid: rubber.stiffness (N/m)")
    assert [float(line.split(",")[where]) for line in lines[1:]] == table.column(where).to_pylist()

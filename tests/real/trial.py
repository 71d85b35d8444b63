"""One diagnosis of a measured set as a user would run it: commands, files, seconds and memory."""

from __future__ import annotations

import ast
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from architecture.source import FRAMEWORK, PLUGINS, imports, modules
from real.sets import MeasuredSet
from seeds import seed_of

import dashpot
from dashpot.fit.holdout import split_runs
from dashpot.fit.scored import warm_up

DASHPOT = (sys.executable, "-m", "dashpot")
OUTCOME = "outcome.json"
LONGEST = 3600.0  # s
# of each cause
KEPT = (
    "cause",
    "class",
    "title",
    "standing",
    "presence",
    "probability",
    "evidence_of",
    "gain",
    "gain_interval",
    "indistinguishable_from",
)


@dataclass(frozen=True)
class Trial:
    """A set diagnosed from one of its bases. ``fewer``: a fifth of the training runs was never measured."""

    set: MeasuredSet
    base: str
    seed: int
    fewer: bool = False

    @property
    def word(self) -> str:
        return f"{self.base}-{self.seed}{'-fewer' if self.fewer else ''}"

    def removed(self) -> list[str]:
        """As near to a fifth of the training runs as whole runs come, one at least; the others would teach nothing."""
        with tempfile.TemporaryDirectory() as place:
            whole = dashpot.load_dataset(self.set.write(Path(place)), allow_outside=True)
            train = split_runs(whole, self.seed).train
        rng = np.random.default_rng(seed_of(f"{self.set.name}-{self.word}"))
        return rng.choice(train, max(1, round(len(train) / 5)), replace=False).tolist()

    def run(self, folder: Path) -> Outcome:
        """Diagnose within `folder`, hold the files against what was told, and keep the outcome there."""
        shutil.rmtree(folder, ignore_errors=True)
        removed = self.removed() if self.fewer else []
        dataset = self.set.write(folder / "data", removed)
        found = folder / "diagnosis"
        command = [
            *DASHPOT,
            "diagnose",
            self.base,
            dataset,
            "-o",
            found,
            "--seed",
            self.seed,
            "--jobs",
            1,
            "--force",
            "--allow-outside",
        ]
        spent = measured_command(list(map(str, command)), folder / "log.txt")
        result = found / "diagnosis.json"
        told = json.loads(result.read_text()) if spent.failed is None and result.exists() else None
        files = errors_of_files(told, found, dataset) if told else {}
        outcome = replace(outcome_of(self, told, spent), files=files, removed=removed)
        (folder / OUTCOME).write_text(json.dumps({"engine": engine_digest(), **asdict(outcome)}, indent=1) + "\n")
        return outcome


@dataclass(frozen=True)
class Outcome:
    """What a trial came to.

    `causes` are accepted or probable; what a part of the force only resembles is in `resembled`. `faults` are those
    that triage found; `told` and `files` hold RMSE in N by ``before.train``, ``after.held_out`` and
    so on; `floor` and `explainable` are in N. `removed` are the runs that were taken away before.
    """

    set: str
    base: str
    seed: int
    fewer: bool
    verdict: str
    causes: list[dict[str, Any]]
    faults: list[dict[str, Any]]
    told: dict[str, float]
    files: dict[str, float]
    explainable: float | None
    floor: float | None
    seconds: float
    megabytes: float
    failed: str | None
    resembled: list[dict[str, Any]] = field(default_factory=list)
    removed: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Spent:
    """What a command took; ``failed`` is the last thing that it said where it did not end well."""

    seconds: float
    megabytes: float
    failed: str | None


def measured_command(command: list[str], log: Path) -> Spent:
    """Run a command with one thread, its talk kept in `log`."""
    quiet = {"OMP_NUM_THREADS": "1", "COLUMNS": "200"}
    began = time.perf_counter()
    with log.open("w") as out:
        process = subprocess.Popen(
            ["timeout", str(LONGEST), *command], stdout=out, stderr=subprocess.STDOUT, env={**os.environ, **quiet}
        )
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    lines = [line for line in log.read_text().splitlines() if line.strip()]
    words = next((line for line in reversed(lines) if "fault" in line or "error" in line), (lines or [""])[-1])
    failed = None if process.returncode == 0 else f"exit {process.returncode}: {words.strip()[:200]}"
    return Spent(time.perf_counter() - began, usage.ru_maxrss / 1024.0, failed)


def outcome_of(trial: Trial, told: Mapping[str, Any] | None, spent: Spent) -> Outcome:
    """The outcome but for what the files say; without a result the verdict is ``failed``."""
    common = (trial.set.name, trial.base, trial.seed, trial.fewer)
    if told is None:
        return Outcome(*common, "failed", [], [], {}, {}, None, None, spent.seconds, spent.megabytes, spent.failed)
    causes = [{key: cause[key] for key in KEPT} for cause in told["causes"]]
    errors = {
        f"{when}.{which}": value
        for when, pair in told["rmse"].items()
        for which, value in pair.items()
        if value is not None
    }
    return Outcome(
        *common,
        told["verdict"],
        [cause for cause in causes if cause["standing"] != "resembles"],
        told["faults"],
        errors,
        {},
        told["explainable"]["held_out"],
        told["noise_floor"]["value"],
        spent.seconds,
        spent.megabytes,
        spent.failed,
        [cause for cause in causes if cause["standing"] == "resembles"],
    )


def errors_of_files(told: Mapping[str, Any], folder: Path, dataset: Path) -> dict[str, float]:
    """The errors of the written files, simulated by command: before and after, on training and held-out runs."""
    files = {
        "before": (told["fitted_model"], told["triaged_dataset"]),
        "after": (told["extended_model"] or told["fitted_model"], told["corrected_dataset"]),
    }
    found = {}
    for when, (network, corrected) in files.items():
        by_run = errors_by_run(folder / network, folder / corrected if corrected else dataset)
        unseen = by_run.keys() & set(told["held_out"])
        for kind, runs in ("train", by_run.keys() - unseen), ("held_out", unseen):
            if runs:
                found[f"{when}.{kind}"] = float(np.sqrt(np.mean(np.square([by_run[run] for run in runs]))))
    return found


def errors_by_run(network: Path, dataset: Path) -> dict[str, float]:
    """RMSE in N of a network file on each run of a dataset, by ``dashpot simulate``, after the warm-up of the run."""
    forces = simulated(network, dataset)
    return {
        run.name: float(np.sqrt(np.mean((forces[run.name] - run.force)[warm_up(run) :] ** 2)))
        for run in dashpot.load_dataset(dataset, allow_outside=True).runs
    }


def simulated(network: Path, dataset: Path) -> dict[str, np.ndarray]:
    """The force (n,) in N of a network file along each run of a dataset."""
    kept = network.parent / "simulated.npz"
    command = [*DASHPOT, "simulate", network, "--data", dataset, "-o", kept, "--quiet", "--force", "--allow-outside"]
    subprocess.run(list(map(str, command)), check=True, capture_output=True)
    with np.load(kept) as forces:
        return dict(forces)


@cache
def engine_digest() -> str:
    """A digest of the source that a trial ran with, less docstrings: what a diagnosis imports, kernel and plugins."""
    digest = sha256()
    for path in sorted({*_needed_by("dashpot.diagnose.diagnose"), *modules(FRAMEWORK / "kernel"), *modules(PLUGINS)}):
        digest.update(_without_docstrings(path).encode())
    return digest.hexdigest()[:16]


def _needed_by(module: str) -> set[Path]:
    """The files of the framework that a module imports, and those that they import."""
    names = {path: ".".join(path.relative_to(FRAMEWORK.parent).with_suffix("").parts) for path in modules(FRAMEWORK)}
    files = {name.removesuffix(".__init__"): path for path, name in names.items()}
    found, new = set[str](), {module}
    while new:
        found |= new
        imported = {name for one in new for name, _ in imports(files[one])}
        new = ({*imported, *(name.rpartition(".")[0] for name in imported)} & set(files)) - found
    return {files[name] for name in found}


def _without_docstrings(path: Path) -> str:
    whole = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(whole):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:]
    return ast.unparse(whole)


def is_current(engine: str, outcome: Outcome) -> bool:
    """Whether a kept outcome is of the present engine, and tells the runs that were removed where some were."""
    return engine == engine_digest() and bool(outcome.removed) == outcome.fewer


def kept_outcome(folder: Path) -> tuple[str, Outcome] | None:
    """The outcome kept in a folder with the digest of its engine, None where there is none."""
    path = folder / OUTCOME
    if not path.exists():
        return None
    found = json.loads(path.read_text())
    return found.pop("engine"), Outcome(**found)

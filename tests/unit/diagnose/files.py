"""A diagnosis by the command, and its files held against what it tells."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from unit.diagnose.rig import NETWORK, REGISTRY, write

from dashpot.cli import main
from dashpot.data.dataset import Dataset, read_dataset
from dashpot.model.reading import parse_network

WARM_UP = 0.15  # of a sweep is not judged


def diagnosed(data: Dataset, folder: Path, *options: str, network: str = NETWORK, sheet: str = "") -> Path:
    """The folder of a diagnosis by the command; ``sheet`` is the data sheet of the force channel."""
    path = write(data, folder / "data", sheet)
    (folder / "plain.yaml").write_text(network)
    code = main(["diagnose", str(folder / "plain.yaml"), str(path), "-o", str(folder / "out"), "--quiet", *options])
    assert code == 0
    return folder / "out"


def read(data: Path) -> Dataset:
    """The dataset of a file."""
    return read_dataset(data, {word: reader() for word, reader in REGISTRY.formats.items()})


def errors(network: Path, data: Path, folder: Path, held_out: Collection[str]) -> dict[str, float]:
    """RMSE of training runs and of ``held_out`` runs by `dashpot simulate` and the forces as they are read."""
    assert main(["simulate", str(network), "--data", str(data), "-o", str(folder), "--quiet", "--force"]) == 0
    found: dict[bool, list[float]] = {True: [], False: []}
    for run in read(data).runs:
        force = np.genfromtxt(folder / f"{run.name}.csv", delimiter=",", skip_header=2)[:, -1]
        first = int(round(WARM_UP * run.time.size))
        found[run.name in held_out].append(np.mean((run.force - force)[first:] ** 2))
    return {"train": np.sqrt(np.mean(found[False])), "held_out": np.sqrt(np.mean(found[True]))}


def assert_files_hold(folder: Path, tmp_path: Path) -> dict[str, Any]:
    """What was told of the dataset in ``data`` by the files in ``out``, whose errors are those told."""
    out = folder / "out"
    told = json.loads((out / "diagnosis.json").read_text())
    plain_data = folder / "data" / "dataset.yaml"
    corrected = out / told["corrected_dataset"] if told["corrected_dataset"] else plain_data
    assert corrected.exists()
    triaged = out / told["triaged_dataset"] if told["triaged_dataset"] else plain_data
    before = errors(out / told["fitted_model"], triaged, tmp_path / "before", told["held_out"])
    final = out / (told["extended_model"] or told["fitted_model"])
    after = errors(final, corrected, tmp_path / "after", told["held_out"])
    for found, said in ((before, told["rmse"]["before"]), (after, told["rmse"]["after"])):
        assert found == pytest.approx(said, rel=1e-6)
    kinds = {word: cause.kind for word, cause in REGISTRY.causes.items()}
    for cause in told["causes"]:
        beside = [{"cause": word, "class": kinds.get(word)} for word in cause["indistinguishable_from"]]
        assert cause["rivals"] == beside
    return told


def assert_is_in_files(word: str, folder: Path, told: Mapping[str, Any]) -> None:
    """A cause is accepted, and its numbers stand in the extended network, or in the corrected dataset."""
    (cause,) = (each for each in told["causes"] if each["cause"] == word)
    assert cause["accepted"] and cause["parameters"]
    if cause["branch"]:
        assert_is_in_network(cause, folder, told)
    else:
        assert_is_in_dataset(cause, folder / told["corrected_dataset"])


def assert_is_in_network(cause: Mapping[str, Any], folder: Path, told: Mapping[str, Any]) -> None:
    """The numbers of a cause stand in the extended network, and something of it was not in the fitted one."""
    fitted, extended = (numbers_of(folder / told[key]) for key in ("fitted_model", "extended_model"))
    for key, number in cause["parameters"].items():
        path = key if key in extended else f"{cause['branch']}.{key}"
        assert extended[path] == number["value"]
    assert extended.keys() - fitted.keys()


def numbers_of(network: Path) -> dict[str, float]:
    """The numbers of a network file by path."""
    return {slot.path: slot.value.number for slot in parse_network(network.read_text(), REGISTRY.elements).slots()}


def assert_is_in_dataset(cause: Mapping[str, Any], dataset: Path) -> None:
    """The runs of a fault of the force channel are put right in a dataset."""
    runs = {run["name"]: run for run in yaml.safe_load(dataset.read_text())["runs"]}
    accused = [key.rpartition(" of ")[2] for key in cause["parameters"]]
    assert all(cause["cause"] in runs[name]["channels"]["force"] for name in accused)

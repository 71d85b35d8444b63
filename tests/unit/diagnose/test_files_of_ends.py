"""What a diagnosis of a network with nodes tells is what its files say: inside it, and of several forces."""

from __future__ import annotations

import json

import numpy as np
import pytest
from unit.diagnose import machines
from unit.diagnose.files import assert_is_in_files, assert_is_in_network, read
from unit.diagnose.test_inside import AXLE, MOUNT, NAMES

from dashpot.cli import main

WARM_UP = 0.3  # s


def written(data, folder):
    """The dataset as files, all channels in SI."""
    channels, units = list(data.runs[0].channels), {"displacement": "m", "force": "N"}
    lines = ["format: dashpot-dataset/1", f"name: {data.name}", "defaults:", "  kind: sweep", "  channels:"]
    lines += ["    time: {column: time, unit: s}"]
    lines += [f"    {name}: {{column: {name}, unit: {units[name.partition('@')[0]]}}}" for name in channels]
    lines += ["runs:"]
    folder.mkdir()
    for run in data.runs:
        rows = np.column_stack([run.time, *run.channels.values()])
        np.savetxt(folder / f"{run.name}.csv", rows, "%.12g", ",", header=",".join(["time", *channels]), comments="")
        held_out = ", held_out: true" if run.held_out else ""
        settings = f"settings: {{warm_up: {WARM_UP} s}}"
        lines.append(f"  - {{name: {run.name}, file: {run.name}.csv, {settings}{held_out}}}")
    (folder / "dataset.yaml").write_text("\n".join(lines) + "\n")
    return folder / "dataset.yaml"


def errors(network, data, folder):
    """RMSE of training runs and of held-out runs over all forces by `dashpot simulate`."""
    assert main(["simulate", str(network), "--data", str(data), "-o", str(folder), "--quiet"]) == 0
    found = {"train": [], "held_out": []}
    for run in read(data).runs:
        with (folder / f"{run.name}.csv").open() as file:
            names = file.readline().strip().split(",")
            columns = dict(zip(names, np.loadtxt(file, delimiter=",", skiprows=1).T, strict=True))
        first = round(WARM_UP / run.sample_time)
        forces = [name for name in columns if name.startswith("force")]
        for name in forces:
            shown = run.channels[name if name in run.channels else "force"]
            found["held_out" if run.held_out else "train"].append(np.mean((shown - columns[name])[first:] ** 2))
    return {kind: np.sqrt(np.mean(squares)) for kind, squares in found.items()}


def held(network, data, folder):
    """What is told of a dataset, whose numbers are those of the files, and the folder of these."""
    plain, out = written(data, folder / "data"), folder / "out"
    (folder / "plain.yaml").write_text(network)
    assert main(["diagnose", str(folder / "plain.yaml"), str(plain), "-o", str(out), "--quiet"]) == 0
    told = json.loads((out / "diagnosis.json").read_text())
    corrected = out / told["corrected_dataset"] if told["corrected_dataset"] else plain
    before = errors(out / told["fitted_model"], plain, folder / "before")
    after = errors(out / told["extended_model"], corrected, folder / "after")
    for found, said in ((before, told["rmse"]["before"]), (after, told["rmse"]["after"])):
        assert found == pytest.approx(said, rel=1e-6)
    return told, out


@pytest.mark.slow
def test_friction_at_an_inner_node_is_in_files_that_say_what_is_told(tmp_path):
    moves = [machines.sweep(amplitude, stop=12.0) for amplitude in (0.5e-3, 1e-3, 2e-3)]
    forces = [machines.mount(25.0, moves)]
    data = machines.measured(np.random.default_rng(1), forces, NAMES, moves, noise=1.0, held_out=["second"])
    told, out = held(MOUNT, data, tmp_path)
    assert_is_in_files("friction", out, told)
    assert told["causes"][0]["place"] == "between piston and wall"


@pytest.mark.slow
def test_friction_of_an_axle_and_the_gain_of_one_of_its_forces_are_in_files_that_say_what_is_told(tmp_path):
    moves = [machines.sweep(amplitude) for amplitude in (3e-3, 3e-3, 4e-3)]
    sides, ends = np.array([[1.0, 1.0, 1.0], [-1.0, 1.0, -0.3]]), ("platform_left", "platform_right")
    forces = machines.axle(40.0, moves, sides[1])
    forces[1, 1] *= 1.05
    rng = np.random.default_rng(2)
    told, out = held(AXLE, machines.measured(rng, forces, NAMES, moves, ends, sides, held_out=["third"]), tmp_path)
    causes = {cause["cause"]: cause for cause in told["causes"]}
    assert_is_in_network(causes["friction"], out, told)
    assert list(causes["gain"]["parameters"]) == ["gain error of second@platform_right"]
    channels = (run.channels for run in read(out / told["corrected_dataset"]).runs if run.name == "second")
    assert next(channels)["force@platform_right"] == pytest.approx(forces[1, 1] / 1.05, rel=1e-3, abs=10.0)

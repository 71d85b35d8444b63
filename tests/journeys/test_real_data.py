"""Measured data of others, read where they lie: what is known of each is named, from a plain model.

The folders hold published measurements and are no part of dashpot; DASHPOT_REAL_DATA names where they are. A folder
that is not there skips its test.
"""

import os
from pathlib import Path

import pytest

from dashpot.contract.registry import load_registry
from dashpot.data.dataset import read_dataset
from dashpot.diagnose.diagnose import diagnose
from dashpot.model.reading import parse_network

pytestmark = pytest.mark.slow

PLAIN_FRICTION = """\
format: dashpot-network/1
name: plain_friction
branches:
  stiffness: {element: spring, stiffness: {start: 1 N/mm}}
  friction: {element: dahl, limit: {start: 1 kN}, stiffness: {start: 1 kN/mm}}
"""
PLAIN_DAMPER = """\
format: dashpot-network/1
name: plain_damper
branches:
  stiffness: {element: spring, stiffness: {start: 1 N/mm}}
  damping: {element: damper, damping: {start: 1 N*s/mm}}
"""
FRICTIONS = {"friction", "amplitude_softening", "load_dependent_friction", "velocity_dependent_friction"}


def folder(name):
    """The folder of a measurement, or a skipped test."""
    found = Path(os.environ.get("DASHPOT_REAL_DATA", "data")) / name
    if not found.is_dir():
        pytest.skip(f"no measurement '{name}': set DASHPOT_REAL_DATA to the folder that holds it")
    return found


def told(tmp_path, network, head, runs):
    """The diagnosis of a network on runs, each given as the entries of a dataset file."""
    lines = "\n".join("  - {" + ", ".join(f"{key}: {value}" for key, value in run.items()) + "}" for run in runs)
    text = f"format: dashpot-dataset/1\nname: real\ndefaults:\n{head}\nruns:\n{lines}\n"
    (tmp_path / "dataset.yaml").write_text(text, encoding="utf-8")
    registry = load_registry()
    dataset = read_dataset(
        tmp_path / "dataset.yaml", {word: reader() for word, reader in registry.formats.items()}, allow_outside=True
    )
    return diagnose(parse_network(network, registry.elements), dataset, registry=registry).as_dict()


def test_a_magnetorheological_damper_is_not_viscous(tmp_path):
    """Its force yields at a level that hardly depends on velocity: friction, a low power of it or a valve is first."""
    source = folder("mr_damper_utfsm") / "preprocessed"
    head = """\
  channels:
    time: {column: 1, unit: s}
    displacement: {column: 2, unit: mm}
    force: {column: 4, unit: N}"""
    conditions = ((10, "1", 5), (25, "0x25", 1), (25, "0x5", 1), (5, "3", 5), (2, "5", 1))
    runs = [
        {"name": f"a{a}_f{f}", "file": source / f"{a}mm{f}Hz1A.txt", "kind": "harmonic", "decimate": decimate}
        for a, f, decimate in conditions
    ]
    found = told(tmp_path, PLAIN_DAMPER, head, runs)
    assert found["causes"][0]["cause"] in FRICTIONS | {"power_law_damping", "valve"}
    assert found["rmse"]["after"]["held_out"] < 0.5 * found["rmse"]["before"]["held_out"]


def test_bearing_blocks_without_a_time_column_go_through(tmp_path):
    """Filled rubber softens with amplitude: sliders of some kind are named."""
    source = folder("hdrb_bearing") / "Test.mat"
    head = """\
  channels:
    sampling: 465.5 Hz
    displacement: {column: d, unit: cm}
    force: {column: f, unit: tonf}
  decimate: 8"""
    blocks = ((1, 6600), (6600, 13100), (13100, 19600), (19600, 26372))
    runs = [
        {"name": f"block_{number}", "file": source, "kind": "harmonic", "rows": f"[{first}, {last}]"}
        for number, (first, last) in enumerate(blocks, 1)
    ]
    found = told(tmp_path, PLAIN_DAMPER, head, runs)
    assert {cause["cause"] for cause in found["causes"]} & FRICTIONS
    assert found["verdict"] != "nothing_missing"


def test_a_friction_damper_shows_that_plain_friction_is_not_all(tmp_path):
    """Lost motion and ringing: something is missing, and the held-out error falls."""
    source = folder("friction_damper_brfd")
    head = """\
  channels:
    time: {column: 1, unit: s}
    displacement: {column: 2, unit: in}
    force: {column: 3, unit: kip}
  decimate: 8
  file_options: {key: data}"""
    runs = [
        {
            "name": f"f{f}_a{a}".replace(".", ""),
            "file": source / f"{f}Hz30lbtension{a}amplitude.json",
            "kind": "harmonic",
        }
        for f in ("0.5", "1")
        for a in ("0.5", "1", "1.5")
    ]
    found = told(tmp_path, PLAIN_FRICTION, head, runs)
    assert found["causes"]
    assert found["verdict"] in ("partly_explained", "ambiguous", "unexplained")
    assert found["rmse"]["after"]["held_out"] < found["rmse"]["before"]["held_out"]


def test_uneven_sampling_goes_through(tmp_path):
    """A seal that rubs, recorded at 10 to 50 ms: the runs are laid on an even grid, one with gaps is set aside."""
    source = folder("seal_friction_pneumatic")
    head = """\
  channels:
    time: {column: 1, unit: ms}
    displacement: {column: 5, unit: mm}
    force: {column: 7, unit: N}
  file_options: {skip_rows: 15}"""
    runs = [
        {"name": f"bar_{bar}", "file": source / f"O-ring257_{bar}bar.csv", "kind": "transient"} for bar in (3, 5, 7)
    ]
    found = told(tmp_path, PLAIN_DAMPER, head, runs[:1])
    assert found["held_out"] == []
    assert found["rmse"]["after"]["train"] < 0.01 * found["rmse"]["before"]["train"]
    names = {cause["cause"] for cause in found["causes"]}
    rivals = {word for cause in found["causes"] for word in cause["indistinguishable_from"] or ()}
    assert (names | rivals) & FRICTIONS  # 17 s of one run leave open whether a sharp valve does the same

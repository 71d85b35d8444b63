"""Every mistake of a user is answered with what was expected, what was got, where, and what to do: no traceback."""

from __future__ import annotations

import json
import os
import shutil
import textwrap
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

NETWORK = "format: dashpot-network/1\nname: n\nbranches:\n"
DATASET = "format: dashpot-dataset/1\nname: bench\n"
CHANNELS = (
    "defaults: {kind: harmonic, channels: {time: {column: t, unit: s}, displacement: {column: x, unit: mm}, "
    "force: {column: F, unit: N}}}\n"
)
RUNS = "runs:\n  - {name: a, file: a.csv}\n  - {name: b, file: b.csv}\n"
RIG = "format: dashpot-rig/1\nname: r\n"
STUDY = "format: dashpot-study/1\nname: s\ndata: data\n"
STAGES, MODELS = "stages: [{name: all}]\n", "models: [good.yaml]\n"
SPRING = "k: {element: spring, stiffness: {start: 150 N/mm, bounds: [10 N/mm, 1 kN/mm]}}\n"

TWO_ENDS = """\
format: dashpot-network/1
name: two
nodes: {left: driven, right: driven, body: ground}
branches:
  a: {element: spring, stiffness: 1 N/mm, between: [left, body]}
  b: {element: spring, stiffness: 1 N/mm, between: [right, body]}
"""

FILES = {
    "good.yaml": NETWORK + "  " + SPRING,
    "data/dataset.yaml": DATASET + CHANNELS + RUNS,
    "a_file": "x",
    "empty.yaml": "",
    "brackets.yaml": "a: [1,\nb",
    "folder/other.txt": "x",
    "data/a.xyz": "1",
    "data/empty.csv": "",
    "data/broken.npz": "hello",
    "data/broken.mat": "hello",
    "data/broken.json": "{",
}


def of_network(line: str) -> str:
    return NETWORK + "  " + line + "\n"


def of_run(keys: str) -> str:
    return f"{DATASET}{CHANNELS}runs:\n  - {{name: a, {keys}}}\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """Good and bad files, all small."""
    root = tmp_path_factory.mktemp("errors")
    for name, text in FILES.items():
        (root / name).parent.mkdir(exist_ok=True)
        (root / name).write_text(text)
    (root / "latin.yaml").write_bytes("name: Stoßdämpfer".encode("latin-1"))
    t = np.arange(0.0, 2.0, 0.005)
    x = 5e-3 + 2e-3 * np.sin(2 * np.pi * 3 * t)
    force = 2e5 * x + 100 * np.gradient(x, t) + np.random.default_rng(0).normal(size=t.size)
    holed = np.where(np.arange(t.size) == 50, np.nan, force)
    gap = np.r_[0:100, 180:400]
    save(root / "data/a.csv", t, x, force)
    save(root / "data/b.csv", t, 1.2 * x, 1.2 * force)
    save(root / "data/nan.csv", t, x, holed)
    save(root / "data/short.csv", t[:9], x[:9], force[:9])
    save(root / "data/gap.csv", t[gap], x[gap], force[gap])
    save(root / "data/clipped.csv", t, x, np.minimum(force, 1200.0))
    save(root / "data/still.csv", t, 0.0 * x + 5e-3, force)
    return root


def save(path: Path, t: np.ndarray, x: np.ndarray, force: np.ndarray) -> None:
    rows = zip(t, 1e3 * x, force, strict=True)
    path.write_text("t,x,F\n" + "\n".join(",".join(map(repr, map(float, row))) for row in rows) + "\n")


@pytest.fixture
def blame(call: Callable, folder: Path, monkeypatch) -> Callable[..., tuple[int, str]]:
    """The exit code and what is said, after a file of the given text was written."""
    monkeypatch.chdir(folder)
    monkeypatch.setenv("COLUMNS", "400")

    def run(arguments: str, file: str = "", text: str = "") -> tuple[int, str]:
        if file:
            Path(file).write_text(textwrap.dedent(text))
        shutil.rmtree("out", ignore_errors=True)
        code, out, error = call(*arguments.split())
        assert out == ""
        return code, error

    return run


# (arguments, text of the file among them), then where, what was expected, what was got, what to do
NETWORKS = {
    "no file": (
        "check nope.yaml",
        None,
        "nope.yaml: ",
        "file",
        "there is no such file",
        "check the name and the folder",
    ),
    "unknown name": (
        "check kelvin_vogt",
        None,
        "kelvin_vogt: ",
        "shipped network",
        "no such file",
        "did you mean 'kelvin_voigt'",
    ),
    "an element": ("draw maxwell", None, "maxwell: ", "expected a network", "of an element", "dashpot list models"),
    "a folder": ("check folder", None, "folder: ", "expected a network file", "got a folder", "name a file in it"),
    "an empty file": (
        "check empty.yaml",
        None,
        "empty.yaml:1:1: ",
        "expected the network",
        "got nothing",
        "write its keys",
    ),
    "no YAML": (
        "check brackets.yaml",
        None,
        "brackets.yaml:2:2: ",
        "expected ',' or ']'",
        "got '<stream end>'",
        "close the bracket",
    ),
    "no UTF-8": (
        "check latin.yaml",
        None,
        "latin.yaml:1:10: ",
        "expected UTF-8",
        "got the byte 0xdf",
        "save the file as UTF-8",
    ),
    "another version": (
        "check x.yaml",
        "format: dashpot-network/2\nname: n\nbranches: {}",
        "x.yaml:1:9: ",
        "expected one of dashpot-network/1",
        "got 'dashpot-network/2'",
        "did you mean",
    ),
    "no name": (
        "check x.yaml",
        "format: dashpot-network/1\nbranches: {}",
        "x.yaml:1:1: ",
        "the network",
        "lacks 'name'",
        "add a line 'name: ...'",
    ),
    "no branch": (
        "check x.yaml",
        "format: dashpot-network/1\nname: n\nbranches: {}",
        "x.yaml:3:11: ",
        "the network",
        "has no branch",
        "add a branch",
    ),
    "a key twice": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: 1, stiffness: 2}"),
        "x.yaml:4:",
        "'stiffness'",
        "stands twice",
        "remove or rename one",
    ),
    "a wrong key": (
        "check x.yaml",
        of_network("k: {element: spring, stifness: 1 N/mm}"),
        "x.yaml:4:24: ",
        "'k' of branches",
        "has no key 'stifness'",
        "did you mean 'stiffness'",
    ),
    "a missing number": (
        "check x.yaml",
        of_network("k: {element: maxwell, stiffness: 1 N/mm}"),
        "x.yaml:4:6: ",
        "s)",
        "'k' lacks 'relaxation_time'",
        "add 'relaxation_time: ...'",
    ),
    "an unknown unit": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: 150 N/mmm}"),
        "x.yaml:4:35: ",
        "k.stiffness",
        "unknown unit 'N/mmm'",
        "did you mean 'N/mm'",
    ),
    "a wrong unit": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: 150 N}"),
        "x.yaml:4:35: ",
        "expected a quantity in N/m",
        "got 'N', which measures",
        "write it in N/m or a unit of the same kind",
    ),
    "a decimal comma": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: '1,5 N/mm'}"),
        "x.yaml:4:35: ",
        "expected a quantity in N/m",
        "got '1,5 N/mm'",
        "the decimal sign is a point",
    ),
    "bounds the wrong way": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: {start: 1 N/mm, bounds: [5 N/mm, 2 N/mm]}}"),
        "x.yaml:4:",
        "expected low < high",
        "got 5000 and 2000",
        "exchange or widen them",
    ),
    "a start outside": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: {start: 1 N/mm, bounds: [5 N/mm, 9 N/mm]}}"),
        "x.yaml:4:",
        "expected a start inside its bounds",
        "got 1000",
        "move it, or widen the bounds",
    ),
    "beyond sense": (
        "check x.yaml",
        of_network("k: {element: maxwell, stiffness: 1 N/mm, relaxation_time: 1e9 s}"),
        "x.yaml:4:",
        "expected 1e-05 to 10000 s",
        "got 1e+09",
        "check its unit",
    ),
    "a missing plugin": (
        "check x.yaml",
        of_network("k: {element: rubber_of_acme, stiffness: 1}"),
        "x.yaml:4:16: ",
        "take one of: asymmetric_damper",
        "there is no element 'rubber_of_acme'",
        "install the plugin that gives it",
    ),
    "an unknown element": (
        "check x.yaml",
        of_network("k: {element: sprng, stiffness: 1}"),
        "x.yaml:4:16: ",
        "element",
        "there is no element 'sprng'",
        "did you mean 'spring'",
    ),
    "a circle": (
        "check x.yaml",
        of_network("k: {use: x.yaml}"),
        "x.yaml:4:12: ",
        "cannot be used",
        "the network uses itself: x.yaml -> x.yaml",
        "break the circle",
    ),
    "an unknown part": (
        "check x.yaml",
        of_network("k: {use: gehman}"),
        "x.yaml:4:12: ",
        "shipped network",
        "'gehman' cannot be used",
        "did you mean 'gehmann'",
    ),
    "half a table": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: {deflection: [0, 1 mm], force: [0 N]}}"),
        "x.yaml:4:",
        "expected as many force as deflection",
        "got 1 and 2",
        "give one force for each deflection",
    ),
    "a table out of order": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: {deflection: [1 mm, 0], force: [0 N, 1 N]}}"),
        "x.yaml:4:",
        "expected growing deflection",
        "got 0 m",
        "sort the table",
    ),
    "an empty table": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: {deflection: [], force: []}}"),
        "x.yaml:4:",
        "expected",
        "got",
        "give one force for each deflection",
    ),
    "nodes unsaid": (
        "check x.yaml",
        of_network("k: {element: spring, stiffness: 1, between: [a, b]}"),
        "x.yaml:4:",
        "'k' has 'between'",
        "the network has no nodes",
        "name them at the top",
    ),
    "an unknown node": (
        "check x.yaml",
        TWO_ENDS.replace("[left, body]", "[lft, body]"),
        "x.yaml:5:52: ",
        "node",
        "there is no node 'lft'",
        "did you mean 'left'",
    ),
    "numbers missing": (
        "simulate gehmann --data data -o out",
        None,
        "gehmann.yaml:",
        "is to be taken from data",
        "has no knots yet",
        "fit the network first",
    ),
}

DATASETS = {
    "no dataset": (
        "fit good.yaml data/nope -o out",
        None,
        "data/nope: ",
        "file or folder",
        "there is no such file or folder",
        "check the name and the folder",
    ),
    "a folder without one": (
        "fit good.yaml folder -o out",
        None,
        "folder: ",
        "dataset.yaml",
        "holds no dataset.yaml",
        "`dashpot import folder` writes a first one",
    ),
    "a file without words": (
        "fit good.yaml data/a.csv -o out",
        None,
        "data/a.csv: ",
        "holds",
        "nothing says what this file holds",
        "`dashpot import data/a.csv` writes a dataset.yaml|write 'data/a.csv.yaml'",
    ),
    "a network in its place": (
        "compare good.yaml spring -o out",
        None,
        "spring: ",
        "expected a dataset",
        "got the name of a network",
        "the dataset stands last",
    ),
    "the other way round": (
        "fit data good.yaml -o out",
        None,
        "data: ",
        "expected a network",
        "got measured data",
        "the models stand first",
    ),
    "another kind of file": (
        "fit good.yaml good.yaml -o out",
        None,
        "good.yaml:1:9: ",
        "expected one of dashpot-dataset/1",
        "got 'dashpot-network/1'",
        "did you mean",
    ),
    "no runs": (
        "fit good.yaml data/x.yaml -o out",
        DATASET + CHANNELS + "runs: []",
        "x.yaml:1:1: ",
        "the dataset",
        "has no runs",
        "list some under 'runs'",
    ),
    "a missing column": (
        "fit good.yaml data/x.yaml -o out",
        DATASET + CHANNELS.replace("column: x", "column: X1") + RUNS,
        "x.yaml:3:90: ",
        "run 'a' (a.csv) is set aside",
        "it has no column 'X1'",
        "did you mean 'x'",
    ),
    "a missing channel": (
        "fit good.yaml data/x.yaml -o out",
        DATASET + "defaults: {kind: harmonic, channels: {time: t, force: F}}\n" + RUNS,
        "x.yaml:3:",
        "displacement: {column: ..., unit: m}",
        "has no channel 'displacement'",
        "add",
    ),
    "a wrong unit of a channel": (
        "fit good.yaml data/x.yaml -o out",
        DATASET + CHANNELS.replace("unit: mm", "unit: N") + RUNS,
        "x.yaml:3:99: ",
        "expected a quantity in m",
        "got 'N'",
        "write it in m",
    ),
    "a wrong kind": (
        "fit good.yaml data/x.yaml -o out",
        DATASET + CHANNELS.replace("harmonic", "harmonc") + RUNS,
        "x.yaml:3:18: ",
        "expected one of quasi_static, sweep",
        "got 'harmonc'",
        "did you mean 'harmonic'",
    ),
    "a missing file": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: aa.csv"),
        "x.yaml:5:",
        "run 'a' (aa.csv) is set aside",
        "there is no such file",
        "did you mean 'a.csv'",
    ),
    "a file elsewhere": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: ../good.yaml"),
        "x.yaml:5:",
        "the folder of the dataset",
        "it lies outside",
        "--allow-outside",
    ),
    "an unknown reader": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: a.csv, reader: cvs"),
        "x.yaml:5:",
        "run 'a'",
        "there is no reader 'cvs'",
        "did you mean 'csv'",
    ),
    "an unknown ending": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: a.xyz"),
        "x.yaml:5:",
        "there are: csv",
        "no reader takes files ending in '.xyz'",
        "say 'reader: ...'",
    ),
    "no numbers": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: nan.csv"),
        "x.yaml:5:",
        "number",
        "the force has no number (empty, NaN or infinite) in line 52",
        "cut a whole piece out",
    ),
    "too short": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: short.csv"),
        "x.yaml:5:",
        "expected at least 16",
        "it has 9 samples",
        "check 'rows', 'start' and 'stop'",
    ),
    "a gap": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: gap.csv"),
        "x.yaml:5:",
        "without gaps",
        "a gap from 0.495 s to 0.9 s",
        "'start: 0.9 s, stop: 1.995 s'",
    ),
    "clipped": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: clipped.csv"),
        "x.yaml:5:",
        "its maximum",
        "the force stays at exactly 1200 N",
        "measure with a larger range",
    ),
    "no motion": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: still.csv"),
        "x.yaml:5:",
        "displacement",
        "0.005 m all the time",
        "check the column of the displacement",
    ),
    "an empty file": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: empty.csv"),
        "x.yaml:5:",
        "rows",
        "it holds no rows",
        "check that this is the file",
    ),
    "a damaged npz": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: broken.npz"),
        "x.yaml:5:",
        "expected|sound file of numpy arrays",
        "broken.npz",
        "save",
    ),
    "a damaged mat": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: broken.mat"),
        "x.yaml:5:",
        "expected|MATLAB file",
        "broken.mat",
        "save",
    ),
    "a damaged json": (
        "fit good.yaml data/x.yaml -o out",
        of_run("file: broken.json"),
        "x.yaml:5:",
        "JSON",
        "broken.json",
        ". ",
    ),
    "other ends": (
        "simulate x.yaml --data data -o out",
        TWO_ENDS,
        "run 'a'",
        "which the network needs",
        "has no channel 'displacement@left'",
        "declare it under 'channels'",
    ),
}

COMMANDS = {
    "a file in place of a folder": (
        "fit good.yaml data -o a_file",
        None,
        "a_file: ",
        "expected a folder",
        "got a file",
        "choose another -o",
    ),
    "below a file": (
        "fit good.yaml data -o a_file/below",
        None,
        "a_file/below: ",
        "expected a folder",
        "got: Not a directory",
        "choose another -o",
    ),
    "a rig of no name": (
        "simulate good.yaml --rig triangel -o out",
        None,
        "triangel: ",
        "shipped bench",
        "there is no such file, procedure",
        "did you mean 'triangle'",
    ),
    "a rig in a file": (
        "simulate good.yaml --rig x.yaml -o out",
        RIG + "tests: [{rig: triangel}]",
        "x.yaml:3:15: ",
        "expected one of axle_sweep",
        "got 'triangel'",
        "did you mean 'triangle'",
    ),
    "an option of a rig": (
        "simulate good.yaml --rig x.yaml -o out",
        RIG + "tests: [{rig: triangle, depht: 3 mm}]",
        "x.yaml:3:9: ",
        "'triangle'",
        "has no option 'depht'",
        "did you mean 'depth'",
    ),
    "a unit of a rig": (
        "simulate good.yaml --rig x.yaml -o out",
        RIG + "tests: [{rig: triangle, depth: 3 N}]",
        "x.yaml:3:9: ",
        "expected a quantity in m",
        "got 'N'",
        "write it in m",
    ),
    "a comma in a rig": (
        "simulate good.yaml --rig x.yaml -o out",
        RIG + "tests: [{rig: hydropulser, amplitudes: ['1,5 mm']}]",
        "x.yaml:3:",
        "expected a list of single numbers",
        "the text '1,5 mm'",
        "the decimal sign is a point",
    ),
    "no tests": (
        "simulate good.yaml --rig x.yaml -o out",
        RIG + "tests: []",
        "x.yaml:3:8: ",
        "expected at least one test",
        "got an empty list",
        "add one",
    ),
    "a test twice": (
        "simulate good.yaml --rig x.yaml -o out",
        RIG + "tests: [{rig: triangle}, {rig: triangle}]",
        "r: ",
        "runs",
        "several runs are called",
        "no two procedures may plan the same",
    ),
    "another rig": (
        "simulate good.yaml --rig axle_sweep -o out",
        None,
        "run 'in_phase_m0'",
        "which the network needs",
        "it has motions of 'platform_left'",
        "declare",
    ),
    "a study of no name": (
        "study papr_tire -o out",
        None,
        "papr_tire: ",
        "shipped study",
        "there is no such file",
        "did you mean 'paper_tire'",
    ),
    "a model of no name": (
        "study x.yaml -o out",
        STUDY + STAGES + "models: [kelvin_vogt]",
        "x.yaml:5:10: ",
        "shipped network",
        "'kelvin_vogt': there is no such file",
        "did you mean 'kelvin_voigt'",
    ),
    "no models": (
        "study x.yaml -o out",
        STUDY + STAGES,
        "x.yaml:1:1: ",
        "the study",
        "lacks 'models'",
        "add a line 'models: ...'",
    ),
    "no stages": (
        "study x.yaml -o out",
        STUDY + MODELS,
        "x.yaml:4:10: ",
        "the model 'n'",
        "has no stages",
        "list some under 'stages'",
    ),
    "an optimizer of a study": (
        "study x.yaml -o out",
        STUDY + "stages: [{name: all, optimizer: psoo}]\n" + MODELS,
        "x.yaml:4:",
        "optimizer",
        "No such optimizer 'psoo'",
        "did you mean 'pso'",
    ),
    "an option of a study": (
        "study x.yaml -o out",
        STUDY + "stages: [{name: all, optimizer: pso, options: {partcles: 3}}]\n" + MODELS,
        "x.yaml:4:",
        "'pso'",
        "has no option 'partcles'",
        "did you mean 'particles'",
    ),
    "a pattern of runs": (
        "study x.yaml -o out",
        STUDY + STAGES + MODELS + "hold_out: zz*",
        "s: ",
        "runs are: a, b",
        "no run is called 'zz*'",
        "runs are",
    ),
    "a pattern of numbers": (
        "study x.yaml -o out",
        STUDY + "stages: [{name: all, free: 'zz*'}]\n" + MODELS,
        "s: ",
        "expected a pattern of parameters",
        "got 'zz*', which names none",
        "parameters are: k.stiffness",
    ),
    "a pattern of profiles": (
        "study x.yaml -o out",
        STUDY + STAGES + MODELS + "profiles: 'zz*'",
        "s: ",
        "expected a pattern of parameters",
        "got 'zz*', which names none",
        "parameters are: k.stiffness",
    ),
    "a model above": (
        "study x.yaml -o out",
        STUDY + STAGES + "models: [{network: good.yaml, start_from: zz}]",
        "x.yaml:5:",
        "expected nothing",
        "got 'zz'",
        "there is nothing to choose from",
    ),
    "data of a study": (
        "study x.yaml -o out",
        STUDY.replace("data\n", "dat\n") + STAGES + MODELS,
        "dat: ",
        "file or folder",
        "there is no such file or folder",
        "did you mean 'data'",
    ),
    "a negative weight": (
        "study x.yaml -o out",
        STUDY + STAGES + MODELS + "weights: {a: -1}",
        "x.yaml:6:10: ",
        "expected weights above 0",
        "'weights'",
        "held out",
    ),
}

USAGE = {
    "no output": ("fit good.yaml data", "Missing option '-o'"),
    "no verb": ("fitt", "No such verb 'fitt', did you mean 'fit'?"),
    "no option": ("fit good.yaml data -o out --optimiser pso", "Did you mean '--optimizer'?"),
    "no optimizer": ("fit good.yaml data -o out --optimizer psoo", "No such optimizer 'psoo', did you mean 'pso'?"),
    "an option of nobody": ("fit good.yaml data -o out --set particles=3", "name it with --optimizer"),
    "an unknown option": ("fit good.yaml data -o out --optimizer pso --set particels=3", "did you mean 'particles'?"),
    "a wrong type": (
        "fit good.yaml data -o out --optimizer pso --set particles=three",
        "expected a whole number, got 'three'",
    ),
    "no value": ("fit good.yaml data -o out --optimizer pso --set particles", "expected KEY=VALUE, got 'particles'"),
    "a value beyond": ("fit good.yaml data -o out --optimizer pso --set particles=1", "expected at least 2, got 1"),
    "a seed below": ("fit good.yaml data -o out --seed -1", "-1 is not in the range x>=0"),
    "no worker": ("fit good.yaml data -o out --jobs 0", "0 is not in the range x>=1"),
    "no motion": ("simulate good.yaml -o out", "Say either DATASET or --rig RIG"),
    "two motions": ("simulate good.yaml --data data --rig triangle -o out", "Say either DATASET or --rig RIG"),
    "an option of no rig": ("simulate good.yaml --data data --set depth=3mm -o out", "name it with --rig"),
    "an option of a bench": (
        "simulate good.yaml --rig tire_bench --set depth=3mm -o out",
        "those of a bench stand in its file",
    ),
    "a unit of an option": (
        "simulate good.yaml --rig triangle --set depth=3N -o out",
        "expected a quantity in m, got 'N'",
    ),
    "no picture": ("draw good.yaml -o x.png", "expected a file ending in .svg or .txt, got 'x.png'"),
    "no list": ("list element", "No list of 'element', did you mean 'elements'?"),
    "no specimen": ("demo --specimen tyre -o out", "No specimen 'tyre' to demonstrate with, there are: test_tire"),
    "no networks": ("compare --data data -o out", "Missing argument 'MODEL... DATASET'"),
    "no data": ("compare good.yaml -o out", "Missing argument 'DATASET'"),
    "two models of one": ("fit good.yaml spring data -o out", "expected one MODEL and one DATASET, got good.yaml"),
    "a file for a folder": ("fit good.yaml data -o out/a.html", "got 'out/a.html', which looks like a file"),
}


def check_parts(code: int, error: str, *parts: str) -> None:
    assert code == 1, error
    assert "Traceback" not in error and "fault" not in error
    for part in parts:
        assert any(choice in error for choice in part.split("|")), f"expected {part!r} in:\n{error}"


CASES = {**NETWORKS, **{f"data: {k}": v for k, v in DATASETS.items()}, **{f"verb: {k}": v for k, v in COMMANDS.items()}}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_a_mistake_is_answered_with_where_expected_got_and_what_to_do(blame, case):
    arguments, text, *parts = case
    file = "" if text is None else "data/x.yaml" if "data/x.yaml" in arguments else "x.yaml"
    check_parts(*blame(arguments, file, text or ""), *parts)


@pytest.mark.parametrize("arguments, told", USAGE.values(), ids=USAGE)
def test_misuse_shows_the_usage_and_what_to_say(blame, arguments, told):
    code, error = blame(arguments)
    assert code == 2
    assert error.startswith("Usage: dashpot ") and told in error and "Traceback" not in error


def test_results_are_not_overwritten_unasked(blame, folder):
    (folder / "there").mkdir(exist_ok=True)
    (folder / "there" / "fit.json").write_text("{}")
    check_parts(*blame("fit good.yaml data -o there"), "fit.json: ", "exists already", "choose another -o", "--force")


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="rights do not bind this user")
@pytest.mark.parametrize(
    "arguments, locked", [("check good.yaml", "good.yaml"), ("fit good.yaml data -o locked", "locked")]
)
def test_rights_that_lack_are_named(blame, folder, arguments, locked):
    (folder / "locked").mkdir(exist_ok=True)
    rights = (folder / locked).stat().st_mode
    (folder / locked).chmod(0)
    try:
        check_parts(*blame(arguments), f"{locked}: ", "rights")
    finally:
        (folder / locked).chmod(rights)


def test_a_folder_that_may_not_be_written_is_told_before_the_work(blame, monkeypatch):
    monkeypatch.setattr("os.access", lambda path, rights: False)
    check_parts(
        *blame("fit good.yaml data -o shut"), "shut: ", "expected a folder that may be written", "change its rights"
    )


def test_a_disk_that_is_full_leaves_no_half_file(blame, folder, monkeypatch):
    opened = Path.open

    def full(path: Path, *mode: str, **more):
        stream = opened(path, *mode, **more)
        if mode != ("wb",):
            return stream
        stream.write(b"some bytes")
        stream.close()
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "open", full)
    check_parts(*blame("draw good.yaml -o full/picture.svg"), "picture.svg: ", "No space left on device", "make room")
    assert list((folder / "full").iterdir()) == []


def test_a_plugin_that_is_not_installed(blame, monkeypatch):
    from dashpot.contract.registry import load_registry

    monkeypatch.setenv("DASHPOT_PLUGINS", "elemnts")
    load_registry.cache_clear()
    try:
        expected = "expected names of installed plugins"
        check_parts(
            *blame("check good.yaml"), "DASHPOT_PLUGINS: ", expected, "got 'elemnts'", "did you mean 'elements'"
        )
    finally:
        load_registry.cache_clear()


RECORDS = {
    "of another study": (None, "its records are of another study", "say --force to begin again"),
    "with a damaged mark": (b"\xff", "its 'study.txt', which tells what its records are of, is damaged", "say --force"),
}


@pytest.mark.parametrize("mark, found, advice", RECORDS.values(), ids=RECORDS)
def test_a_checkpoint_that_cannot_be_used(blame, folder, monkeypatch, mark, found, advice):
    from dashpot.fit.study import run
    from dashpot.fit.study.checkpoint import Checkpoint

    def interrupted(*_, **__):
        raise KeyboardInterrupt

    output = "damaged" if mark else "another"
    with monkeypatch.context() as patched:
        patched.setattr(run, "search", interrupted)
        assert blame(f"study x.yaml -o {output}", "x.yaml", STUDY + STAGES + MODELS)[0] == 3
    records = folder / output / "checkpoint"
    assert (records / "study.txt").is_file()
    if mark is None:
        Checkpoint(records).discard()
        Checkpoint(records).open("another")
    else:
        (records / "study.txt").write_bytes(mark)
        (records / "a.json").write_text("{}")
    check_parts(*blame(f"study x.yaml -o {output}"), "checkpoint", found, advice)
    assert blame(f"study x.yaml -o {output} --force --quiet")[0] == 0
    assert json.loads((folder / output / "study.json").read_text())["format"].startswith("dashpot-study")

"""What a diagnosis tells is what its files say, and held-out runs decide nothing."""

from __future__ import annotations

import json
import re
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from unit.diagnose.rig import (
    MOTIONS,
    NETWORK,
    SAMPLES,
    STEP,
    TIME,
    Motion,
    dataset,
    friction,
    line,
    plain,
    relaxation,
    with_force,
    write,
)

from dashpot.cli import main
from dashpot.contract.registry import load_registry
from dashpot.data.dataset import read_dataset

WARM_UP = 0.15  # of a sweep is not judged
HELD_OUT = "a1_p8"
PICTURES = (
    "Force over velocity at mid stroke",
    "Force over deflection at low speed",
    "Stiffness after reversals",
    "By amplitude, preload, setting and order",
    "Loss stiffness over time",
    "Residual of simulated before",
    "Explainable: RMSE of a general model",
)
AGAIN = {"again": "a3_p8"}


def gap(motion):
    """A stop beyond 12 mm (n,) N."""
    return 80e3 * np.maximum(motion.x() - 12e-3, 0.0)


def hum(size):
    return {name: lambda force, phase=number: force + line(50.0, size, phase) for number, name in enumerate(MOTIONS)}


LAWS = {
    "friction": friction,
    "relaxation": relaxation,
    "delay": lambda motion: 3.0 * (plain(motion, TIME - 4e-3) - plain(motion)),
    "end_stop": gap,
    "moving_mass": lambda motion: 3.0 * np.gradient(motion.v(), STEP),
    "quadratic_damping": lambda motion: 1500.0 * motion.v() * np.abs(motion.v()),
    "stiffness_curve": lambda motion: 1.5e8 * (motion.x() - 8e-3) ** 3 / 8e-3,
}
FAULTS = {
    "nothing": {},
    "gain": {"repeats": AGAIN, "fault": {"again": lambda force: 1.04 * force}},
    "hum": {"fault": hum(25.0)},
    "clipping": {"fault": dict.fromkeys(MOTIONS, lambda force: np.minimum(force, 2500.0))},
    "offset": {"repeats": AGAIN, "fault": {"again": lambda force: force + 25.0}},
    "drift": {"repeats": AGAIN, "fault": {"again": lambda force: force + np.linspace(0.0, 60.0, SAMPLES)}},
}


def measured(*words):
    """A dataset with laws and faults, one run held out."""
    laws = [LAWS[word] for word in words if word in LAWS]
    options = {"repeats": {}, "fault": {}}
    for word in words:
        for key, value in FAULTS.get(word, {}).items():
            options[key] = {**options[key], **value}
    return dataset(lambda motion: plain(motion) + sum(law(motion) for law in laws), held_out=(HELD_OUT,), **options)


def diagnosed(data, folder, *options):
    """The folder of a diagnosis by the command."""
    path = write(data, folder / "data")
    (folder / "plain.yaml").write_text(NETWORK)
    code = main(["diagnose", str(folder / "plain.yaml"), str(path), "-o", str(folder / "out"), "--quiet", *options])
    assert code == 0
    return folder / "out"


def errors(network, data, folder, held_out, aside=()):
    """RMSE of training runs and of ``held_out`` runs by `dashpot simulate` and the forces as they are read.

    Without the runs that were set ``aside``.
    """
    assert main(["simulate", str(network), "--data", str(data), "-o", str(folder), "--quiet", "--force"]) == 0
    runs = read_dataset(data, {word: reader() for word, reader in load_registry().formats.items()}).runs
    found = {True: [], False: []}
    for run in (run for run in runs if run.name not in aside):
        force = np.genfromtxt(folder / f"{run.name}.csv", delimiter=",", skip_header=2)[:, 2]
        first = int(round(WARM_UP * SAMPLES))
        found[run.name in held_out].append(np.mean((run.force - force)[first:] ** 2))
    return {"train": np.sqrt(np.mean(found[False])), "held_out": np.sqrt(np.mean(found[True]))}


@pytest.fixture(scope="module")
def folder_of(tmp_path_factory):
    """The folder with a dataset of laws and faults in ``data`` and its diagnosis in ``out``, made once."""

    @cache
    def made(words):
        folder = tmp_path_factory.mktemp("_".join(words))
        diagnosed(measured(*words), folder, "--jobs", "2")
        return folder

    return made


def assert_files_hold(folder, tmp_path):
    out = folder / "out"
    told = json.loads((out / "diagnosis.json").read_text())
    plain_data = folder / "data" / "dataset.yaml"
    corrected = out / told["corrected_dataset"] if told["corrected_dataset"] else plain_data
    assert corrected.exists()
    kept = read_dataset(corrected, {word: reader() for word, reader in load_registry().formats.items()}).runs
    aside = {fault["run"] for fault in told["faults"]} - {run.name for run in kept}
    before = errors(out / told["fitted_model"], plain_data, tmp_path / "before", told["held_out"], aside)
    final = out / (told["extended_model"] or told["fitted_model"])
    after = errors(final, corrected, tmp_path / "after", told["held_out"])
    for found, said in ((before, told["rmse"]["before"]), (after, told["rmse"]["after"])):
        assert found == pytest.approx(said, rel=1e-6)
    kinds = {word: cause.kind for word, cause in load_registry().causes.items()}
    for cause in told["causes"]:
        beside = [{"cause": word, "class": kinds.get(word)} for word in cause["indistinguishable_from"]]
        assert cause["rivals"] == beside
    return told


@pytest.mark.parametrize("word", ["nothing", "friction", "relaxation", "delay", "clipping", "gain", "hum"])
def test_the_files_say_what_is_told(word, folder_of, tmp_path):
    out = folder_of((word,)) / "out"
    told = assert_files_hold(out.parent, tmp_path)
    report = (out / "report.html").read_text(encoding="utf-8")
    assert all(picture in report for picture in PICTURES) and told["explainable"]["held_out"] > 0.0
    if word == "nothing":
        assert told["causes"] == []
    elif word not in ("delay", "clipping"):  # which other causes may imitate in six short runs
        assert [cause["cause"] for cause in told["causes"]] == [word]
    if told["corrected_dataset"] is None:
        assert not (out / "dataset.yaml").exists()


EVERY = [word for word in (*LAWS, *FAULTS) if word != "nothing"]


@pytest.mark.slow
@pytest.mark.parametrize("words", [*((word,) for word in EVERY), *combinations(EVERY, 2)], ids="+".join)
def test_the_files_say_what_is_told_of_every_cause_and_pair(words, folder_of, tmp_path):
    assert_files_hold(folder_of(words), tmp_path)


@pytest.mark.parametrize("words", [("friction",), ("gain",), ("nothing",)], ids="+".join)
def test_held_out_runs_decide_nothing(words, folder_of, tmp_path):
    """Their forces are replaced by noise: names, numbers and files stay, only the errors there are others."""
    noise = 500.0 * np.random.default_rng(9).standard_normal(SAMPLES)
    replaced = diagnosed(with_force(measured(*words), {HELD_OUT: noise}), tmp_path)
    outs = [folder_of(words) / "out", replaced]
    one, other = (json.loads((out / "diagnosis.json").read_text()) for out in outs)
    assert any(HELD_OUT in remark for remark in other["remarks"])  # it stands out, and is told
    one, other = without_held_out(one), without_held_out(other)
    assert one == other
    names = [sorted(path.name for path in out.glob("*.yaml")) for out in outs]
    assert names[0] == names[1]
    for name in names[0]:
        assert text_of(outs[0] / name) == text_of(outs[1] / name)


def without_held_out(told):
    """The result without what is measured on held-out runs, and without the digest of the data."""
    for pair in told["rmse"].values():
        del pair["held_out"]
    del told["dataset"]["digest"], told["explainable"]["held_out"], told["explainable"]["per_run"][HELD_OUT]
    told["remarks"] = [remark for remark in told["remarks"] if "held-out" not in remark]
    for cause in told["causes"]:
        for key in ("gain", "gain_interval", "removal"):
            del cause[key]
    return told


def text_of(path):
    """A file without the record of its data."""
    return re.sub(r"^#?.*\b(data|digest)\b.*$", "", path.read_text(), flags=re.MULTILINE)


def test_forks_change_nothing(folder_of, tmp_path):
    words = ("friction", "quadratic_damping")
    alone = diagnosed(measured(*words), tmp_path, "--jobs", "1") / "diagnosis.json"
    assert json.loads(alone.read_text()) == json.loads((folder_of(words) / "out" / "diagnosis.json").read_text())


def test_motions_are_what_they_are_called():
    assert isinstance(MOTIONS[HELD_OUT], Motion) and MOTIONS[HELD_OUT].preload == 8e-3

"""What a diagnosis tells is what its files say, and held-out runs decide nothing."""

from __future__ import annotations

import json
import re
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from unit.diagnose.files import assert_files_hold, diagnosed
from unit.diagnose.laws import CASES, Case
from unit.diagnose.rig import MOTIONS, SAMPLES, Motion, dataset, plain, with_force

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
WORDS = ("friction", "relaxation", "delay", "end_stop", "moving_mass", "quadratic_damping", "stiffness_curve")
LAWS = {word: CASES[word].law for word in WORDS}
FAULTS = {"nothing": Case()} | {word: CASES[word] for word in ("gain", "hum", "clipping", "offset", "drift")}


def measured(*words):
    """A dataset with laws and faults, one run held out."""
    laws = [LAWS[word] for word in words if word in LAWS]
    faults = [FAULTS[word] for word in words if word in FAULTS]
    return dataset(
        lambda motion: plain(motion) + sum(law(motion) for law in laws),
        held_out=(HELD_OUT,),
        repeats={again: first for fault in faults for again, first in (fault.repeats or {}).items()},
        fault={run: seen for fault in faults for run, seen in (fault.fault or {}).items()},
    )


@pytest.fixture(scope="module")
def folder_of(tmp_path_factory):
    """The folder with a dataset of laws and faults in ``data`` and its diagnosis in ``out``, made once."""

    @cache
    def made(words):
        folder = tmp_path_factory.mktemp("_".join(words))
        diagnosed(measured(*words), folder, "--jobs", "2")
        return folder

    return made


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
        assert not list(out.glob("dataset*.yaml"))


def test_the_error_before_is_that_of_a_file_where_triage_and_diagnosis_correct_runs(tmp_path):
    """One run is told in mN, another one has a gain: the first is right before, both are after."""
    gain = CASES["gain"]
    faulty = {**gain.fault, "a3_p5": lambda force: 1e3 * force}
    out = diagnosed(dataset(held_out=(HELD_OUT,), repeats=gain.repeats, fault=faulty), tmp_path)
    told = assert_files_hold(out.parent, tmp_path)
    assert [fault["run"] for fault in told["faults"]] == ["a3_p5"]
    assert (told["triaged_dataset"], told["corrected_dataset"]) == ("dataset.triage.yaml", "dataset.yaml")
    assert told["rmse"]["after"]["train"] < 0.5 * told["rmse"]["before"]["train"]


EVERY = [word for word in (*LAWS, *FAULTS) if word != "nothing"]


@pytest.mark.slow
@pytest.mark.parametrize("words", list(combinations(EVERY, 2)), ids="+".join)
def test_the_files_say_what_is_told_of_every_pair(words, folder_of, tmp_path):
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

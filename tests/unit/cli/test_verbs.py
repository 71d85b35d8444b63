"""A verb hands on what it was given, writes its files and tells the result; it does no work of its own."""

from __future__ import annotations

import json
import sys

import pytest

VERBS = {
    "fit": (["fit", "spring", "bench.yaml"], {"fit.json", "numbers.csv", "knots.csv", "spring.yaml", "report.html"}),
    "compare": (
        ["compare", "spring", "bench.yaml"],
        {"compare.json", "compare.csv", "report.html"},
    ),
    "diagnose": (
        ["diagnose", "spring", "bench.yaml"],
        {"diagnosis.json", "spring.yaml", "spring+more.yaml", "report.html"},
    ),
}
every_verb = pytest.mark.parametrize("arguments, files", VERBS.values(), ids=VERBS)


@every_verb
def test_all_results_are_written_and_named(call, layers, tmp_path, arguments, files):
    code, out, _ = call(*arguments, "-o", tmp_path / "out")
    assert code == 0
    assert {path.name for path in (tmp_path / "out").iterdir()} == files
    assert str(tmp_path / "out") in out


@every_verb
def test_the_switches_reach_the_work(call, layers, tmp_path, registry, arguments, files):
    more = ["--seed", 7, "--jobs", 3, "--optimizer", "swarm", "--set", "particles=5"]
    assert call(*arguments, "-o", tmp_path, *more)[0] == 0
    [asked] = layers
    assert asked["seed"] == 7 and asked["jobs"] == 3
    assert asked["optimizer"] == "swarm" and asked["options"] == {"particles": 5}
    assert asked["registry"] is registry


@every_verb
def test_json_stands_alone_on_standard_output(call, layers, tmp_path, arguments, files):
    code, out, error = call(*arguments, "-o", tmp_path, "--json")
    assert code == 0
    assert json.loads(out)["noise_floor"]["value"] == 0.5
    assert str(tmp_path) in error


@every_verb
def test_quiet_says_nothing_but_warnings(call, layers, tmp_path, arguments, files):
    code, out, error = call(*arguments, "-o", tmp_path, "--quiet")
    assert (code, out) == (0, "")
    assert all(line.startswith("warning: ") for line in error.splitlines())
    assert "warning: a.csv: set aside\n" in error


@every_verb
def test_a_second_run_overwrites_nothing_and_does_no_work(call, layers, tmp_path, arguments, files):
    call(*arguments, "-o", tmp_path)
    layers.clear()
    code, _, error = call(*arguments, "-o", tmp_path)
    assert code == 1
    assert layers == []
    for name in files:
        assert f"{tmp_path / name}: exists already. choose another -o, or say --force" in error


@every_verb
def test_force_overwrites(call, layers, tmp_path, arguments, files):
    call(*arguments, "-o", tmp_path)
    for name in files:
        (tmp_path / name).write_text("old")
    assert call(*arguments, "-o", tmp_path, "--force")[0] == 0
    assert all((tmp_path / name).read_text() != "old" for name in files)


def test_a_comparison_keeps_the_order_of_the_networks(call, layers, tmp_path):
    assert call("compare", "b", "c", "a", "bench.yaml", "-o", tmp_path)[0] == 0
    assert [network.name for network in layers[0]["subject"]] == ["b", "c", "a"]


def test_data_says_the_same_as_the_last_argument(call, layers, tmp_path):
    assert call("compare", "b", "--data", "bench.yaml", "-o", tmp_path / "one")[0] == 0
    assert call("compare", "b", "bench.yaml", "-o", tmp_path / "two")[0] == 0
    assert call("fit", "b", "--data", "bench.yaml", "-o", tmp_path / "three")[0] == 0
    first, second, third = layers
    assert first["dataset"] == second["dataset"] == third["dataset"]
    assert [network.name for network in first["subject"]] == [third["subject"].name] == ["b"]


def test_a_diagnosis_without_an_extension_writes_one_network(call, layers, fake_result, tmp_path, monkeypatch):
    monkeypatch.setattr(fake_result, "extended_text", None)
    assert call("diagnose", "spring", "bench.yaml", "-o", tmp_path)[0] == 0
    assert {path.name for path in tmp_path.iterdir()} == {"diagnosis.json", "spring.yaml", "report.html"}


def test_remarks_stand_behind_the_verdict(call, layers, fake_result, tmp_path, monkeypatch):
    remark = "The held-out run 'b' has a fault."
    monkeypatch.setattr(fake_result, "remarks", (remark,))
    _, out, _ = call("diagnose", "spring", "bench.yaml", "-o", tmp_path / "a")
    lines = out.splitlines()
    assert "no known cause fits" in lines[lines.index(remark) - 1]
    _, out, _ = call("diagnose", "spring", "bench.yaml", "-o", tmp_path / "b", "--quiet")
    assert remark not in out


def test_ctrl_c_keeps_what_was_there_and_says_so(call, layers, tmp_path, monkeypatch):
    def interrupt(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(sys.modules["dashpot.compare.comparison"], "compare", interrupt)
    (tmp_path / "mine.txt").write_text("kept")
    code, _, error = call("compare", "spring", "--data", "bench.yaml", "-o", tmp_path)
    assert code == 3
    assert error.endswith("interrupted; the same command goes on\n")
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_a_diagnosis_says_that_its_files_were_read_again(call, layers, tmp_path):
    _, out, error = call("diagnose", "spring", "bench.yaml", "-o", tmp_path)
    assert "check: as told" in out + error

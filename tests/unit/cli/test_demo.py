"""The demonstration measures a specimen once, compares and diagnoses, and ends with the reports to open."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from dashpot import Specimen
from dashpot.cli.output import OutputFolder
from dashpot.contract import registry as registry_module


class Sponge(Specimen):
    """A specimen that is quickly measured."""

    word = "sponge"
    about = "softer than it looks"
    demo = True
    networks = ("spring", "gehmann")
    suspect = "spring"
    measured: list = []

    def measure(self, folder, seed):
        self.measured.append((folder, seed))
        return folder / "dataset.yaml"


class Shy(Sponge):
    word = "shy"
    demo = False


@pytest.fixture
def sponge(monkeypatch, layers, registry):
    offered = replace(registry, specimens={"shy": Shy, "sponge": Sponge})
    monkeypatch.setattr(registry_module, "load_registry", lambda: offered)
    monkeypatch.setattr(Sponge, "measured", [])
    return Sponge


def test_the_whole_story_ends_with_two_reports(call, sponge, layers, tmp_path):
    code, out, _ = call("demo", "-o", tmp_path, "--seed", 4)
    assert code == 0
    assert sponge.measured == [(tmp_path / "data" / "sponge-4", 4)]
    assert [asked["work"] for asked in layers] == ["compare", "diagnose"]
    assert [network.name for network in layers[0]["subject"]] == ["spring", "gehmann"]
    assert layers[1]["subject"].name == "spring"
    reports = [tmp_path / "comparison" / "report.html", tmp_path / "diagnosis" / "report.html"]
    assert out.split()[-2:] == [str(report) for report in reports]
    assert all(report.is_file() for report in reports)


def test_the_story_tells_the_remarks_of_the_diagnosis(call, sponge, fake_result, tmp_path, monkeypatch):
    monkeypatch.setattr(fake_result, "remarks", ("The held-out run 'b' has a fault.",))
    assert "The held-out run 'b' has a fault.\n" in call("demo", "-o", tmp_path)[1]


def test_the_result_as_json_holds_both_answers(call, sponge, tmp_path):
    code, out, _ = call("demo", "-o", tmp_path, "--json")
    assert code == 0
    assert set(json.loads(out)) == {"format", "comparison", "diagnosis"}


def test_a_second_demonstration_needs_force(call, sponge, tmp_path):
    assert call("demo", "-o", tmp_path)[0] == 0
    assert call("demo", "-o", tmp_path)[0] == 1
    assert call("demo", "-o", tmp_path, "--force")[0] == 0


def test_a_folder_into_which_another_call_writes_is_refused_before_anything_is_measured(call, sponge, tmp_path):
    with OutputFolder(tmp_path / "out", force=False).locked():
        code, _, error = call("demo", "-o", tmp_path / "out", "--force")
    assert code == 1
    assert "out: another call of dashpot is writing into this folder. wait for its end, or choose another -o" in error
    assert sponge.measured == [] and list((tmp_path / "out").iterdir()) == []
    assert call("demo", "-o", tmp_path / "out")[0] == 0


@pytest.mark.parametrize(
    "word, hint",
    [("spong", "No specimen 'spong' to demonstrate with, did you mean 'sponge'?"), ("shy", "there are: sponge")],
)
def test_a_specimen_that_is_not_offered_is_refused(call, sponge, tmp_path, word, hint):
    code, _, error = call("demo", "-o", tmp_path, "--specimen", word)
    assert code == 2
    assert hint in error


def test_without_any_specimen_that_is_said(call, layers, tmp_path):
    code, _, error = call("demo", "-o", tmp_path)
    assert code == 2
    assert "No plugin gives a specimen" in error

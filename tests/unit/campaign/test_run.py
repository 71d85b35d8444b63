"""Jobs are done once, anywhere, to the same bytes; what fails is set aside."""

from __future__ import annotations

import json
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from types import SimpleNamespace

import pytest
from unit.campaign.bushings import CAMPAIGN, draw_population, write_population

from dashpot import load_registry
from dashpot.campaign import preview as preview_module
from dashpot.campaign import run as run_module
from dashpot.campaign.address import at_hand, state_of
from dashpot.campaign.content import campaign_content
from dashpot.campaign.declaration import CampaignSpec
from dashpot.campaign.preview import preview_campaign, preview_content, preview_text
from dashpot.campaign.reading import read_campaign
from dashpot.campaign.run import run_campaign
from dashpot.data.dataset import read_dataset
from dashpot.fit.api import fit_network
from dashpot.model.reading import read_network
from dashpot.report.json_text import json_text
from dashpot.text.problem import InputError

FEW = 3


@pytest.fixture
def campaign(tmp_path) -> CampaignSpec:
    return read_campaign(write_population(tmp_path / "few", draw_population(1, FEW, {}), 1), load_registry())


def text_of(campaign: CampaignSpec, **options) -> str:
    return json_text(campaign_content(run_campaign(campaign, **options)))


def test_the_result_is_the_same_everywhere(campaign):
    here = text_of(campaign)
    with ThreadPoolExecutor(2) as pool:
        assert text_of(campaign, jobs=pool) == here
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        assert text_of(campaign, jobs=pool) == here


def test_the_numbers_are_those_of_a_fit_of_the_specimen_alone(campaign):
    [outcome, *_] = run_campaign(campaign).outcomes.values()
    registry = load_registry()
    readers = {word: reader() for word, reader in registry.formats.items()}
    dataset = read_dataset(campaign.specimens[0].data, readers)
    alone = fit_network(campaign.models[0], dataset, registry=registry)
    slots = {slot.path: slot.value for slot in alone.fitted.slots()}
    for path, number in outcome["models"][0]["numbers"].items():
        assert (number["value"], tuple(number["interval"])) == (slots[path].number, slots[path].interval)
    assert outcome["digest"] == dataset.digest


def test_what_is_recorded_is_not_done_again(campaign, tmp_path, monkeypatch):
    records = tmp_path / "records"
    first = text_of(campaign, checkpoint=records)
    monkeypatch.setattr(run_module, "run_job", lambda work, job: pytest.fail(f"{job.name} was done again"))
    assert text_of(campaign, checkpoint=records) == first


def test_a_specimen_whose_files_changed_is_done_again(campaign, tmp_path, monkeypatch):
    records, done = tmp_path / "records", []
    run_campaign(campaign, checkpoint=records)
    changed = Path(campaign.specimens[1].data) / "dataset.yaml"
    changed.write_text(changed.read_text().replace("name: bushing", "name: measured again"))
    real = run_module.run_job
    monkeypatch.setattr(run_module, "run_job", lambda work, job: done.append(job.specimen) or real(work, job))
    run_campaign(campaign, checkpoint=records)
    assert done == ["b01"]


def test_records_of_another_campaign_are_refused(campaign, tmp_path):
    run_campaign(campaign, checkpoint=tmp_path / "records")
    with pytest.raises(InputError, match="its records are of another study or campaign"):
        run_campaign(replace(campaign, seed=5), checkpoint=tmp_path / "records")


def test_a_job_that_fails_is_set_aside_and_tried_again(campaign, tmp_path):
    data, records = Path(campaign.specimens[2].data) / "dataset.yaml", tmp_path / "records"
    text = data.read_text()
    data.write_text(text.replace("column: F", "column: G"))
    found = run_campaign(campaign, checkpoint=records)
    [(job, reason)] = found.failures.items()
    assert job.specimen == "b02" and "'G'" in reason
    assert [one["specimen"] for one in campaign_content(found)["failures"]] == ["b02"]
    data.write_text(text)
    assert not run_campaign(campaign, checkpoint=records).failures


def test_a_model_that_a_comparison_could_not_fit_is_told(campaign):
    found = run_campaign(replace(campaign, specimens=campaign.specimens[:1], verbs=("compare",)))
    [(job, outcome)] = found.outcomes.items()
    told = replace(found, outcomes={job: {**outcome, "failures": {"other": "lacks a setting"}}})
    assert campaign_content(told)["failures"] == [
        {"job": "b00-compare", "specimen": "b00", "reason": "other: lacks a setting"}
    ]


def test_numbers_in_common_are_held_in_a_second_fit(tmp_path):
    text = CAMPAIGN + "shared: slow.*\n"
    campaign = read_campaign(write_population(tmp_path / "few", draw_population(1, FEW, {}), 1, text), load_registry())
    content = campaign_content(run_campaign(campaign, checkpoint=tmp_path / "records"))
    shared = content["populations"][0]["shared"]
    assert set(shared["numbers"]) == {"slow.stiffness", "slow.relaxation_time"}
    assert all(set(one["numbers"]) == {"rubber.stiffness"} for one in shared["specimens"].values())
    # these bushings scatter by far more than each is known to
    assert shared["probability"] < 1e-6 and shared["error_ratio"] > 1.0


def test_the_progress_ends_at_the_whole(campaign):
    told = []
    run_campaign(campaign, progress=lambda stage, done: told.append((stage, done)))
    assert told == [("jobs", k / FEW) for k in range(1, FEW + 1)]


def test_a_preview_does_one_job_of_each_kind(campaign):
    both = replace(campaign, verbs=("fit", "compare"))
    costs = preview_campaign(both)
    assert [(cost.job.verb, cost.count) for cost in costs] == [("fit", FEW), ("compare", FEW)]
    content = preview_content(both, costs, 2)
    assert content["seconds"] == pytest.approx(sum(FEW * cost.seconds for cost in costs) / 2.0)
    assert "3 specimens, 6 jobs" in preview_text(content)
    assert all(cost.result < 20_000 and not cost.failed for cost in costs)


def test_a_preview_counts_the_reports_that_will_be_written(campaign):
    written = []
    preview_campaign(campaign, write=lambda found, job, registry: written.append(job))
    preview_campaign(replace(campaign, reports=False), write=lambda *_: pytest.fail("no report is asked for"))
    assert set(written) == {"b00-fit-solid"}


@pytest.mark.parametrize(("spent", "told"), [([4.0, 0.25], 0.25), ([90.0], 90.0)])
def test_what_a_process_does_once_is_no_cost_of_each_job(monkeypatch, spent, told):
    # clock readings before and after each job; a long one is not done twice
    readings = iter([reading for each in spent for reading in (10.0, 10.0 + each)])
    monkeypatch.setattr(preview_module, "time", SimpleNamespace(perf_counter=lambda: next(readings)))
    monkeypatch.setattr(preview_module, "run_job", lambda work, job: {})
    assert preview_module.timed_job(None, None)[1] == told
    assert next(readings, None) is None


def test_a_diagnosis_tells_its_causes_by_specimen(campaign):
    one = replace(
        campaign,
        specimens=campaign.specimens[:1],
        verbs=("diagnose",),
        models=(read_network("kelvin_voigt", load_registry().elements),),
    )
    content = campaign_content(run_campaign(one))
    assert content["specimens"][0]["verdicts"].keys() == {"kelvin_voigt"}
    assert all(set(cause["probability"]) == {"b00"} for cause in content["causes"])


def test_data_at_an_address_are_read_as_if_they_lay_here(campaign):
    fsspec = pytest.importorskip("fsspec", reason="the extra cluster is not installed")
    memory = fsspec.filesystem("memory")
    for one in campaign.specimens:
        memory.put(one.data, f"/rig/{one.name}", recursive=True)
    there = replace(
        campaign, specimens=tuple(replace(one, data=f"memory://rig/{one.name}") for one in campaign.specimens)
    )
    numbers = [[outcome["models"] for outcome in run_campaign(each).outcomes.values()] for each in (campaign, there)]
    assert numbers[0] == numbers[1]
    before = state_of("memory://rig/b00")
    memory.pipe_file("/rig/b00/dataset.yaml", b"format: dashpot-dataset/1\n")
    assert state_of("memory://rig/b00") != before
    with at_hand("memory://rig/b00/dataset.yaml") as path:
        assert path.read_text() == "format: dashpot-dataset/1\n" and (path.parent / "r0.npz").exists()
    assert not path.exists()


def test_an_address_that_cannot_be_reached_is_told():
    pytest.importorskip("fsspec", reason="the extra cluster is not installed")
    with pytest.raises(InputError, match="the data cannot be fetched"), at_hand("nowhere://x"):
        pass
    assert state_of("nowhere://x") is None


def test_a_result_is_small(campaign):
    for outcome in run_campaign(campaign).outcomes.values():
        assert len(json.dumps(outcome)) < 4_000

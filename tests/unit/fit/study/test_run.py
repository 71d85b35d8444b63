"""Studies on runs of known truth: stages, what is carried over, weights, hold-out, resumption."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.cli.results import told_of_models
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.replay import Block
from dashpot.fit.study import run as conduct
from dashpot.fit.study.checkpoint import Checkpoint
from dashpot.fit.study.preview import preview_study
from dashpot.fit.study.reading import parse_study
from dashpot.fit.study.run import run_study
from dashpot.fit.study.stage import StageResult
from dashpot.report.page import render
from dashpot.report.study import study_page
from dashpot.study.study import study_content, study_evidence
from dashpot.text.document import Document
from dashpot.text.problem import InputError

TIME = 1e-3 * np.arange(1200)
NETWORKS = {
    "one": "rubber: {element: spring, stiffness: {start: 150 N/mm}}\n",
    "two": "rubber: {element: spring, stiffness: {start: 100 N/mm}}\n"
    "  oil: {element: damper, damping: {start: 900 N*s/m}}\n",
}
SPRING, DAMPING = 2e5, 300.0


def sine(
    name: str, frequency: float, noise: float = 2.0, spring: float = SPRING, seed: int = 3, damping: float = DAMPING
) -> Run:
    omega, rng = 2.0 * np.pi * frequency, np.random.default_rng([seed, round(10 * frequency)])
    x, v = 1e-3 * np.sin(omega * TIME), 1e-3 * omega * np.cos(omega * TIME)
    force = spring * x + damping * v + noise * rng.standard_normal(TIME.size)
    return Run(name, "harmonic", TIME, {"displacement": x, "force": force}, group=name)


DATA = Dataset("bench", tuple(sine(f"f{f}", float(f)) for f in (2, 5, 9, 14)))


@pytest.fixture
def study(tmp_path):
    for name, branches in NETWORKS.items():
        (tmp_path / f"{name}.yaml").write_text(f"format: dashpot-network/1\nname: {name}\nbranches:\n  {branches}")

    def parsed(text: str):
        document = Document.parse(f"format: dashpot-study/1\nname: s\ndata: d\n{text}", "s.yaml")
        return parse_study(document, tmp_path, load_registry())

    return parsed


def numbers(result, model=0):
    return {slot.path: slot.value.number for slot in result.models[model].fit.fitted.slots()}


def run(made, data=DATA, **more):
    return run_study(made, data, registry=load_registry(), **more)


def test_a_stage_moves_only_what_it_frees(study):
    made = study("stages: [{name: a, free: 'oil.*'}]\nmodels: [two.yaml]\n")
    found = run(made)
    assert numbers(found)["rubber.stiffness"] == 1e5
    assert found.models[0].stages[0].free == ("oil.damping",)
    made = study("stages: [{name: a, fixed: 'oil.*'}]\nmodels: [two.yaml]\n")
    assert numbers(run(made))["oil.damping"] == 900.0


@pytest.mark.parametrize("optimizer", ["gauss_newton", "least_squares", "pso+least_squares"])
def test_the_truth_is_found_within_its_intervals(study, optimizer):
    made = study(f"stages: [{{name: a, optimizer: {optimizer}, budget: 3000}}]\nmodels: [two.yaml]\n")
    fit = run(made).models[0].fit
    for slot in fit.fitted.slots():
        truth = SPRING if slot.path.startswith("rubber") else DAMPING
        # the interval is 95 %: three of its half widths are a matter of one in a hundred million
        assert abs(slot.value.number - truth) < 1.5 * np.ptp(slot.value.interval)
    assert fit.evaluations <= 3000


def test_numbers_are_carried_over_by_path(study):
    made = study(
        "stages: [{name: a}]\nmodels: [one.yaml, {network: two.yaml, start_from: one, "
        "stages: [{name: b, free: 'oil.*'}]}]\n"
    )
    found = run(made)
    assert numbers(found, 1)["rubber.stiffness"] == numbers(found, 0)["rubber.stiffness"] != 1e5


def test_runs_of_greater_weight_pull_harder(study):
    # two runs of different stiffness: the least squares estimate is their mean, weighted
    data = Dataset("bench", (sine("soft", 5.0, 0.0, 1e5), sine("hard", 5.0, 0.0, 3e5)))
    text = "stages: [{name: a, budget: 500}]\nmodels: [two.yaml]\n"
    assert numbers(run(study(text), data))["rubber.stiffness"] == pytest.approx(2e5, rel=1e-3)
    weighted = run(study("weights: {hard: 3}\n" + text), data)
    assert numbers(weighted)["rubber.stiffness"] == pytest.approx(2.5e5, rel=1e-3)


def test_held_out_runs_do_not_train(study):
    found = run(study("hold_out: ['f9', 'f1*']\nstages: [{name: a}]\nmodels: [two.yaml]\n"))
    assert found.setting.split.held_out == ("f9", "f14") and found.setting.split.train == ("f2", "f5")


@pytest.mark.parametrize("text", ["hold_out: 'g*'\n", "weights: {g1: 2}\n"])
def test_a_pattern_that_names_no_run_is_told(study, text):
    with pytest.raises(InputError, match="no run is called 'g"):
        run(study(text + "stages: [{name: a}]\nmodels: [one.yaml]\n"))


def test_of_several_patterns_some_may_name_nothing_but_names_must_be_those_of_runs(study):
    stages = "stages: [{name: a}]\nmodels: [two.yaml]\n"
    assert run(study("hold_out: ['f9*', 'g*']\n" + stages)).setting.split.held_out == ("f9",)
    with pytest.raises(InputError, match="no run is called 'g1'"):
        run(study("hold_out: ['f9*', 'g1']\n" + stages))


def test_the_budget_holds_for_every_method(study):
    for optimizer, starts in (("pso", 1), ("pso+least_squares", 2), ("least_squares", 1), ("gauss_newton", 3)):
        made = study(
            f"stages: [{{name: a, optimizer: {optimizer}, budget: 150, starts: {starts}}}]\nmodels: [two.yaml]\n"
        )
        assert 0 < run(made).models[0].stages[0].evaluations <= 150


def test_several_starts_tell_how_well_they_agree(study):
    stage = run(study("stages: [{name: a, optimizer: least_squares, starts: 3, budget: 900}]\nmodels: [two.yaml]\n"))
    spread = stage.models[0].stages[0].spread
    assert len(spread) == 3 and spread[-1] == pytest.approx(spread[0], rel=1e-6)


class Cut(Exception):
    """The power is gone."""


def test_an_interrupted_study_goes_on_to_the_same_bits(study, tmp_path, monkeypatch):
    made = study(
        "stages: [{name: a, optimizer: pso+least_squares, budget: 1500, options: {pso.particles: 12}}, {name: b}]\n"
        "models: [one.yaml, {network: two.yaml, start_from: one}]\n"
    )
    whole, folder = run(made), tmp_path / "records"
    original = conduct.search.__globals__["Objective"].losses

    for lifetime in (9, 40, 25):
        left = [lifetime]

        def losses(self, values, left=left):
            left[0] -= 1
            if left[0] < 0:
                raise Cut
            return original(self, values)

        monkeypatch.setattr(conduct.search.__globals__["Objective"], "losses", losses)
        with pytest.raises(Cut):
            run(made, checkpoint=folder)
        for torn in folder.glob("*.blocks"):
            torn.write_bytes(torn.read_bytes() + b"\x93NUMPY half a block")
    monkeypatch.undo()
    resumed = run(made, checkpoint=folder, jobs=2)
    for model, other in zip(whole.models, resumed.models, strict=True):
        assert model.fit.as_dict() == other.fit.as_dict()
        assert model.stages == other.stages


@pytest.mark.parametrize("place", [3, 60, -400, -3])
def test_a_block_that_the_disk_has_spoilt_is_evaluated_again(tmp_path, place):
    blocks = [Block(np.random.default_rng(seed).random((4, 3)), np.full(4, seed)) for seed in range(5)]
    record = Checkpoint(tmp_path).stage("a")
    for block in blocks:
        record.keep(block)
    record.close()
    file = tmp_path / "a.blocks"
    content = bytearray(file.read_bytes())
    size = len(content) // 5
    assert len(Checkpoint(tmp_path).stage("a").blocks()) == 5
    content[place] ^= 1
    file.write_bytes(content)
    found = Checkpoint(tmp_path).stage("a").blocks()
    assert len(found) == (place % len(content)) // size
    for block, kept in zip(blocks, found, strict=False):
        assert block.points.tobytes() == kept.points.tobytes()
    assert file.stat().st_size == len(found) * size


def test_a_spoilt_result_of_a_search_is_found_again(study, tmp_path):
    made = study("stages: [{name: a, optimizer: pso, budget: 600}]\nmodels: [two.yaml]\n")
    first = run(made, checkpoint=tmp_path / "records")
    [result] = (tmp_path / "records").glob("*.json")
    result.write_text(result.read_text().replace('"evaluations": 6', '"evaluations": 7', 1))
    assert Checkpoint(tmp_path / "records").stage(result.stem).result() is None
    assert run(made, checkpoint=tmp_path / "records").models[0].stages == first.models[0].stages


def test_what_is_recorded_is_not_evaluated_again(study, tmp_path, monkeypatch):
    made = study("stages: [{name: a, optimizer: pso, budget: 600}]\nmodels: [two.yaml]\n")
    first = run(made, checkpoint=tmp_path / "records")
    monkeypatch.setattr("dashpot.fit.study.stage.run_search", None)
    assert run(made, checkpoint=tmp_path / "records").models[0].stages == first.models[0].stages


def test_the_records_of_another_study_are_refused(study, tmp_path):
    made = study("stages: [{name: a}]\nmodels: [one.yaml]\n")
    run(made, checkpoint=tmp_path / "records")
    with pytest.raises(InputError, match="of another study"):
        run(replace(made, seed=1), checkpoint=tmp_path / "records")


def test_records_of_a_network_that_used_another_one_are_of_another_study(study, tmp_path):
    (tmp_path / "uses.yaml").write_text("format: dashpot-network/1\nname: uses\nbranches: {it: {use: one.yaml}}\n")
    asked = "stages: [{name: a}]\nmodels: [uses.yaml]\n"
    first = run(study(asked), checkpoint=tmp_path / "records")
    assert run(study(asked), checkpoint=tmp_path / "records").models[0].stages == first.models[0].stages
    below = tmp_path / "one.yaml"
    below.write_text(below.read_text().replace("150 N/mm", "150 N/mm, bounds: [1 N/mm, 160 N/mm]"))
    with pytest.raises(InputError, match="of another study"):
        run(study(asked), checkpoint=tmp_path / "records")


def test_bootstrap_and_profile_agree_with_the_intervals_where_the_model_is_true(study):
    data = Dataset("bench", tuple(sine(f"r{n}", 3.0 + 0.5 * n, 20.0, seed=n) for n in range(12)))
    made = study("bootstrap: 60\nprofiles: '*'\nhold_out: r0\nstages: [{name: a}]\nmodels: [two.yaml]\n")
    model = run(made, data).models[0]
    for slot in model.fit.fitted.slots():
        width = np.ptp(slot.value.interval)
        # eleven runs tell their scatter to a fifth, sixty draws their quantiles to a tenth
        assert np.ptp(model.bootstrap[slot.path]) == pytest.approx(width, rel=0.6)
        [profile] = [p for p in model.profiles if p.path == slot.path]
        assert profile.interval == pytest.approx(slot.value.interval, abs=0.03 * width)
        assert profile.open_ends == (False, False) and min(profile.losses) == pytest.approx(model.stages[0].loss)


def test_a_preview_names_what_these_data_cannot_tell(study, tmp_path):
    (tmp_path / "twins.yaml").write_text(
        "format: dashpot-network/1\nname: twins\nbranches:\n  a: {element: damper, damping: {start: 100 N*s/m}}\n"
        "  b: {element: damper, damping: {start: 200 N*s/m}}\n"
        "  rubber: {element: spring, stiffness: {start: 100 N/mm}}\n"
    )
    firm, twins = preview_study(study("stages: [{name: a}]\nmodels: [two.yaml, twins.yaml]\n"), DATA)
    assert firm.known.firm == ["rubber.stiffness", "oil.damping"] and not firm.known.sentences
    assert twins.known.firm == ["rubber.stiffness"]
    [sentence] = twins.known.sentences
    # d F = 100 da + 200 db: a falls by twice the share by which b rises
    assert "damping of a and damping of b trade off: +10 %, -5 %" in sentence


def test_a_model_uses_a_part_that_was_identified_before(study, tmp_path):
    (tmp_path / "rig.yaml").write_text(
        "format: dashpot-network/1\nname: rig\nnodes: {platform: driven, body: ground}\nbranches:\n"
        "  pad: {use: one.yaml, fixed: true, between: [platform, body]}  # a pad\n"
        "  oil: {element: damper, damping: {start: 900 N*s/m}, between: [platform, body]}\n"
    )
    result = run(
        study(
            "models:\n  - {network: one.yaml, stages: [{name: a}]}\n"
            "  - {network: rig.yaml, parts: {pad: one}, stages: [{name: b}]}\n"
        )
    )
    first, second = numbers(result), numbers(result, 1)
    assert second["pad.rubber.stiffness"] == pytest.approx(first["rubber.stiffness"], rel=1e-6)
    assert second["oil.damping"] == pytest.approx(DAMPING, rel=0.05)
    assert (
        "pad: {use: one.yaml, fixed: true, between: [platform, body]}  # a pad" in result.models[1].fit.identified_text
    )


def test_a_part_has_to_be_a_model_above_and_a_branch_that_uses_one(study):
    with pytest.raises(InputError, match="expected one of one, got 'two'"):
        study(
            "models:\n  - {network: one.yaml, stages: [{name: a}]}\n"
            "  - {network: two.yaml, parts: {oil: two}, stages: [{name: b}]}\n"
        )
    made = study(
        "models:\n  - {network: one.yaml, stages: [{name: a}]}\n"
        "  - {network: two.yaml, parts: {oil: one}, stages: [{name: b}]}\n"
    )
    with pytest.raises(InputError, match="no branch 'oil' uses another network"):
        run(made)


def test_a_model_is_fitted_to_its_own_runs(study):
    other = Dataset("bench", (*DATA.runs, sine("soft", 4.0, spring=1e5)))
    stages = "stages: [{name: a}]"
    made = study(
        f"hold_out: f9\nmodels:\n  - {{network: one.yaml, runs: [f2, f9], {stages}}}\n"
        f"  - {{network: two.yaml, runs: soft, {stages}}}\n"
    )
    result = run(made, other)
    assert set(result.models[0].fit.errors.per_run) == {"f2", "f9"} and set(result.models[1].fit.errors.per_run) == {
        "soft"
    }
    assert numbers(result, 1)["rubber.stiffness"] == pytest.approx(1e5, rel=0.01)
    with pytest.raises(InputError, match="the runs nothing leave 'one' none to train on"):
        run(study(f"models: [{{network: one.yaml, runs: nothing, {stages}}}]\n"))


def test_what_a_stage_left_unfinished_is_finished_by_a_later_one_that_searches_as_much():
    def stage(free: str, converged: bool) -> StageResult:
        ending = "converged" if converged else "the budget is spent"
        return StageResult("s", "", tuple(free), 1.0, 1, 0, ending, "", (1.0,), (), converged)

    assert conduct.ending_of((stage("ab", False), stage("abc", True))) == "converged"
    assert conduct.ending_of((stage("abc", False), stage("ab", True))) == "the budget is spent"
    assert conduct.ending_of((stage("ab", True), stage("ab", False))) == "the budget is spent"


def test_each_model_tells_the_branches_that_may_go_as_a_fit_does(study, tmp_path):
    # a spring and a damper made the forces; a slider beside them has nothing to explain
    (tmp_path / "three.yaml").write_text(
        "format: dashpot-network/1\nname: three\nbranches:\n  "
        + NETWORKS["two"]
        + "  rub: {element: dahl, stiffness: {start: 100 N/mm}, limit: {start: 20 N}}\n"
    )
    made = study("stages: [{name: all, free: '*'}]\nmodels: [two.yaml, three.yaml]\n")
    found = run(made)
    sentence = "rub may go: without it, all else refitted, these data are explained as well"
    assert [model.fit.spare for model in found.models] == [(), ("rub",)]
    content = study_content(found)
    assert [model["identifiability"]["may_go"] for model in content["models"]] == [[], [sentence]]
    assert told_of_models(content)[-1] == f"three: {sentence}"
    assert sentence in render(study_page(content, study_evidence(found)))


def test_what_a_stage_left_over_makes_no_branch_superfluous(study):
    # a damper of 30 N s/m, 40 times its standard error, hardly shows beside a stiffness that stays half of what it was
    data = Dataset("bench", tuple(sine(f"f{f}", float(f), damping=30.0) for f in (2, 5, 9, 14)))
    stages = "[{name: oil, free: oil.*}, {name: rubber, free: rubber.*, budget: 1}]"
    [model] = run(study(f"stages: {stages}\nmodels: [two.yaml]\n"), data).models
    assert model.fit.errors.train > 20.0  # N, of which 2 N are noise
    assert model.fit.spare == ()

"""Study files: what they may say, and all mistakes at once."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from dashpot import load_registry
from dashpot.fit.study.declaration import SearchStage, TakeStage
from dashpot.fit.study.patterns import chosen
from dashpot.fit.study.reading import find_study, parse_study, read_study, shipped_studies
from dashpot.study.sensitivity.reading import is_sensitivity
from dashpot.text.document import Document
from dashpot.text.problem import InputError

ROOT = Path(__file__).resolve().parents[4]


def study(text):
    return parse_study(
        Document.parse("format: dashpot-study/1\nname: s\n" + text, "s.yaml"), Path("."), load_registry()
    )


def test_brackets_of_a_path_mean_themselves():
    assert chosen("damping.scale[0]", ["*.scale*"]) and chosen("a.b[3]", ["a.b[?]"])
    assert not chosen("a.b0", ["a.b[0]"]) and not chosen("xa.b", ["a.b"])


def test_a_stage_without_its_own_words_has_the_defaults():
    made = study("data: d\nbudget: 77\nstages: [{name: a, take: curves}, {name: b}]\nmodels: [spring]\n")
    [model] = made.models
    assert model.stages[0] == TakeStage("a", "curves")
    assert model.stages[1] == SearchStage("b", ("*",), (), "all", "gauss_newton", {}, 77, 1)
    assert made.budget == 77


def test_options_come_in_the_types_of_the_optimizer():
    made = study(
        "data: d\nmodels: [spring]\nstages:\n"
        "  - {name: a, optimizer: pso+least_squares, options: {pso.particles: 8, least_squares.step: 1e-4}}\n"
    )
    assert made.models[0].stages[0].options == {"pso.particles": 8, "least_squares.step": 1e-4}


def test_all_mistakes_are_told_at_once():
    with pytest.raises(InputError) as caught:
        study(
            "data: {specimen: test_tyre}\nweights: {a: 0}\nstages: [{name: a, optimizer: psso}, {name: b, budget: 0},"
            " {name: c, take: all}, {name: d, options: {x: 1}},"
            " {name: e, optimizer: pso, options: {particles: many}}]\n"
            "models: [sprng, {network: spring, start_from: gehmann}]\nmore: 1\n"
        )
    said = str(caught.value)
    for part in (
        "did you mean 'test_tire'",
        "weights above 0",
        "did you mean 'pso'",
        "at least 1, got 0",
        "one of curves, ends",
        "has no options",
        "a whole number, got 'many'",
        "did you mean 'spring'",
        "expected one of",
        "no key 'more'",
    ):
        assert part in said, part


def test_a_model_may_start_only_from_one_before_it():
    with pytest.raises(InputError, match="start_from"):
        study("data: d\nstages: [{name: a}]\nmodels: [{network: gehmann, start_from: spring}, spring]\n")


def test_the_same_model_twice_and_a_model_without_stages_are_refused():
    with pytest.raises(InputError, match="two models are called 'spring'"):
        study("data: d\nstages: [{name: a}]\nmodels: [spring, spring]\n")
    with pytest.raises(InputError, match="'spring' has no stages"):
        study("data: d\nmodels: [spring]\n")


IDENTIFY = [name for name, path in shipped_studies().items() if not is_sensitivity(Document.read(path))]


@pytest.mark.parametrize("name", IDENTIFY)
def test_every_shipped_study_can_be_read(name):
    found = read_study(find_study(name), load_registry())
    assert found.name == name and found.about and found.models


def test_an_unknown_study_gets_the_nearest_name():
    with pytest.raises(InputError, match="did you mean 'paper_tire'"):
        find_study("papr_tire")


def test_the_study_of_the_reference_can_be_read():
    page = ROOT / "docs" / "reference" / "study-file.md"
    [text] = re.findall(r"```yaml\n(format: dashpot-study/1\n.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    assert parse_study(Document.parse(text), ROOT, load_registry()).name == "my_ladder"


def test_models_that_wait_for_none_are_ready_together():
    made = study(
        "data: d\nstages: [{name: a}]\nmodels: [spring, kelvin_voigt, {network: gehmann, start_from: kelvin_voigt}]\n"
    )
    assert [plan.name for plan in made.ready(())] == ["spring", "kelvin_voigt"]
    assert [plan.name for plan in made.ready({"spring", "kelvin_voigt"})] == ["gehmann"]
    assert made.ready({"spring"}) == [made.models[1]] and made.ready({plan.name for plan in made.models}) == []
    assert made.together == 2

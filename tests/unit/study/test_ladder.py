"""Whether a model is better than the one before it, and the reason where it is not."""

from __future__ import annotations

import pytest

from dashpot.study.ladder import ladder_of


def model(name, held_out, *paths, train=None, start_from=None, status="ok"):
    parameters = {path: {"role": "identified"} for path in paths} | {"curve.stiffness[0]": {"role": "fixed"}}
    rmse = {"train": held_out if train is None else train, "held_out": held_out}
    return {
        "name": name,
        "rmse": rmse,
        "parameters": parameters,
        "start_from": start_from,
        "status": status,
        "parts": {},
    }


BASE = model("base", 20.0, "oil.damping")
SCALED = model("scaled", 15.0, "oil.damping", "oil.scale[0]", "oil.scale[1]", start_from="base")
SLIDING = model("sliding", 18.0, "oil.damping", "slider.limit", "slider.stiffness", start_from="base")


def test_a_better_model_needs_no_reason():
    [step] = ladder_of([BASE, SCALED])
    assert (step["before"], step["better"], step["reason"]) == ("base", True, None)
    assert step["changes"] == {"train": pytest.approx(-25.0), "held_out": pytest.approx(-25.0)}
    assert (step["adds"], step["lacks"]) == (["oil.scale"], [])


def test_of_two_that_go_on_from_the_same_model_the_gains_of_both_are_told():
    step = ladder_of([BASE, SCALED, SLIDING])[1]
    assert (step["adds"], step["lacks"]) == (["slider"], ["oil.scale"])
    assert step["reason"] == (
        "sliding is not better on held-out runs than scaled, 18 N beside 15 N. Both go on from base (20 N): "
        "slider of sliding lower its RMSE by 10 %, oil.scale of scaled, which it lacks, lower its RMSE by 25 %."
    )


def test_what_helps_on_training_runs_alone_is_called_so():
    [step] = ladder_of([BASE, model("fitted", 21.0, "oil.damping", "slider.limit", train=10.0, start_from="base")])
    assert "On training runs its RMSE is 50 % lower: what it adds, slider, follows those runs" in step["reason"]


def test_what_helps_nowhere_is_not_needed():
    [step] = ladder_of([BASE, model("idle", 21.0, "oil.damping", "slider.limit")])
    assert step["reason"].endswith("Nor on training runs: the data do not need what it adds, slider.")


def test_another_structure_is_told_by_what_it_lacks():
    [step] = ladder_of([SCALED, SLIDING])
    assert step["reason"].endswith("It does not search oil.scale, but slider.")


def test_a_curve_that_is_known_in_one_model_is_searched_in_the_other():
    known = {**BASE, "parameters": {**BASE["parameters"], "oil.damping": {"role": "fixed"}}}
    [step] = ladder_of([known, {**BASE, "name": "searched"}])
    assert (step["adds"], step["lacks"]) == (["oil.damping"], [])


def test_another_part_is_named_with_its_model():
    one, other = ({**BASE, "name": tire, "parts": {"tire": tire}} for tire in ("voigt", "ftire"))
    [step] = ladder_of([one, other])
    assert step["adds"] == ["tire (ftire)"]


def test_a_search_that_did_not_end_is_told_instead_of_blaming_the_model():
    [step] = ladder_of([BASE, model("idle", 21.0, "oil.damping", "slider.limit", status="the budget is spent")])
    assert step["reason"].endswith("20 N. Its fit did not converge: the budget is spent.")


def test_without_held_out_runs_the_training_runs_judge():
    alone = [{**each, "rmse": {**each["rmse"], "held_out": None}} for each in (SCALED, SLIDING)]
    [step] = ladder_of(alone)
    assert "not better on training runs" in step["reason"] and step["changes"]["held_out"] is None

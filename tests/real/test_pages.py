"""What pages of measured sets say reads alike from row to row, and says what it is; no measurement is needed."""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest
from real import pages, run
from real.test_judge import made


def cause(**changes):
    return {
        "cause": "friction",
        "class": "specimen",
        "standing": "accepted",
        "presence": 0.96,
        "probability": 0.35,
        "indistinguishable_from": [],
    } | changes


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({}, "[friction](../generated/causes.md#friction) (0.96)"),
        ({"standing": "probable", "presence": 0.8999}, "probably [friction](../generated/causes.md#friction) (0.89)"),
        ({"indistinguishable_from": ["creep"]}, "[friction](../generated/causes.md#friction) or creep (0.96)"),
    ],
)
def test_the_number_behind_a_cause_is_the_one_that_decides_what_is_said(changes, told):
    outcome = made()
    outcome.causes.append(cause(**changes))
    assert f"| {told} |" in pages.diagnoses([outcome], 1.0, "N")


def test_the_table_of_trials_tells_the_same_number():
    outcome = made()
    outcome.causes.append(cause())
    assert run.row(outcome)["names"] == "friction 0.96"


def test_what_is_resembled_with_next_to_no_weight_is_told_so():
    outcome = made(resembled=[cause(standing="resembles", presence=0.0)])
    assert "| resembles [friction](../generated/causes.md#friction) (below 0.01) |" in pages.diagnoses(
        [outcome], 1.0, "N"
    )


def test_all_errors_of_a_table_have_one_unit_and_no_exponent():
    one = made(files={"before.held_out": 16310.0, "after.held_out": 8178.0}, explainable=1042.0)
    small = made(files={"before.held_out": 900.0, "after.held_out": 87.3}, explainable=None)
    text = pages.diagnoses([one, small], *pages.common_unit(pages.errors_of([one, small])))
    assert "| file before, held out (kN) | file after, held out (kN) | explainable (kN) |" in text
    assert "| 16.3 | 8.18 | 1.04 |" in text and "| 0.900 | 0.0873 | – |" in text
    assert pages.common_unit([8178.0, None]) == (1.0, "N") and pages.short(8178.0, 1.0) == "8178"


@pytest.mark.parametrize(
    ("left_out", "best", "by"),
    [((3.0, 2.0), "b", "error on training runs left out in turn"), ((None, 2.0), "a", "error on training runs")],
)
def test_the_file_that_is_drawn_predicts_runs_that_were_left_out_best(tmp_path, left_out, best, by):
    kept = []
    for word, train, unseen in zip("ab", (1.0, 1.5), left_out, strict=True):
        found = tmp_path / word / "diagnosis"
        found.mkdir(parents=True)
        told = {"left_out": unseen, "rmse": {"after": {"train": train}}}
        told |= {"fitted_model": f"{word}.yaml", "extended_model": None}
        (found / "diagnosis.json").write_text(json.dumps(told))
        kept.append((SimpleNamespace(word=word, fewer=False, seed=0), made(files={"after.train": train})))
    assert pages.best_file(kept, tmp_path) == pages.Best(tmp_path / best / "diagnosis" / f"{best}.yaml", by)
    assert pages.best_file([], tmp_path) is None


def test_the_index_tells_nearness_admission_and_names_apart():
    """Two near of four, all admitted; in the one group of two that names anything one of two does."""
    near, far = ({"after.held_out": error} for error in (10.0, 30.0))
    first = [made("unexplained", files=near, specimen=["friction"]), made("unexplained", files=near)]
    second = [made("unexplained", files=far, base="tire_model_1") for _ in range(2)]
    text = "\n\n".join(pages.index({"o_ring": [replace(one, set="o_ring") for one in first + second]}, 0))
    assert "| 4 | 2 | 4 | 75% | 50% | 0 |" in text
    assert "- within 1.1 times the explainable error on held-out runs: 2 of 4" in text
    assert "- said to be unexplained or partly explained: 4 of 4" in text
    assert "- the same where any of these is accepted: 50% in 1 of 2 groups" in text
    assert "- the same where any of these is accepted: – in 0 of 1 sets" in text
    for word in ("named", "Probably", "Resembles", "Or", "number in brackets"):
        assert f"**{word}**" in text


def test_a_set_tells_where_nothing_is_named():
    said = [made(specimen=["friction"]), made(specimen=["friction"]), *(made(base="tire_model_1") for _ in range(2))]
    told = pages.remarks(said, SimpleNamespace(name="one", known_faults=()))
    assert "- The same names: 2 of 2 from `kelvin_voigt`, 2 of 2 from `tire_model_1` (none is named)." in told

"""The report of a fit: the answer first, every number with its interval, what is to be said of it."""

from __future__ import annotations

from typing import Any

import pytest
from unit.report.fit_samples import fit, number, page_of
from unit.report.report_samples import comparison

from dashpot.report.fit import fit_headline, fit_page, knots_grid, numbers_grid
from dashpot.report.page import render
from dashpot.report.parts import Code, Grid, KeyFigures, Notice, Page


def parts(page: Page, kind: type) -> list[Any]:
    return [part for section in page.sections for part in section.parts if isinstance(part, kind)]


def test_the_headline_judges_the_error_on_unseen_runs_against_the_noise():
    assert fit_headline(fit()) == "gehmann: RMSE 36.0 N, 4.0 × the noise floor (9.00 N)."
    unseen = fit(rmse={"train": 37.0, "held_out": None, "all": 37.0}, noise_floor={"value": None, "from": None})
    assert fit_headline(unseen) == "gehmann: RMSE 37.0 N (noise floor unknown)."


def test_every_number_that_was_searched_is_told_in_rig_units():
    grid = numbers_grid(fit())
    assert [row["number"] for row in grid.rows] == ["maxwell.stiffness", "maxwell.relaxation_time"]
    first, second = grid.rows
    assert (first["value"], first["unit"], first["remark"]) == (pytest.approx(45.0), "N/mm", None)
    assert (first["low"], first["high"]) == (pytest.approx(44.0), pytest.approx(46.0))
    assert (second["value"], second["unit"], second["low"]) == (pytest.approx(160.0), "ms", None)
    assert second["remark"].startswith("at the end of its range")
    assert [row["number"] for row in knots_grid(fit()).rows] == ["rubber.stiffness[0]"]


def test_the_lead_counts_the_runs():
    assert page_of(fit()).lead.startswith("3 parameters identified on 2 runs by swarm, 1 others held out.")
    assert "held out" not in page_of(fit(held_out=[])).lead


def test_a_model_above_the_noise_floor_is_sent_to_the_diagnosis():
    [hint] = [notice for notice in parts(page_of(fit()), Notice) if "dashpot diagnose" in notice.text]
    assert hint.kind == "info"
    good = fit(rmse={"train": 9.1, "held_out": 9.2, "all": 9.1})
    assert not [notice for notice in parts(page_of(good), Notice) if "dashpot diagnose" in notice.text]


def test_a_fit_that_did_not_converge_says_so():
    alone = {**comparison(), "models": [{**comparison()["models"][0], "status": "40 steps were not enough"}]}
    page = fit_page(fit(), alone, {})
    assert any("did not converge: 40 steps were not enough." in notice.text for notice in parts(page, Notice))


def test_the_answers_of_several_starts_are_counted():
    [section] = [section for section in page_of(fit()).sections if section.title == "Parameters"]
    assert section.text == "663 parameter vectors were tried. 2 of 3 starts end within 1 % of the best."


def test_the_file_is_shown_before_and_after():
    patch = {"before": "a: 1\n", "after": "a: 2\n", "before_name": "declared", "after_name": "gehmann.yaml"}
    [code] = parts(page_of(fit(), patch=patch), Code)
    assert code.text == "- a: 1\n+ a: 2" and code.download == "a: 2\n"


def test_the_page_is_complete_and_says_where_it_comes_from():
    page = page_of(fit())
    assert dict(page.colophon)["dataset digest"] == "d" * 64 and dict(page.colophon)["model"] == "gehmann"
    assert len(parts(page, Grid)) == 3 and len(parts(page, KeyFigures)) == 1
    assert "gehmann: RMSE 36.0 N" in render(page)


def test_a_file_with_nothing_to_be_found_has_no_table_of_numbers():
    content = fit(parameters={"friction.limit": number(20.0, "N", role="fixed")}, spread=[])
    assert "Parameters" not in [section.title for section in page_of(content).sections]


PRIOR = {
    "parameter": "maxwell.stiffness",
    "law": "lognormal",
    "middle": 40e3,
    "deviation": 0.05,
    "unit": "N/m",
    "source": None,
    "value": 45e3,
    "pull": 2.4,
    "narrowed": 0.2,
}


def test_priors_are_listed_beside_what_became_of_them():
    page = page_of(fit(priors=[PRIOR]))
    [grid] = [part for part in parts(page, Grid) if part.title == "Priors"]
    [row] = grid.rows
    assert (row["middle"], row["value"], row["unit"]) == (pytest.approx(40.0), pytest.approx(45.0), "N/mm")
    assert (row["deviation"], row["of"], row["narrowed"]) == (pytest.approx(5.0), "%", pytest.approx(20.0))
    assert "source" not in [column.key for column in grid.columns]
    assert not [notice for notice in parts(page, Notice) if "contradict" in notice.text]


def test_a_prior_that_the_data_contradict_is_warned_of():
    page = page_of(fit(priors=[{**PRIOR, "pull": -4.2}]))
    [notice] = [notice for notice in parts(page, Notice) if "contradict" in notice.text]
    assert notice.kind == "warning"
    assert "maxwell.stiffness" in notice.text and "4.2 of its deviations" in notice.text


def test_what_follows_from_others_shows_its_expression():
    tied = {"value": 300.0, "unit": "N*s/m", "role": "fixed", "interval": [290.0, 310.0], "expression": "1 ms * a.b"}
    grid = numbers_grid(fit(parameters={"oil.damping": tied}))
    [row] = grid.rows
    assert row["remark"] == "= 1 ms * a.b"
    assert row["low"] is not None

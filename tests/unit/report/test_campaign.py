"""The page of a campaign says what its result file says."""

from __future__ import annotations

import pytest

from dashpot.report.campaign import campaign_headline, campaign_page, number_figure, shown_grid, specimens_grid
from dashpot.report.page import render
from dashpot.report.parts import Figure

NUMBER = {"value": 2e5, "unit": "N/m", "interval": [1.9e5, 2.1e5]}


def specimen(name: str, **more) -> dict:
    fit = {
        "numbers": {"k.stiffness": NUMBER},
        "rmse": {"train": 2.0, "held_out": None},
        "noise_floor": 2.0,
        "ending": "converged",
        "unlike": 0.01,
        "group": 1,
    }
    return {
        "specimen": name,
        "data": f"x/{name}",
        "digest": "0",
        "properties": {"temperature": 20.0, "batch": "A"},
        "models": {"m": fit},
        "verdicts": {},
        "reports": [f"{name}-fit-m"],
        "remarks": [],
        **more,
    }


def content(**more) -> dict:
    number = {
        "parameter": "k.stiffness",
        "unit": "N/m",
        "relative": True,
        "mean": 2e5,
        "interval": [1.9e5, 2.1e5],
        "scatter": 0.04,
        "scatter_interval": [0.03, 0.06],
        "error": 0.01,
    }
    effect = {
        "parameter": "k.stiffness",
        "unit": "N/m",
        "relative": True,
        "property": "temperature",
        "effect": -0.006,
        "interval": [-0.008, -0.004],
        "certain": True,
    }
    batch = {"batch": "A", "count": 2, "mean": 2e5, "low": 1.8e5, "high": 2.2e5, "outside": False}
    chart = {
        "parameter": "k.stiffness",
        "unit": "N/m",
        "center": 2e5,
        "batches": [batch, {**batch, "batch": "B", "mean": 2.5e5, "outside": True}],
    }
    shared = {
        "numbers": {"k.stiffness": {"value": 2e5, "interval": [1.9e5, 2.1e5]}},
        "probability": 1e-9,
        "error_ratio": 1.5,
        "specimens": {},
    }
    population = {
        "model": "m",
        "specimens": ["a", "b"],
        "numbers": [number],
        "correlation": [[1.0]],
        "dependence": [effect],
        "tested": True,
        "ways": [],
        "probability": [],
        "groups": [1, 2],
        "charts": [chart],
        "remarks": ["'wear' is the same for all specimens"],
        "shared": shared,
    }
    cause = {
        "model": "m",
        "cause": "play",
        "title": "play",
        "place": None,
        "class": "specimen",
        "probability": {"a": 0.9, "b": 0.0},
        "certain": {},
    }
    return {
        "format": "dashpot-campaign-result/1",
        "version": "9",
        "campaign": {"name": "c", "about": "", "seed": 0},
        "specimens": [specimen("a"), specimen("b", models={}, reports=[])],
        "populations": [population],
        "named": [{"specimen": "a", "model": "m", "kind": "damaged", "probability": 0.99, "evidence": ["why"]}],
        "causes": [cause],
        **more,
        "failures": more.get("failures", [{"job": "b-fit-m", "specimen": "b", "reason": "no file"}]),
    }


def test_the_headline_counts_and_names():
    assert campaign_headline(content()) == "1 of 2 specimens is an outlier: a; 1 job failed."
    assert campaign_headline(content(named=[], failures=[])) == "No outlier among 2 specimens."
    few = {**content()["populations"][0], "tested": False}
    for populations in ([few], []):
        told = campaign_headline(content(named=[], failures=[], populations=populations))
        assert told == "2 specimens: too few were fitted to compare each with the others."


def test_the_page_holds_all_parts_and_its_links():
    page = campaign_page(content())
    titles = [part.title for section in page.sections for part in section.parts if hasattr(part, "title")]
    assert {
        "Outliers",
        "The population",
        "Specimens",
        "k.stiffness",
        "Dependence on properties",
        "k.stiffness over temperature",
        "Control chart of k.stiffness",
        "Common parameters",
        "Causes found from m",
    } <= set(titles)
    html = render(page)
    assert '<a href="jobs/a-fit-m/report.html">a</a>' in html and "Outside: B." in html
    assert "There are 2 groups of specimens alike: a; b." in html
    assert "The specimens contradict common parameters" in html


def test_names_that_mean_something_in_html_are_harmless():
    odd = "<b>&'"
    html = render(campaign_page(content(specimens=[specimen(odd)], named=[], causes=[])))
    assert odd not in html and "%3Cb%3E%26%27-fit-m/report.html" in html


def test_the_table_is_si_with_units_and_a_column_for_each_end():
    grid = specimens_grid(content())
    headings = [column.heading for column in grid.columns]
    assert "m: k.stiffness (N/m)" in headings and "m: k.stiffness from (N/m)" in headings
    assert grid.rows[0]["m: k.stiffness to"] == 2.1e5


def test_a_failure_stands_in_the_row_of_its_specimen():
    rows = shown_grid(content()).rows
    assert [row["remark"] for row in rows] == ["damaged", "no file"]
    assert rows[0]["m: k.stiffness"] == "200 N/mm [190, 210]"


def test_a_number_is_drawn_in_rig_units_with_the_band_of_the_population():
    figure = number_figure(content(), "m", "k.stiffness")
    assert isinstance(figure, Figure)
    assert list(figure.columns["k.stiffness (N/mm)"]) == pytest.approx([200.0])
    band = figure.plot["layout"]["shapes"][0]
    # two standard deviations of 4 % about 200 N/mm, as factors
    assert (band["y0"], band["y1"]) == (pytest.approx(184.62, abs=0.01), pytest.approx(216.66, abs=0.01))
    with pytest.raises(ValueError, match="parameters are: k.stiffness"):
        number_figure(content(), "m", "c.damping")

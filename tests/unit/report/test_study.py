"""The page of a study: what it adds to the comparison of its models."""

from __future__ import annotations

from unit.report.report_samples import comparison, comparison_evidence

from dashpot.report.page import render
from dashpot.report.parts import Notice
from dashpot.report.study import intervals_grid, masses_grid, stages_grid, study_page

STAGE = {
    "name": "dynamics",
    "optimizer": "swarm",
    "free": ["oil.damping"],
    "loss": 12.5,
    "evaluations": 640,
    "failures": 0,
    "ending": "the budget is spent",
    "remark": "",
    "spread": [12.5, 12.6, 14.0],
}
NUMBER = {"value": 2e5, "unit": "N/m", "role": "free", "interval": [1.9e5, 2.1e5]}
PROFILE = {"parameter": "a.k", "value": [1.0], "loss": [1.0], "interval": [1.5e5, 3e5], "open": [False, True]}


def model(row: dict) -> dict:
    knots = {f"curve.stiffness[{number}]": NUMBER for number in range(9)}
    return {
        **row,
        "parameters": {"a.k": NUMBER, "a.fixed": {**NUMBER, "role": "fixed"}, **knots},
        "at_bound": ["a.k"],
        "identifiability": {"condition": 1234.5, "deviations": {}, "weak": ["a and b trade off"]},
        "stages": [STAGE],
        "masses": [{"node": "wheel", "value": 40.0, "interval": [39.0, 41.5]}],
        "bootstrap": {"a.k": [1.8e5, 2.2e5]},
        "profiles": [PROFILE],
    }


def study(amplitude: float | None = 5e-3) -> dict:
    content = comparison()
    header = {"name": "ladder", "about": "Two models.", "budget": 640, "amplitude": amplitude}
    header["compared"] = [row["name"] for row in content["models"]]
    return {**content, "study": header, "models": [model(row) for row in content["models"]]}


def test_intervals_of_every_kind_stand_side_by_side_in_rig_units():
    [row] = intervals_grid(study()["models"][0]).rows
    assert (row["parameter"], row["unit"], row["value"]) == ("a.k", "N/mm", 200.0)
    assert (row["interval"], row["bootstrap"]) == ("190.0 to 210.0", "180.0 to 220.0")
    assert row["profile"] == "150.0 to above 300.0"


def test_stages_tell_how_many_starts_agree():
    row = stages_grid(study()).rows[0]
    assert row["starts"] == "2 of 3" and row["ending"] == "the budget is spent" and row["evaluations"] == 640


def test_what_is_not_well_known_is_a_warning():
    page = study_page(study(), comparison_evidence())
    said = [part.text for section in page.sections for part in section.parts if isinstance(part, Notice)]
    assert any("a.k is at the end of its range; a and b trade off" in text for text in said)


def test_the_page_holds_the_stiffness_at_the_amplitude_of_the_study_only():
    evidence = comparison_evidence()
    known = sorted({curve["amplitude"] for curve in evidence["dynamic_stiffness"]})
    titles = {a: [s.title for s in study_page(study(a), evidence).sections] for a in (known[0], 0.123, None)}
    assert any(title.startswith("Dynamic stiffness at") for title in titles[known[0]])
    assert not any(title.startswith("Dynamic stiffness at") for title in titles[0.123] + titles[None])
    assert "<title>Study ladder" in render(study_page(study(known[0]), evidence))


def test_masses_stand_side_by_side_and_what_the_structure_makes_of_them_is_told():
    content = study()
    assert [row["interval"] for row in masses_grid(content).rows] == ["39.00 to 41.50"] * len(content["models"])
    content["models"][1]["masses"][0]["value"] = 44.0
    names = [row["name"] for row in content["models"]]
    told = [part.text for section in study_page(content, comparison_evidence()).sections for part in section.parts
            if isinstance(part, Notice) and "depends on the structure" in part.text]  # fmt: skip
    assert len(told) == 1 and f"44.00 kg with {names[1]}" in told[0]

"""The page of a study: what it adds to the comparison of its models."""

from __future__ import annotations

import pytest
from unit.report.report_samples import comparison, comparison_evidence

from dashpot.report.axle import disagreements, excited_grid, masses_grid, slow_grid, taken_as_known, wheels_grid
from dashpot.report.page import render
from dashpot.report.parts import Notice
from dashpot.report.study import convergence, intervals_grid, stages_grid, study_page
from dashpot.study.ladder import ladder_of
from dashpot.study.masses import identified_masses

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
MASS = {
    "node": "wheel",
    "parameter": "wheel.mass",
    "value": 40.0,
    "interval": [39.0, 41.5],
    "owed": [],
    "owed_to_known": [],
}
PROFILE = {"parameter": "a.k", "value": [1.0], "loss": [1.0], "interval": [1.5e5, 3e5], "open": [False, True]}


def model(row: dict) -> dict:
    knots = {f"curve.stiffness[{number}]": NUMBER for number in range(9)}
    return {
        **row,
        "parameters": {"a.k": NUMBER, "a.fixed": {**NUMBER, "role": "fixed"}, **knots},
        "at_bound": ["a.k"],
        "identifiability": {
            "condition": 1234.5,
            "deviations": {},
            "weak": ["a and b trade off"],
            "may_go": ["c may go"],
        },
        "stages": [STAGE],
        "masses": [MASS],
        "start_from": None,
        "parts": {},
        "bootstrap": {"a.k": [1.8e5, 2.2e5]},
        "profiles": [PROFILE],
        "held_out": ["b1"],
    }


def study(amplitude: float | None = 5e-3) -> dict:
    content = comparison()
    header = {"name": "ladder", "about": "Two models.", "budget": 640, "amplitude": amplitude}
    header["compared"] = [row["name"] for row in content["models"]]
    return answered({**content, "study": header, "models": [model(row) for row in content["models"]]})


def answered(content: dict) -> dict:
    masses = identified_masses(content["models"], 9.0, content.get("references", ()))
    return {**content, "masses": masses, "ladder": ladder_of(content["models"])}


def test_intervals_of_every_kind_stand_side_by_side_in_rig_units():
    [row] = intervals_grid(study()["models"][0]).rows
    assert (row["parameter"], row["unit"], row["value"]) == ("a.k", "N/mm", 200.0)
    assert (row["interval"], row["bootstrap"]) == ("190 to 210", "180 to 220")
    assert row["profile"] == "150 to above 300"


def test_stages_tell_how_many_starts_agree():
    row = stages_grid(study()).rows[0]
    assert row["starts"] == "2 of 3" and row["ending"] == "the budget is spent" and row["evaluations"] == 640


def test_what_is_not_well_known_is_a_warning():
    page = study_page(study(), comparison_evidence())
    said = [part.text for section in page.sections for part in section.parts if isinstance(part, Notice)]
    assert any("a.k is at the end of its range; a and b trade off; c may go" in text for text in said)


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
    content["models"][1]["masses"] = [{**MASS, "value": 44.0}]
    best = answered(content)["masses"][0]["model"]
    told = [
        part.text
        for section in study_page(answered(content), comparison_evidence()).sections
        for part in section.parts
        if isinstance(part, Notice)
    ]
    assert sum(text.startswith("wheel: ") and f"from {best}, which has the lowest RMSE" in text for text in told) == 1
    assert sum("other structures give" in text for text in told) == 1


def test_the_headline_of_a_study_of_masses_is_the_mass_with_its_interval():
    content = answered(study())
    mass = content["masses"][0]
    headline = study_page(content, comparison_evidence()).headline
    assert headline.startswith(f"wheel: {mass['value']:.2f} kg, 95 % interval 39.00 to 41.50 kg; from {mass['model']}")
    assert headline.endswith("which has the lowest RMSE (14.9 N at a noise floor of 9 N).")
    assert not study_page({**content, "masses": []}, comparison_evidence()).headline.startswith("wheel")


def test_a_mass_that_was_weighed_stands_beside_the_identified_one():
    weighed = {"parameter": "wheel.mass", "value": 41.0, "unit": "kg", "by": "weighed"}
    content = answered({**study(), "references": [weighed]})
    page = study_page(content, comparison_evidence())
    assert "39.00 to 41.50 kg, 2.4 % below the 41.00 kg weighed; from" in page.headline
    grid = masses_grid(content)
    assert [row["off"] for row in grid.rows] == pytest.approx([100.0 * (40.0 / 41.0 - 1.0)] * len(grid.rows))
    assert "wheel: 41.00 kg weighed." in grid.caption
    assert "off" not in {column.key for column in masses_grid(study()).columns}


def test_a_model_that_is_not_better_than_the_one_before_it_says_why():
    content = study()
    content["models"][1]["rmse"] = {**content["models"][1]["rmse"], "held_out": 1e3}
    page = study_page(answered(content), comparison_evidence())
    [section] = [section for section in page.sections if section.title == "From model to model"]
    said = [part.text for part in section.parts if isinstance(part, Notice)]
    first, second = (model["name"] for model in content["models"][:2])
    assert any(text.startswith(f"{second} is not better on held-out runs than {first}, 1000 N") for text in said)


def masses(without: float, interval: list[float]) -> dict:
    content = study()
    for each in content["models"]:
        each["masses_without_tire"] = [{"node": "wheel", "value": without, "interval": interval, "rmse": 11.0}]
    return content


def test_a_mass_that_comes_out_otherwise_without_the_tire_is_told():
    agree, apart = masses(40.5, [40.0, 41.0]), masses(44.0, [43.5, 44.5])
    assert any("agree within their intervals" in text for text in disagreements(agree))
    said = "40.00 kg with the tire and 44.00 kg without it disagree by 4.0 kg (10 %)"
    assert any(said in text for text in disagreements(apart))
    assert not any(said in text for text in disagreements(agree))
    assert masses_grid(apart).rows[0]["without_interval"] == "43.50 to 44.50"


def test_rubber_behind_the_shock_absorber_is_told_only_where_it_shows():
    def axle(elastic: float, compliance: float) -> dict:
        rows = [
            {"node": "wheel", "fixing": "rigid", "value": 44.0, "interval": [43.8, 44.2], "compliance": 0.0},
            {
                "node": "wheel",
                "fixing": "elastic",
                "value": elastic,
                "interval": [elastic - 0.2, elastic + 0.2],
                "compliance": compliance,
            },
        ]
        return {**study(), "axle": {"wheels": rows}}

    def told(elastic: float, compliance: float) -> list[str]:
        return [text for text in disagreements(axle(elastic, compliance)) if "rubber" in text]

    [said] = told(46.5, 2e-6)
    assert "rubber of about 500 N/mm" in said and "by about 2.5 kg" in said
    assert not told(44.1, 2e-6) and not told(43.0, -1e-7)
    assert [row["rubber"] for row in wheels_grid(axle(46.5, 2e-6)["axle"]).rows] == [None, "500 N/mm"]


def test_knots_that_no_run_reached_have_no_force():
    content = study()
    content["models"][0]["velocity_curves"] = [
        {
            "curve": "oil.damping",
            "velocity": [-1.0, -0.5, 0.0],
            "force": [-900.0, -500.0, 0.0],
            "reached": [-0.6, 0.1],
            "low": [-950.0, -520.0, 0.0],
            "high": [-850.0, -480.0, 0.0],
            "excited": [False, True, True],
        }
    ]
    outside, inside, rest = excited_grid(content).rows
    assert (outside["force"], outside["interval"]) == (None, "not excited")
    assert (inside["force"], inside["interval"], rest["interval"]) == (-500.0, "-520 to -480", "–")


def test_a_known_curve_is_told_of_unless_it_was_measured_so():
    curve = {"curve": "oil.damping", "velocity": [-1.0, 1.0], "force": [-9.0, 9.0], "reached": [-1.0, 1.0]}
    ends = {"low": [-9.0, 9.0], "high": [-9.0, 9.0], "excited": [True, True]}

    def told(share: float | None) -> list[str]:
        content = study()
        content["models"][0]["velocity_curves"] = [curve | ends]
        each = {"model": content["models"][0]["name"], "within": [-1.0, 1.0], "rms": 1.0, "share": share}
        references = [{"parameter": "oil.damping", "by": "rig", "velocity": [], "force": [], "deviations": [each]}]
        return list(taken_as_known({**content, "references": [] if share is None else references}))

    assert told(0.004) == []
    assert "oil.damping as known, 30 % off the measured: its parameters hold if" in told(0.3)[0]
    assert "the data state no measured curve" in told(None)[0]


def test_slow_curves_stand_in_numbers():
    curves = {
        "of": "measured",
        "rate": [25e3, 26e3],
        "half_width": [60.0, 70.0],
        "speed": 7.2e-3,
        "bar_rate": 11e3,
        "roll_half_width": 80.0,
        "roll_speed": 3.3e-3,
    }
    grid = slow_grid({"slow_curves": [curves]})
    assert grid.rows[0]["heave"] == 65.0 and grid.rows[0]["bar"] == 11.0
    assert "7.2 mm/s in phase and 3.3 mm/s in anti-phase" in grid.caption


def test_the_end_of_a_search_is_told_in_words():
    content = study()["models"][0]
    assert convergence(content).startswith(
        f"{content['name']}: 2 of 3 starts converged to 12.5 N within 1 %, the nearest of the others ended at 14.0 N; "
        "every parameter has influence; at the end of its range: a.k"
    )
    content["stages"] = [{**STAGE, "spread": [10.0, 14.0], "converged": False}]
    assert "none of the other 1 starts converged to 10.0 N" in convergence(content)
    assert "stage dynamics: the budget is spent" in convergence(content)
    content["stages"] = [{**STAGE, "spread": [10.0]}]
    assert "one start only" in convergence(content)


def test_held_out_runs_and_their_error_are_named():
    texts = [section.text for section in study_page(study(), comparison_evidence()).sections]
    told = next(text for text in texts if "Held out from all stages" in text)
    rows = study()["models"]
    assert told.startswith("Held out from all stages: b1. RMSE on them (on training runs): ")
    assert all(f"{row['name']} " in told for row in rows) and told.count("Held out from all stages") == 1

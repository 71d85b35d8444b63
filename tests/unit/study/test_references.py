"""How far identified curves are from those that were measured by other means; truth: straight lines."""

from __future__ import annotations

import pytest

from dashpot.study.references import deviation, references_content

CURVE = {"curve": "oil.damping", "velocity": [-1.0, 0.0, 1.0], "force": [-110.0, 0.0, 110.0], "reached": [-0.5, 2.0]}
LINE = {"velocity": [-2.0, 0.0, 0.8], "force": [-200.0, 0.0, 80.0]}


def test_curves_are_compared_where_both_are_known_and_the_runs_were():
    found = deviation(CURVE, LINE)
    assert found["within"] == [-0.5, 0.8] and found["share"] == pytest.approx(0.1)
    # 10 N s/m over [-0.5, 0.8]: the mean square of v is (0.8^3 + 0.5^3) / (3 * 1.3)
    assert found["rms"] == pytest.approx(10.0 * ((0.8**3 + 0.5**3) / 3.9) ** 0.5, rel=5e-3)


def test_where_they_do_not_meet_nothing_is_told():
    assert deviation({**CURVE, "reached": [1.5, 2.0]}, LINE) == {"within": None, "rms": None, "share": None}


def test_references_that_no_model_has_are_left_out():
    from dashpot.data.reference import Reference
    from dashpot.text.problem import Place

    curve = Reference("oil.damping", "damper test rig", Place(), "", tuple(LINE["velocity"]), tuple(LINE["force"]))
    other = Reference("hub.mass", "weighed", Place(), "3 kg")
    [found] = references_content([curve, other], [], [{"name": "m", "velocity_curves": [CURVE]}])
    assert found["parameter"] == "oil.damping" and found["deviations"][0]["model"] == "m"

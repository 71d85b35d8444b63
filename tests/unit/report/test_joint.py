"""The page of a joint fit: what is shared, with the digits that its interval gives, and three tiles."""

from __future__ import annotations

from typing import Any

from dashpot.report.joint import joint_page, shared_grid
from dashpot.report.parts import KeyFigures
from dashpot.report.tables import cell_text


def specimen(alone: float, together: float) -> dict[str, Any]:
    """A specimen whose error grows from ``alone`` to ``together``."""
    entry = {"value": 2e5, "unit": "N/m", "interval": [1.9e5, 2.1e5], "role": "free", "confused_with": []}
    return {
        "model": "mount",
        "rmse": {"train": together, "held_out": None},
        "rmse_alone": {"train": alone, "held_out": None},
        "noise_floor": {"value": 4.0},
        "parameters": {"rubber.stiffness": entry},
        "at_bound": [],
        "without_influence": [],
    }


def content(probability: float) -> dict[str, Any]:
    """Two specimens with a damping in common."""
    damping = {
        "number": "damping.damping",
        "value": 613.73,
        "unit": "N*s/m",
        "interval": [516.8, 728.8],
        "probability": probability,
        "alone": {"first": {"value": 613.86}, "second": {"value": 650.1}},
    }
    specimens = {"first": specimen(10.0, 10.5), "second": specimen(8.0, 8.08)}
    return {"name": "two", "about": "", "shared": [damping], "specimens": specimens}


def test_three_tiles_say_what_is_shared_and_what_it_costs():
    page = joint_page(content(0.4))
    [tiles] = [part for part in page.sections[0].parts if isinstance(part, KeyFigures)]
    assert [(value, unit) for _, value, unit, _ in tiles.figures] == [("1", ""), ("0.4", ""), ("5.0", "%")]
    assert tiles.figures[2][3] == "together, first"
    assert page.lead == "1 parameter in common, 2 specimens: first and second."


def test_a_contradiction_stands_in_headline_and_warning():
    page = joint_page(content(1e-4))
    assert page.headline == "The specimens contradict one another in damping.damping."
    assert any("contradict" in part.text for part in page.sections[0].parts if hasattr(part, "text"))


def test_values_in_common_have_the_digits_of_their_interval():
    grid = shared_grid(content(0.4))
    shown = {column.key: cell_text(column, grid.rows[0]) for column in grid.columns}
    assert (shown["value"], shown["low"], shown["high"]) == ("0.61", "0.52", "0.73")
    assert (shown["first"], shown["second"]) == ("0.61", "0.65")

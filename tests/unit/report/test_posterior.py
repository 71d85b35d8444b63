"""The posterior in the report of a fit: both intervals side by side, and the figures of its draws."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from seeds import seed_of
from unit.report.fit_samples import fit, page_of, posterior

from dashpot.report import figures
from dashpot.report.figures.draws import SHOWN
from dashpot.report.page import render
from dashpot.report.parts import Figure, Grid, Notice
from dashpot.report.plot_json import plot_json, plotly_figure
from dashpot.report.posterior import draw_figures, posterior_grid

STEPS, WALKERS = 40, 8


def draws(names: int = 2, drift: float = 0.0) -> dict[str, Any]:
    """Draws of stiffnesses about 200 N/mm, of which each is 1 N/mm higher; they drift by a share over the steps."""
    step, walker = np.repeat(np.arange(STEPS), WALKERS), np.tile(np.arange(WALKERS), STEPS)
    rng = np.random.default_rng(seed_of("report posterior"))
    paths = [f"spring_{k}.stiffness" for k in range(names)]
    moved = 2e5 * drift * step / STEPS
    numbers = {path: 2e5 + 1e3 * k + moved + 5e2 * rng.standard_normal(step.size) for k, path in enumerate(paths)}
    units, fitted = dict.fromkeys(paths, "N/m"), dict.fromkeys(paths, 2e5)
    return {"step": step, "walker": walker, "numbers": numbers, "units": units, "fitted": fitted}


def posterior_section(content: dict[str, Any], **evidence: Any) -> list[Any]:
    return [
        part
        for section in page_of(content, **evidence).sections
        if section.title == "Posterior"
        for part in section.parts
    ]


def test_both_intervals_stand_side_by_side_in_rig_units():
    first, second = posterior_grid(fit(posterior=posterior())).rows
    assert (first["median"], first["low"], first["high"]) == pytest.approx((45.2, 43.0, 47.0))
    assert (first["value"], first["from"], first["to"]) == pytest.approx((45.0, 44.0, 46.0))
    assert (first["unit"], first["r_hat"], first["effective"], first["time"]) == ("N/mm", 1.01, 1700.0, 9.5)
    # the fit has no interval of this one
    assert (second["median"], second["value"], second["from"]) == (pytest.approx(150.0), pytest.approx(160.0), None)


def test_a_fit_without_a_sampler_has_no_section_of_it():
    assert posterior_section(fit()) == []


def test_a_chain_that_has_not_converged_is_a_warning():
    told = posterior(converged=False, sentence="the posterior did not converge: allow more steps", held=["mass.mass"])
    first, second, grid = posterior_section(fit(posterior=told))
    assert isinstance(first, Notice) and first.kind == "warning" and first.text.endswith("allow more steps.")
    assert "mass.mass" in second.text and isinstance(grid, Grid)
    assert posterior_section(fit(posterior=posterior()))[0].kind == "info"


def test_the_page_shows_pairs_traces_and_ranks():
    parts = posterior_section(fit(posterior=posterior()), draws=draws())
    titles = [part.title for part in parts if isinstance(part, Figure)]
    assert titles == ["Parameters in pairs", "Traces of the draws", "Ranks of the draws"]
    page = render(page_of(fit(posterior=posterior()), draws=draws()))
    assert all(title in page for title in titles)


@pytest.mark.parametrize("names", [1, 2, SHOWN + 2])
def test_plotly_accepts_the_figures_and_no_more_than_a_few_numbers_are_shown(names):
    for figure in draw_figures(draws(names)):
        assert len(plotly_figure(figure).data) == len(figure.plot["data"])
        json.dumps(plot_json(figure), allow_nan=False)
        assert ("2 others left out" in figure.caption) is (names > SHOWN)


def test_pairs_stand_below_the_diagonal_in_rig_units():
    drawn = plotly_figure(figures.corner(draws()))
    points, fitted = (trace for trace in drawn.data if trace.type == "scatter" and trace.mode == "markers")
    assert np.mean(points.x) == pytest.approx(200.0, abs=0.2) and np.mean(points.y) == pytest.approx(201.0, abs=0.2)
    assert drawn.layout.xaxis2.title.text == "spring_0.stiffness<br>(N/mm)"
    assert (fitted.x[0], fitted.y[0]) == pytest.approx((200.0, 200.0))


def test_a_trace_follows_one_walker():
    some = draws()
    first = plotly_figure(figures.draw_traces(some)).data[0]
    assert np.allclose(first.x, np.arange(STEPS))
    assert np.allclose(first.y, 1e-3 * some["numbers"]["spring_0.stiffness"][::WALKERS])


def test_ranks_of_a_chain_that_drifts_are_not_level():
    def spread(drift: float) -> float:
        lines = plotly_figure(figures.draw_ranks(draws(drift=drift))).data
        return max(max(line.y) for line in lines)

    # all draws of the first quarter are the lowest ones of a chain that drifts far: four times as many as expected
    assert spread(1.0) == pytest.approx(4.0)
    assert spread(0.0) < 3.5

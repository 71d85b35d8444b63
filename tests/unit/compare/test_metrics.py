"""Metrics stand beside measured runs and models, whoever brought them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.compare.comparison import compare
from dashpot.compare.explainable import Explainable
from dashpot.compare.look import look
from dashpot.compare.metrics import metric_lines, metric_rows
from dashpot.contract.metric import Metric
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.model.reading import parse_network
from dashpot.report.comparison import comparison_page
from dashpot.report.grids import metrics_grid

TIME = 1e-3 * np.arange(2000)
X = 1e-3 * np.sin(2.0 * np.pi * 5.0 * TIME)
REGISTRY = load_registry()


class Largest(Metric):
    """The largest force of the runs called a..."""

    word, unit = "largest", "N"

    def measure(self, run):
        """Of a run whose name begins with a."""
        return float(run.force.max()) if run.name.startswith("a") else None


def runs() -> tuple[Run, ...]:
    force = 2e5 * X + 300.0 * np.gradient(X, TIME)
    return tuple(Run(name, "harmonic", TIME, {"displacement": X, "force": force}, group=name) for name in ("a1", "b1"))


def test_a_row_for_every_run_that_has_the_number():
    rows = metric_rows([Largest], runs(), {"half": {run.name: 0.5 * run.force for run in runs()}})
    largest = float(runs()[0].force.max())
    assert rows == [
        {
            "metric": "largest",
            "unit": "N",
            "run": "a1",
            "measured": largest,
            "models": {"half": pytest.approx(largest / 2)},
        }
    ]
    assert metric_lines(rows) == [f"largest of a1: {largest:.4g} N"]


def test_a_metric_of_a_plugin_stands_in_comparisons_looks_and_reports(monkeypatch):
    for place in ("comparison", "look"):
        monkeypatch.setattr(f"dashpot.compare.{place}.explainable_error", lambda *_: Explainable(reason="not asked"))
    registry = replace(REGISTRY, metrics={"largest": Largest})
    spec = parse_network(
        "format: dashpot-network/1\nname: stiff\nbranches:\n  it: {element: spring, stiffness: 4e5}\n",
        REGISTRY.elements,
    )
    dataset = Dataset("two", runs())
    comparison = compare([spec], dataset, registry=registry)
    (row,) = comparison.as_dict()["metrics"]
    assert row["models"]["stiff"] == pytest.approx(400.0, rel=1e-3)
    grid = metrics_grid(comparison.as_dict())
    assert [column.title for column in grid.columns] == ["metric", "run", "unit", "measured", "stiff"]
    page = comparison_page(comparison.as_dict(), comparison.evidence())
    assert any(getattr(part, "title", "") == "Metrics" for section in page.sections for part in section.parts)
    assert look(dataset, metrics=[Largest]).as_dict()["metrics"][0]["run"] == "a1"

"""The metrics of runs, measured and as models simulate them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.metric import Metric
from dashpot.data.run import Run

Array = NDArray[np.float64]


def metric_rows(
    metrics: Iterable[type[Metric]], runs: Sequence[Run], simulated: Mapping[str, Mapping[str, Array]] | None = None
) -> list[dict[str, Any]]:
    """A row in plain values for every metric and run that has it; ``simulated``: model -> run -> force (n,) in N.

    Metrics that are told only where they are named are left out.
    """
    return named_rows([made for made in metrics if made.everywhere], runs, simulated)


def named_rows(
    metrics: Iterable[type[Metric]], runs: Sequence[Run], simulated: Mapping[str, Mapping[str, Array]] | None = None
) -> list[dict[str, Any]]:
    """The same of all metrics that are named."""
    found = []
    for made in metrics:
        metric = made()
        for run in runs:
            value = metric.measure(run)
            if value is not None:
                models = {
                    label: metric.measure(replace(run, channels={**run.channels, "force": forces[run.name]}))
                    for label, forces in (simulated or {}).items()
                }
                found.append(
                    {"metric": made.word, "unit": made.unit, "run": run.name, "measured": value, "models": models}
                )
    return found


def metric_lines(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Metrics of measured runs for the terminal."""
    return [f"{row['metric']} of {row['run']}: {row['measured']:.4g} {row['unit']}" for row in rows]

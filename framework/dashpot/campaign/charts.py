"""Control charts: the means of batches against what the scatter within batches lets expect."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.campaign.numbers import Numbers

Array = NDArray[np.float64]

LIMIT = 3.0  # standard errors of a mean


def control_charts(
    numbers: Numbers, means: Array, batches: Sequence[str | None], sound: NDArray[np.bool_]
) -> list[dict[str, Any]]:
    """For each number its batches in their order: ``mean``, ``low`` and ``high`` limit in SI, ``count``, ``outside``.

    ``means`` (q, p) takes out what the parameters owe to properties; only the specimens that are ``sound`` (n,) count.
    The limits are three standard errors from the mean of all, by the scatter within batches. An empty list without two
    batches of which one has two specimens.

    Source: Montgomery, Introduction to statistical quality control, section 6.2.
    """
    order = list(dict.fromkeys(batch for batch in batches if batch is not None))
    members = {batch: [k for k, other in enumerate(batches) if other == batch and sound[k]] for batch in order}
    members = {batch: places for batch, places in members.items() if places}
    freedom = sum(len(places) - 1 for places in members.values())
    if len(members) < 2 or freedom < 1:
        return []
    rest = numbers.at - numbers.design[:, 1:] @ means[1:]
    return [_chart(numbers, k, rest[:, k], members, freedom) for k in range(len(numbers.paths))]


def _chart(numbers: Numbers, which: int, at: Array, members: Mapping[str, list[int]], freedom: int) -> dict[str, Any]:
    averages = {batch: float(at[places].mean()) for batch, places in members.items()}
    squares = sum(float(np.sum((at[places] - averages[batch]) ** 2)) for batch, places in members.items())
    center = float(at[[k for places in members.values() for k in places]].mean())
    scatter = float(np.sqrt(squares / freedom))
    found = []
    for batch, places in members.items():
        reach = LIMIT * scatter / np.sqrt(len(places))
        ends = [numbers.value(which, each) for each in (averages[batch], center - reach, center + reach)]
        found.append(
            {
                "batch": batch,
                "count": len(places),
                "mean": ends[0],
                "low": ends[1],
                "high": ends[2],
                "outside": bool(abs(averages[batch] - center) > reach),
            }
        )
    return {
        "parameter": numbers.paths[which],
        "unit": numbers.units[which],
        "center": numbers.value(which, center),
        "batches": found,
    }

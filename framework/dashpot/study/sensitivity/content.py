"""What a sensitivity study found, in plain values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.study.sensitivity.declaration import Variation
from dashpot.study.sensitivity.run import SensitivityResult

Array = NDArray[np.float64]

BAND = (5.0, 50.0, 95.0)  # per cent of the specimens
NONE = (None, None, None)


def sensitivity_content(result: SensitivityResult, measured: Sequence[Mapping[str, Any]] = ()) -> dict[str, Any]:
    """The result as in ``sensitivity.json``; ``measured`` are metrics of measured runs.

    ``curves``: each metric over the variation ``over``, at first with nothing else changed (``vary`` is None there);
    ``bands``: of drawn specimens, how much nine of ten keep, and the share that is below the limit; of those that have
    the metric at that place, None where none has it.
    """
    study = result.study
    return {
        "format": "dashpot-sensitivity-result/1",
        "study": {
            "name": study.name,
            "about": study.about,
            "network": study.network.name,
            "rig": study.bench.name,
            "seed": study.seed,
            "draws": result.drawn.shape[2],
            "parameter_vectors": study.lanes,
        },
        "metrics": [
            {"word": made.word, "unit": made.unit, "at_least": study.limits.get(made.word), "about": _about(made)}
            for made in study.metrics
        ],
        "over": _variation(study.over),
        "vary": [_variation(each) for each in study.vary],
        "scatter": [
            {
                "parameters": list(each.paths),
                "deviation": each.deviation,
                "between": each.between,
                "unit": each.unit,
            }
            for each in study.scatter
        ],
        "curves": _curves(result),
        "bands": _bands(result) if result.drawn.shape[2] else [],
        "limits_reached": [each for number in range(len(study.metrics)) for each in _reached(result, number)],
        "measured": list(measured),
    }


def crossing(at: Sequence[float], values: Sequence[float], limit: float) -> float | None:
    """Where a broken line is first at a limit or below it; None where it stays above. Places without a value do not
    count.
    """
    known = [(place, value - limit) for place, value in zip(at, values, strict=True) if not math.isnan(value)]
    if known and known[0][1] <= 0.0:
        return float(known[0][0])
    for (start, before), (stop, after) in pairwise(known):
        if before > 0.0 >= after:
            return float(start + (stop - start) * before / (before - after))
    return None


def _rows(result: SensitivityResult) -> Iterator[tuple[str | None, float | None, Array]]:
    """What is changed, to which value, and every metric (metrics, over) then."""
    yield None, None, result.plain
    for each in result.changed:
        yield each.variation.name, each.variation.values[each.at], each.metrics


def _curves(result: SensitivityResult) -> list[dict[str, Any]]:
    words = [made.word for made in result.study.metrics]
    return [
        {"vary": name, "value": value, "metrics": dict(zip(words, map(_numbers, table), strict=True))}
        for name, value, table in _rows(result)
    ]


def _bands(result: SensitivityResult) -> list[dict[str, Any]]:
    found = []
    for number, made in enumerate(result.study.metrics):
        limit, places = result.study.limits.get(made.word), [each[~np.isnan(each)] for each in result.drawn[number]]
        low, median, high = zip(
            *(np.percentile(have, BAND).tolist() if have.size else NONE for have in places), strict=True
        )
        failing = None if limit is None else [float(np.mean(have < limit)) if have.size else None for have in places]
        band = {"low": list(low), "median": list(median), "high": list(high), "failing": failing}
        found.append({"metric": made.word, **band})
    return found


def _reached(result: SensitivityResult, number: int) -> list[dict[str, Any]]:
    """Where each curve of a metric reaches its limit."""
    study = result.study
    word, over = study.metrics[number].word, study.over.values
    if word not in study.limits:
        return []
    return [
        {"metric": word, "vary": name, "value": value, "at": crossing(over, list(table[number]), study.limits[word])}
        for name, value, table in _rows(result)
    ]


def _variation(variation: Variation) -> dict[str, Any]:
    return {
        "name": variation.name,
        "parameters": list(variation.paths),
        "values": list(variation.values),
        "relative": variation.relative,
        "unit": variation.unit,
    }


def _numbers(values: Array) -> list[float | None]:
    return [None if math.isnan(value) else value for value in values.tolist()]


def _about(made: type) -> str:
    return (made.__doc__ or "").strip().partition("\n")[0]

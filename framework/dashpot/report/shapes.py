"""The figures of what the force looks like without a model, measured and simulated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from dashpot.report import figures
from dashpot.report.parts import Figure

CURVES = ("mid_stroke", "low_speed", "less_spring", "after_reversals")


def shape_figures(shapes: Mapping[str, Any], series: Sequence[str] = ()) -> Iterator[Figure]:
    """The figures of `compare.shapes.shapes_of`; the labels in `series` are drawn at first, without them all."""
    for told in shapes["residual_maps"]:
        if not series or told["label"] in series:
            yield figures.residual_map(told)
    for way in CURVES:
        if shapes[way]:
            yield figures.shape_figure(way, shapes[way], shapes, series)
    conditions = figures.over_conditions(shapes["conditions"], series)
    if conditions is not None:
        yield conditions
    if shapes["cycles"]:
        yield figures.shape_figure("cycles", shapes["cycles"], shapes, series)

"""What a curve may do between its knots without being another law."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.view import ModelView
from dashpot.fit.scored import ScoredRun
from dashpot.model.network import Branch, NetworkSpec

Array = NDArray[np.float64]

ORDERS = 3  # of polynomials beyond a straight line between two knots


def bends_of_tables(runs: Sequence[ScoredRun], view: ModelView, network: NetworkSpec) -> dict[str, Array]:
    """Bends of fitted tables of force over velocity between two knots (k, samples) by run, which the fit cannot follow.

    A table over deflection has causes of its own that bend it.
    """
    tables = [np.array(at) for branch in network.root.members for at in _fitted_knots(branch)]
    return {run.name: _bends(tables, view.velocity(run.name)[run.first :]) for run in runs}


def _fitted_knots(member: object) -> Iterator[tuple[float, ...]]:
    if isinstance(member, Branch) and member.scale is None:
        for curve in member.curves.values():
            fitted = any(value.searched for value in curve.values)
            if curve.form == "table" and fitted and (curve.curve.over[1], curve.curve.value[1]) == ("m/s", "N"):
                yield curve.at


def _bends(tables: Sequence[Array], velocity: Array) -> Array:
    found = [np.zeros((0, velocity.size))]
    for knots in tables:
        along = np.clip((velocity - knots[:-1, None]) / np.diff(knots)[:, None], 0.0, 1.0)
        bend, middle = along * (1.0 - along), 1.0 - 2.0 * along
        found += [bend * middle**order for order in range(ORDERS)]
    return np.concatenate(found)

"""What is no cause though forces differ: errors of a sensor within its data sheet, and curves between their knots."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.projection import SparseRows
from dashpot.assess.view import ModelView
from dashpot.data.sensor_errors import error_shapes
from dashpot.fit.scored import ScoredRun
from dashpot.model.network import Branch, NetworkSpec

Array = NDArray[np.float64]

ORDERS = 3  # of polynomials beyond a straight line between two knots
ANY = 1e9  # N: nothing is known


def sensor_nuisance(
    runs: Sequence[ScoredRun], view: ModelView, sensors: Mapping[str, Mapping[str, float]]
) -> tuple[SparseRows, Array]:
    """The force channel's errors within its specification, one of each kind per run, and how large they may be."""
    values, places = {}, {}
    priors: list[float] = []
    for run in runs:
        shapes = error_shapes(view.force(run.name), run.drive.dt)
        known = {key: size for key, size in sensors.get(run.name, {}).items() if key in shapes and size > 0.0}
        values[run.name] = np.array([shapes[key][run.first :] for key in known]).reshape(len(known), run.samples)
        places[run.name] = len(priors) + np.arange(len(known))
        priors += known.values()
    return SparseRows(values, places, len(priors)), np.array(priors)


def table_nuisance(runs: Sequence[ScoredRun], view: ModelView, network: NetworkSpec) -> tuple[SparseRows, Array]:
    """Bends of fitted tables of force over velocity between two knots, which the fit cannot follow; any size may be.

    A table over deflection has causes of its own that bend it.
    """
    tables = [np.array(at) for branch in network.root.members for at in _fitted_knots(branch)]
    rows = {run.name: _bends(tables, view.velocity(run.name)[run.first :]) for run in runs}
    bends = SparseRows.of(rows)
    return bends, np.full(bends.size, ANY)


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

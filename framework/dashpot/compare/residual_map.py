"""The two variables that explain the residual best, and the mean residual over them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.compare.levels import ORDER, ROUNDING, levelled
from dashpot.compare.strokes import Seen
from dashpot.data.declaration import SETTING_UNITS
from dashpot.text.quantity import base_unit, factor

Array = NDArray[np.float64]

BINS = 12
MOST = 40_000  # samples in all
BLOCKS = 16  # of each run: means are taken from every other one and judged on those between
FEWEST = 5  # samples of a bin
# variables of each sample, with their units
UNITS = {
    "deflection": "m",
    "velocity": "m/s",
    "speed": "m/s",
    "travel since reversal": "m",
    "distance since reversal": "m",
    "place of the last reversal": "m",
    "simulated force": "N",
    "time": "s",
    "amplitude": "m",
    "preload": "m",
    "order of tests": "",
}
OF_SAMPLES = (
    "deflection",
    "velocity",
    "speed",
    "travel since reversal",
    "distance since reversal",
    "place of the last reversal",
    "time",
)
NO_VARIABLES = ("warm_up", "start", "stop", "duration", "amplitude", "preload")


def residual_maps(seen: Sequence[Seen]) -> list[dict[str, Any]]:
    """For each simulation the mean residual (measured less simulated, N) over the two variables that explain most.

    ``label``; ``x`` and ``y``: each ``name``, ``unit`` and ``edges`` in that unit, which is SI or, of a free setting,
    that in which it was told; ``mean`` (ny, nx) N, NaN where there are few samples; ``explained``: the share of
    the mean square of the residual that such a map predicts on stretches of the runs that it was not made of;
    ``singles``: that share for each variable alone.
    """
    labels = list(dict.fromkeys(label for each in seen for label in each.forces if label != "measured"))
    rows = [_rows(each, MOST // len(seen)) for each in seen]
    variables = _variables(seen, rows)
    taught = np.concatenate(
        [(part * BLOCKS // each.run.time.size) % 2 == 0 for part, each in zip(rows, seen, strict=True)]
    )
    places = {name: _bins(values) for name, values in variables.items()}
    units = _units_of_settings(seen)
    return [_map(label, *_forces(label, seen, rows), places, taught, units) for label in labels]


def _units_of_settings(seen: Sequence[Seen]) -> dict[str, str]:
    """The units in which settings were told, of those that all runs tell in one unit."""
    told = [(name, unit) for each in seen for name, unit in each.run.units.items()]
    units = dict(told)
    return {name: unit for name, unit in units.items() if all(one == unit for other, one in told if other == name)}


def _rows(seen: Seen, most: int) -> NDArray[np.intp]:
    count = seen.run.time.size - seen.first
    return np.unique(np.linspace(seen.first, seen.run.time.size - 1, min(count, most)).astype(np.intp))


def _forces(label: str, seen: Sequence[Seen], rows: Sequence[NDArray[np.intp]]) -> tuple[Array, Array]:
    """The measured and the simulated force at all chosen samples, NaN in runs that were not simulated."""
    measured = [each.forces["measured"][part] for each, part in zip(seen, rows, strict=True)]
    simulated = [
        each.forces[label][part] if label in each.forces else np.full(part.size, np.nan)
        for each, part in zip(seen, rows, strict=True)
    ]
    return np.concatenate(measured), np.concatenate(simulated)


def _variables(seen: Sequence[Seen], rows: Sequence[NDArray[np.intp]]) -> dict[str, Array]:
    """Every variable that varies, at all chosen samples: of conditions those that differ between runs."""
    parts = [_of_run(each, part) for each, part in zip(seen, rows, strict=True)]
    common = [name for name in parts[0] if all(name in part for part in parts)]
    joined = {name: np.concatenate([part[name] for part in parts]) for name in common}
    found = {name: values if name in OF_SAMPLES else levelled(name, values, seen) for name, values in joined.items()}
    return {name: values for name, values in found.items() if np.ptp(values) > ROUNDING * np.abs(values).max()}


def _of_run(seen: Seen, rows: NDArray[np.intp]) -> dict[str, Array]:
    x, v = seen.displacement[rows], seen.velocity[rows]
    last = seen.edges[np.searchsorted(seen.edges, rows, side="right") - 1]
    whole: Mapping[str, float] = {
        "amplitude": seen.amplitude,
        "preload": seen.preload,
        ORDER: float(seen.run.order + 1),
        **{name: value for name, value in seen.run.settings.items() if name not in NO_VARIABLES},
    }
    reversal = seen.displacement[last]
    own = {"deflection": x, "velocity": v, "speed": np.abs(v), "time": seen.run.time[rows]}
    own |= {"travel since reversal": x - reversal, "distance since reversal": np.abs(x - reversal)}
    own |= {"place of the last reversal": reversal}
    return own | {name: np.full(rows.size, float(value)) for name, value in whole.items()}


def _bins(values: Array) -> tuple[Array, NDArray[np.intp]]:
    """Edges (k + 1,) of bins with equally many samples, or of one bin for each of a few values; and the bin of each."""
    levels = np.unique(values)
    if levels.size <= BINS:
        between = 0.5 * (levels[1:] + levels[:-1])
        edges = np.concatenate([[2 * levels[0] - between[0]], between, [2 * levels[-1] - between[-1]]])
    else:
        edges = np.unique(np.quantile(values, np.linspace(0.0, 1.0, BINS + 1)))
    return edges, np.clip(np.searchsorted(edges, values, side="right") - 1, 0, edges.size - 2)


def _map(
    label: str,
    measured: Array,
    simulated: Array,
    places: Mapping[str, tuple[Array, NDArray[np.intp]]],
    taught: NDArray[np.bool_],
    units: Mapping[str, str],
) -> dict[str, Any]:
    known = np.isfinite(measured - simulated)
    measured, simulated, taught = measured[known], simulated[known], taught[known]
    residual = measured - simulated
    kept = {name: (edges, place[known]) for name, (edges, place) in places.items()}
    if np.ptp(simulated) > 0.0:
        kept["simulated force"] = _bins(simulated)
    singles = {name: _explained(residual, place, taught) for name, (_, place) in kept.items()}
    shares = {pair: _explained(residual, _joint(kept, pair), taught) for pair in combinations(kept, 2)}
    x, y = max(shares, key=lambda pair: shares[pair])
    wide, high = kept[x][0].size - 1, kept[y][0].size - 1
    place = kept[x][1] + wide * kept[y][1]
    hits = np.bincount(place, minlength=wide * high)
    means = np.where(hits >= FEWEST, np.bincount(place, residual, wide * high) / np.maximum(hits, 1), np.nan)
    told = {which: _variable(name, kept[name][0], units.get(name, "")) for which, name in (("x", x), ("y", y))}
    return {"label": label, **told, "mean": means.reshape(high, wide), "explained": shares[x, y], "singles": singles}


def _variable(name: str, edges: Array, told: str) -> dict[str, Any]:
    """A variable as it is told; ``edges`` are in SI, ``told`` is the unit of a free setting."""
    unit = UNITS.get(name, SETTING_UNITS.get(name))
    if unit is not None or not told:
        return {"name": name, "unit": unit or "", "edges": edges}
    size, zero = factor(told, base_unit(told))
    return {"name": name, "unit": told, "edges": (edges - zero) / size}


def _joint(places: Mapping[str, tuple[Array, NDArray[np.intp]]], pair: tuple[str, str]) -> NDArray[np.intp]:
    (edges, one), (_, other) = (places[name] for name in pair)
    return one + (edges.size - 1) * other


def _explained(residual: Array, place: NDArray[np.intp], taught: NDArray[np.bool_]) -> float:
    count = int(place.max()) + 1
    hits = np.bincount(place[taught], minlength=count)
    means = np.bincount(place[taught], residual[taught], count) / np.maximum(hits, 1)
    whole = float(np.sum(residual[~taught] ** 2))
    left = float(np.sum((residual[~taught] - means[place[~taught]]) ** 2))
    return 1.0 - left / whole if whole > 0.0 else 0.0

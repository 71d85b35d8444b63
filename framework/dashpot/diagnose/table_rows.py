"""Rows of tables of dynamic stiffness in a diagnosis: each counts as two values, F' and F'' of the fundamental.

A row is a steady sine of which the fundamental of the force is known alone; its residual, and what a number, a term or
a candidate does to it, are complex stiffnesses times the amplitude, in N. What is a run in records is a curve over the
frequency here: it weighs by the error of the model on it, its rows by their stated scatter, or all alike, and curves
are left out in turn, or where there are few of them bands of frequency.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dashpot.data.dataset import Dataset
from dashpot.data.excitation import ORDER
from dashpot.data.history import NOTHING
from dashpot.data.steady import STEADY
from dashpot.diagnose.folds import FEWEST, MOST, Folds, folds_of
from dashpot.diagnose.whitening import ROW, Noise, independent_share, reduction
from dashpot.fit.scored import ScoredRun
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError, Place

Array = NDArray[np.float64]

SHOWN = 1e-6  # of the peak of a force: a fundamental that is smaller is one of rounding and of what still fades
LONG = 4  # rows of a curve whose error is known by itself
MOVED = "harmonic"  # the kind of a row as causes see it: with its mean and its harmonics


def is_row(run: ScoredRun) -> bool:
    """Whether a run is a row of a table."""
    return run.kind == STEADY


def diagnosed(spec: NetworkSpec, dataset: Dataset) -> Dataset:
    """The runs that a diagnosis of a network takes: of one with nodes the records alone.

    Raises InputError where there is nothing but a few rows of tables, or nothing but rows for a network with nodes.
    """
    recorded = [run.name for run in dataset.runs if run.kind != STEADY]
    if spec.joints and not recorded:
        raise InputError.at(
            Place(dataset.name),
            f"a diagnosis of tables needs a network between two ends, '{spec.name}' has nodes",
            "give runs over time, or fit and compare networks on the tables",
        )
    if not recorded and len(dataset.runs) < FEWEST:
        raise InputError.at(
            Place(dataset.name),
            f"a diagnosis of tables needs {FEWEST} rows or more, got {len(dataset.runs)}",
            "add rows at other frequencies, amplitudes or preloads, or runs over time",
        )
    return dataset.select(recorded) if spec.joints and len(recorded) < len(dataset.runs) else dataset


def moved(runs: Sequence[ScoredRun]) -> list[ScoredRun]:
    """The runs as they move and answer, rows with the whole of their force."""
    return [replace(run, kind=MOVED) if is_row(run) else run for run in runs]


def records(runs: Sequence[ScoredRun]) -> list[ScoredRun]:
    """The runs that were recorded over time."""
    return [run for run in runs if not is_row(run)]


def shown(run: ScoredRun, forces: Array) -> Array:
    """Forces (k, n) in N as the measurement would know them, warm-up cut off; zero where it would show none of one."""
    if not is_row(run):
        return forces[:, run.first :]
    seen = run.seen(forces)[:, run.first :]
    seen[np.max(np.abs(seen), axis=1) < SHOWN * np.max(np.abs(forces), axis=1)] = 0.0
    return seen


def step_of(run: ScoredRun, highest_frequency: float) -> int:
    """Over how many samples a run is averaged; ``ROW`` for a row, of which two values are kept."""
    return ROW if is_row(run) else reduction(run.drive.dt, highest_frequency)


def groups_of(runs: Sequence[ScoredRun], groups: Mapping[str, str]) -> dict[str, str]:
    """What is left out together, by run: rows in curves or bands of them, records in their ``groups``."""
    rows = [run for run in runs if is_row(run)]
    return {run.name: groups[run.name] for run in records(runs)} | bands_of(rows)


def bands_of(rows: Sequence[ScoredRun]) -> dict[str, str]:
    """The curve of each row, at one table, amplitude, preload and so on; of few curves the bands of frequency."""
    curves = curves_of(rows)
    pieces = -(-FEWEST // len(curves)) if curves and len(curves) < FEWEST else 1
    found: dict[str, str] = {}
    for name, curve in curves.items():
        for band, part in enumerate(np.array_split(np.arange(len(curve)), min(pieces, len(curve)))):
            found |= {curve[k].name: f"{name}, band {band + 1}" if pieces > 1 else name for k in part}
    return found


def curves_of(rows: Sequence[ScoredRun]) -> dict[str, list[ScoredRun]]:
    """Rows that differ in frequency alone, by increasing frequency, under the name of the first one."""
    found: dict[tuple[object, ...], list[ScoredRun]] = {}
    for run in sorted(rows, key=_frequency):
        found.setdefault(_conditions(run), []).append(run)
    return {f"rows like {curve[0].name}": curve for curve in found.values()}


def _frequency(run: ScoredRun) -> float:
    return run.excitation.settings["frequency"]


def _conditions(run: ScoredRun) -> tuple[object, ...]:
    settings = run.excitation.settings
    kept = {key: value for key, value in settings.items() if key not in {"frequency", ORDER, *NOTHING}}
    return table_of(run), *sorted(kept.items())


def table_of(run: ScoredRun) -> str:
    """The name of the table that a row stands in."""
    return run.name.rpartition("-")[0]


def folds_with_rows(runs: Sequence[ScoredRun], groups: Mapping[str, str]) -> Folds:
    """The folds of records and rows; ``groups`` names for each record the group of its repeats."""
    recorded, rows = records(runs), [run for run in runs if is_row(run)]
    found = folds_of(recorded, groups) if recorded else Folds((), 0, {})
    if not rows:
        return found
    bands = bands_of(rows)
    known = list(dict.fromkeys(bands.values()))[:MOST]
    number = {band: len(found.names) + k % MOST for k, band in enumerate(dict.fromkeys(bands.values()))}
    parts = {run.name: ((0.0, 1.0), (number[bands[run.name]],)) for run in rows}
    return Folds((*found.names, *known), found.groups + len(curves_of(rows)), {**found.parts, **parts})


def weighed(noise: Noise, residual: Mapping[str, Array], runs: Sequence[ScoredRun]) -> Noise:
    """A noise in which rows have the error of their curve, by their weights, from residuals (2,) in N.

    Rows of a curve whose residuals follow from one another count as fewer, as samples of a record do.
    """
    filters, shares = dict(noise.filters), dict(noise.independent)
    for rows in _weighed_alike(runs):
        roots = np.sqrt([row.weight for row in rows])
        left = np.array([residual[row.name] for row in rows]) * roots[:, None]
        smallest = max(abs(row.force).max() for row in rows) * SHOWN
        error, share = max(float(np.sqrt(np.mean(left**2))), smallest), independent_share(left.T.ravel())
        for row, root in zip(rows, roots, strict=True):
            filters[row.name], shares[row.name] = _white(filters[row.name], error / root), share
    return replace(noise, filters=filters, independent=shares)


def stated(noise: Noise, sheets: Mapping[str, Mapping[str, float]], runs: Sequence[ScoredRun]) -> Noise:
    """A noise of records in which rows have the scatter that their table states."""
    told = {run.name: sheets[run.name]["noise"] for run in runs if is_row(run) and "noise" in sheets.get(run.name, {})}
    return replace(noise, filters={**noise.filters, **{run: _white(noise.filters[run], told[run]) for run in told}})


def _white(like: Array, deviation: float) -> Array:
    found = np.zeros_like(like)
    found[0] = 1.0 / deviation
    return found


def _weighed_alike(runs: Sequence[ScoredRun]) -> list[list[ScoredRun]]:
    """The rows of each curve; those of curves that are too short for an error of their own, by table."""
    found: dict[str, list[ScoredRun]] = {}
    for name, curve in curves_of([run for run in runs if is_row(run)]).items():
        found.setdefault(name if len(curve) >= LONG else table_of(curve[0]), []).extend(curve)
    return list(found.values())

"""Strokes of a sliding seal on an even clock: what its owners call the friction, as a file for each run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

import numpy as np

FOLDER = "seal_friction_pneumatic"
PISTON_AREA = np.pi * 12.85e-3**2
RATE = 100.0
START_ROWS = 15  # settings of the logger, which the owners drop too


def write_strokes(measured: Path, folder: Path, entries: Iterable[Mapping[str, object]]) -> None:
    """Write the cycles that each entry names by its file, ``O-ring257_3bar-4.csv`` being the fourth of that record."""
    for entry in entries:
        record, _, number = str(entry["file"]).removesuffix(".csv").rpartition("-")
        table = cycles(measured / f"{record}.csv")[int(number)]
        np.savetxt(folder / str(entry["file"]), table, "%.6g", ",", header="time,displacement,force", comments="")


@cache
def cycles(path: Path) -> list[np.ndarray]:
    """Each forth and back of a record as a table of time s, displacement mm and friction N.

    The friction is the measured force less pressure times the area of the piston.
    """
    rows = np.loadtxt(path)[START_ROWS:]
    clock = rows[:, 0] / 1e3
    time = np.arange(clock[0], clock[-1], 1.0 / RATE)
    displacement = np.interp(time, clock, rows[:, 4])
    friction = np.interp(time, clock, rows[:, 6] - 1e5 * PISTON_AREA * rows[:, 5])
    turns = _lower_turns(displacement)
    return [
        np.stack([time[a:b] - time[a], displacement[a:b], friction[a:b]], axis=1)
        for a, b in zip(turns[:-1], turns[1:], strict=True)
    ]


def _lower_turns(displacement: np.ndarray) -> np.ndarray:
    """Where the motion turns at its lower end: the lowest sample between two visits of its upper third."""
    low, high = displacement.min(), displacement.max()
    upper = np.flatnonzero(displacement > low + (high - low) * 2.0 / 3.0)
    leaves = np.flatnonzero(np.diff(upper) > 1)
    visits = [(upper[k], upper[k + 1]) for k in leaves]
    deep = [(a, b) for a, b in visits if displacement[a:b].min() < low + (high - low) / 3.0]
    return np.array([a + int(np.argmin(displacement[a:b])) for a, b in deep])

"""A table of dynamic stiffness as text, in the form in which it can be read again."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from dashpot.data.run import Run
from dashpot.data.steady import harmonic_of
from dashpot.data.stiffness_table import CONDITIONS, UNITS

Array = NDArray[np.float64]

ANSWERS = {"storage": "N/m", "loss": "N/m", "stiffness": "N/m", "loss_angle": "deg"}


def table_text(rows: Iterable[tuple[Run, Array]]) -> str:
    """Rows of tables, each with its simulated force (n,) in N, as CSV with a line of units.

    Conditions, simulated stiffness, and the one of the table behind ``measured``; numbers as the shortest texts that
    read back alike.
    """
    found = [{**run.settings, **_answers(run, force), **_answers(run, run.force, "measured_")} for run, force in rows]
    names = list(dict.fromkeys([*CONDITIONS, *(name for row in found for name in row)]))
    units = [{**UNITS, **ANSWERS}.get(name.removeprefix("measured_"), "1") for name in names]
    lines = [",".join("" if name not in row else repr(float(row[name])) for name in names) for row in found]
    return "\n".join([",".join(names), ",".join(units), *lines]) + "\n"


def _answers(run: Run, force: Array, prefix: str = "") -> dict[str, float]:
    found = complex(harmonic_of(force)) / run.settings["amplitude"]
    values = (found.real, found.imag, abs(found), float(np.degrees(np.angle(found))))
    return {prefix + name: value for name, value in zip(ANSWERS, values, strict=True)}

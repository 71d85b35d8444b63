"""The tables of a balance of energy."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from dashpot.kernel.energy import EnergyBalance
from dashpot.report.parts import Column, Grid

STORED, DISSIPATED = Column("stored", "stored", "J", 4), Column("dissipated", "dissipated", "J", 4)
ERROR = Column("error", "error", "J", 2)


def runs_grid(balances: Sequence[EnergyBalance]) -> Grid:
    """Every run: the work put in, and where it is at the end."""
    columns = [
        Column("run", "run"),
        Column("put_in", "put in", "J", 4),
        STORED,
        DISSIPATED,
        Column("missing", "missing", "J", 2),
        ERROR,
    ]
    keys = [column.key for column in columns]
    rows = [{key: getattr(balance, key) for key in keys} for balance in balances]
    caption = "missing: taken away by the time steps; error: estimated from halving them"
    return Grid("Energy", columns, rows, caption, "energy_runs.csv")


def parts_grid(balances: Sequence[EnergyBalance]) -> Grid:
    """Every branch and every mass in every run: the work done on it, and where it is at the end."""
    columns = [
        Column("run", "run"),
        Column("name", "part"),
        Column("word", "element"),
        Column("work", "work", "J", 4),
        STORED,
        DISSIPATED,
        ERROR,
    ]
    return Grid("Energy of every part", columns, list(_parts(balances)), csv_name="energy.csv")


def _parts(balances: Sequence[EnergyBalance]) -> Iterator[dict[str, Any]]:
    for balance in balances:
        for share in (*balance.branches, *balance.masses):
            keys = ("name", "word", "work", "stored", "dissipated", "error")
            yield {"run": balance.run, **{key: getattr(share, key) for key in keys}}

"""What ``--energy`` adds to a simulation."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from dashpot.cli.output import Results
from dashpot.cli.talk import Talk

if TYPE_CHECKING:
    from dashpot.data.excitation import Excitation
    from dashpot.model.network import NetworkSpec

FILE = "energy.csv"


def write_energies(network: NetworkSpec, runs: Iterable[Excitation], results: Results, talk: Talk) -> None:
    """Write the energy of every part in every run, and say that of the runs; a run that fails is warned of."""
    from dashpot.kernel.energy import EnergyCounter
    from dashpot.report.energy import parts_grid, runs_grid
    from dashpot.report.tables import plain_table, to_csv

    counter, balances = EnergyCounter.of(network), []
    for run in runs:
        try:
            balances.append(counter.balance(run))
        except ArithmeticError as error:
            talk.warn(str(error))
    grid = parts_grid(balances)
    results.write(FILE, to_csv(grid.rows, grid.columns))
    talk.say(plain_table(runs_grid(balances)))

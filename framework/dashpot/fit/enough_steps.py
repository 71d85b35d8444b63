"""How many time steps the runs of a fit need, so that its numerical error is within the tolerance of a simulation.

It is known wherever a fit is linearised, of the lane it is linearised at: by how far its own long and short steps agree
or, where they do not, by a solution with twice as many. All lanes of a block take the same steps,
so that their differences are derivatives. Steps that were needed once stay; what was measured to be enough is taken for
enough where long and short steps agree as well. A search begins with what the numbers of
the file need for a tenfold tolerance: it compares lanes that differ by more. What is told of a file takes the steps of
its simulation.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import CompiledNetwork
from dashpot.kernel.solution import Solution
from dashpot.kernel.system import CompiledSystem
from dashpot.kernel.within import TOLERANCE, solve_within, steps_within, told_error

Array = NDArray[np.float64]

SEARCHED = 10.0 * TOLERANCE
FINEST = 8  # times as many steps as usual at most: a fit takes no more than eight times as long

# the numbers of runs whose forces were measured together
Team = tuple[int, ...]


class EnoughSteps:
    """The steps of each team of ``runs``; a network without unknown nodes needs none.

    ``as_simulated``: those that a simulation of the numbers of the file takes, in place of those of a search.
    """

    def __init__(
        self, network: CompiledNetwork | CompiledSystem, runs: Sequence[ScoredRun], as_simulated: bool = False
    ) -> None:
        self.network, self.runs, self.as_simulated = network, runs, as_simulated
        self._refine: dict[Team, int] = {}
        self._enough: dict[Team, float] = {}

    def of(self, team: Team) -> int:
        """How many times as many steps as usual, for now."""
        if team not in self._refine and self.as_simulated and isinstance(self.network, CompiledSystem):
            self._refine[team] = solve_within(self.network, self.runs[team[0]].excitation).refine
        elif team not in self._refine:
            self.suffice(team, self.network.start, SEARCHED)
        return self._refine[team]

    def tell(self, team: Team, solution: Solution, values: Array) -> bool:
        """Whether the steps by which a team was solved, the first lane at ``values`` (slots,), are enough for that.

        If the solution does not tell, it is measured; then the steps may be more from now on.
        """
        before, told = self.of(team), told_error(solution)
        if told > max(TOLERANCE, self._enough.get(team, 0.0)):
            self.suffice(team, values)
            self._enough[team] = told if self.of(team) == before and np.isfinite(told) else 0.0
        return self.of(team) == before

    def suffice(self, team: Team, values: Array, tolerance: float = TOLERANCE) -> None:
        """See to it that the steps are enough for a lane (slots,)."""
        before, needed = self._refine.get(team, 1), 1
        if isinstance(self.network, CompiledSystem) and before < FINEST:
            needed = steps_within(self.network, self.runs[team[0]].excitation, values, tolerance, FINEST)
        self._refine[team] = max(before, needed)

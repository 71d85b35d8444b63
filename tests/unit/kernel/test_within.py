"""Which of several solutions is taken."""

import numpy as np
import pytest

from dashpot.kernel.solution import Solution, Status
from dashpot.kernel.within import solve_within


class Made:
    """A network whose force errs by the length of a step, and that is solved with some refinements only."""

    def __init__(self, unsolved: set[int]) -> None:
        self.unsolved = unsolved

    def prepare(self, excitation, refine=1):
        return refine

    def solve(self, refine, values=None):
        force, status = np.full((1, 1, 10), 100.0 + 50.0 / refine), Status.GOOD
        if refine in self.unsolved:
            force, status = np.nan * force, Status.UNSOLVED
        return Solution(("base",), (), force, np.zeros((1, 0, 10)), np.zeros((1, 1)), (status,))


@pytest.mark.parametrize(
    ("unsolved", "refine", "status"),
    [
        (set(), 16, Status.GOOD),
        ({16}, 8, Status.GOOD),
        ({8, 16}, 4, Status.GOOD),
        ({4}, 16, Status.GOOD),
        ({2, 8}, 16, Status.GOOD),
        ({1, 2, 4, 8, 16}, 16, Status.UNSOLVED),
    ],
)
def test_the_finest_solution_is_taken_that_can_be_had(unsolved, refine, status):
    """With a tolerance that none is within; its error is what halving the steps has moved it by, twice."""
    found = solve_within(Made(unsolved), None, tolerance=1e-9, finest=16)
    assert (found.refine, found.solution.status) == (refine, (status,))
    if refine // 2 not in unsolved and status is Status.GOOD:
        assert found.error[0] == pytest.approx(2.0 * 50.0 / refine)

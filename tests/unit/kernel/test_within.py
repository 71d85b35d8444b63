"""Which of several solutions is taken."""

import numpy as np
import pytest

from dashpot.kernel.solution import Solution, Status
from dashpot.kernel.within import bound, solve_within


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


@pytest.mark.parametrize(
    ("changes", "error"),
    [
        ([1.0], 2.0),
        ([8.0, 4.0, 2.0, 1.0], 2.0),
        ([1.0, 1.0 / 16.0], 2.0 / 16.0),
        # two solutions agree by chance: no change falls by more than the order of the steps, four, allows
        ([1.0, 0.0], 2.0 / 16.0),
        ([1.0, 0.5, 0.0], 1.0 / 16.0),
        # nothing converges, though the last change happens to be small
        ([1.0, 0.9, 0.3], 2.0),
        ([0.3, 1.0, 0.6], 2.0),
        ([9.0, 1.0, 0.9, 0.3], 2.0),
        # of solutions that failed nothing is told
        ([np.nan, 1.0], 2.0),
        ([np.nan, np.nan, 0.5], 1.0),
    ],
)
def test_a_bound_is_twice_the_last_change_where_the_changes_fall_as_they_should(changes, error):
    assert bound([np.array([change]) for change in changes]) == pytest.approx([error])


def test_a_solution_that_failed_has_no_bound():
    assert np.isnan(bound([np.array([1.0]), np.array([np.nan])])).all()


def test_the_bound_holds_for_changes_that_fall_by_a_third_or_more():
    """Solutions that approach the true one geometrically, of which the sum of all that follow is known."""
    for factor in np.linspace(0.05, 2.0 / 3.0, 14):
        changes = [np.array([factor**number]) for number in range(6)]
        still_to_come = changes[-1] * factor / (1.0 - factor)
        assert bound(changes) >= (1.0 - 1e-12) * still_to_come

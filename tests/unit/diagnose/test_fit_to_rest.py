"""The first fit of a diagnosis is made again where it did not converge, or converged to something absurd."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from dashpot.diagnose.diagnose import fit_to_rest
from dashpot.fit.refine import Outcome

SWING = 400.0


def fits(*errors: tuple[float, Outcome]):
    """What the attempts come to, one after the other."""
    return lambda attempt: SimpleNamespace(
        errors=SimpleNamespace(train=errors[attempt][0]),
        ending=errors[attempt][1].value,
        declared=SimpleNamespace(name="axle"),
    )


def test_a_sound_fit_counts_at_once_and_nothing_is_said():
    found, remarks = fit_to_rest(fits((50.0, Outcome.CONVERGED)), SWING)
    assert (found.errors.train, remarks) == (50.0, [])


@pytest.mark.parametrize(
    ("first", "reason"),
    [
        ((1613.0, Outcome.CONVERGED), "its RMSE is 1.61e+03 N where the forces vary by 400 N"),
        ((60.0, Outcome.STEPS_SPENT), "largest number of steps"),
    ],
)
def test_another_start_is_made_after_one_that_failed(first, reason):
    found, (remark,) = fit_to_rest(fits(first, (50.0, Outcome.CONVERGED)), SWING)
    assert found.errors.train == 50.0
    assert reason in remark and "of 2 starts the best counts, the last one converged" in remark


def test_the_best_of_three_failures_counts_and_it_is_said():
    errors = ((1613.0, Outcome.CONVERGED), (900.0, Outcome.CONVERGED), (1200.0, Outcome.CONVERGED))
    found, (remark,) = fit_to_rest(fits(*errors), SWING)
    assert found.errors.train == 900.0 and "the last one also failed" in remark


def test_no_third_start_is_made_where_two_come_to_the_same_error():
    found, (remark,) = fit_to_rest(fits((50.01, Outcome.STEPS_SPENT), (50.0, Outcome.STEPS_SPENT)), SWING)
    assert found.errors.train == 50.0
    assert "of 2 starts the best counts, the last one came to the same error" in remark


def test_two_starts_that_come_to_the_same_absurd_error_are_not_enough():
    absurd = (900.0, Outcome.CONVERGED)
    found, (remark,) = fit_to_rest(fits(absurd, absurd, (60.0, Outcome.CONVERGED)), SWING)
    assert found.errors.train == 60.0 and "of 3 starts" in remark

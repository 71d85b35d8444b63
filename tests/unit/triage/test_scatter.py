"""The scatter of runs with few cycles: shared where runs are alike, their own where they are not."""

import numpy as np
import pytest

from dashpot.triage.scatter import moderated


def test_without_freedom_nothing_is_known():
    _, freedoms = moderated(np.zeros(2), np.zeros(2))
    assert np.all(freedoms == 0.0)


def test_a_single_run_with_freedom_keeps_its_own_and_tells_nothing_of_others():
    variances, freedoms = moderated(np.array([4.0, 0.0]), np.array([5.0, 0.0]))
    assert (variances[0], freedoms.tolist()) == (4.0, [5.0, 0.0])


def test_runs_that_scatter_alike_have_one_variance():
    variances, freedoms = moderated(np.array([1.0, 1.2, 0.9, 0.0]), np.array([2.0, 2.0, 4.0, 0.0]))
    assert variances[3] == pytest.approx((2.0 + 2.4 + 3.6) / 8.0)
    assert np.all(freedoms == 8.0)


def test_runs_that_scatter_unlike_keep_their_own():
    own = np.array([1e-6, 1e-2, 1.0, 1e4])
    variances, freedoms = moderated(own, np.full(4, 20.0))
    assert np.all(np.abs(np.log(variances / own)) < np.log(2.0))
    assert np.all(freedoms < 21.0)


def test_a_computed_run_without_any_scatter_is_no_trouble():
    variances, freedoms = moderated(np.array([0.0, 1e-4, 2e-4]), np.full(3, 4.0))
    assert np.all(np.isfinite(variances)) and np.all(freedoms >= 4.0)


def test_the_usual_variance_is_found_where_variances_differ_by_a_known_law():
    """Scaled inverse chi-square with 6 degrees of freedom about 4.0: what the runs say is worth about these."""
    rng = np.random.default_rng(11)
    true = 4.0 * 6.0 / rng.chisquare(6.0, 4000)
    variances, freedoms = moderated(
        np.append(true * rng.chisquare(3.0, 4000) / 3.0, 0.0), np.append(np.full(4000, 3.0), 0.0)
    )
    assert variances[-1] == pytest.approx(4.0, rel=0.1)
    assert freedoms[-1] == pytest.approx(6.0, rel=0.15)

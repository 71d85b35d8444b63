"""The mixed model against closed forms and populations drawn with known mean and scatter."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.campaign.mixed import fit_mixed

TRUTH = np.array([[0.05**2, 0.5 * 0.05 * 0.08], [0.5 * 0.05 * 0.08, 0.08**2]])
MEANS = np.array([[12.0, 6.0], [-0.03, 0.02]])


def drawn(rng: np.random.Generator, count: int):
    """Numbers, their errors, the design; every specimen has errors of its own."""
    design = np.column_stack([np.ones(count), rng.normal(size=count)])
    design[:, 1] -= design[:, 1].mean()
    sizes = rng.uniform(0.005, 0.05, (count, 2))
    errors = np.array([np.outer(size, size) * [[1.0, 0.3], [0.3, 1.0]] for size in sizes])
    noise = np.array([rng.multivariate_normal(np.zeros(2), each) for each in errors])
    return design @ MEANS + rng.multivariate_normal(np.zeros(2), TRUTH, count) + noise, errors, design


def test_without_errors_it_is_the_sample_mean_and_covariance():
    rng = np.random.default_rng(4)
    at = rng.multivariate_normal([1.0, 2.0], TRUTH, 30)
    found = fit_mixed(at, 1e-14 * np.tile(np.eye(2), (30, 1, 1)), np.ones((30, 1)))
    assert found.means[0] == pytest.approx(at.mean(axis=0), rel=1e-9)
    assert found.between == pytest.approx(np.cov(at.T), rel=1e-6)
    assert found.widths[0] == pytest.approx(2.04523 * at.std(axis=0, ddof=1) / np.sqrt(30.0), rel=1e-5)


def test_with_equal_errors_they_are_taken_off_the_scatter():
    # the moment estimate of a balanced one-way layout is the restricted maximum likelihood
    rng = np.random.default_rng(5)
    at = rng.normal(0.0, 0.1, (25, 1))
    found = fit_mixed(at, np.full((25, 1, 1), 0.03**2), np.ones((25, 1)))
    assert found.between[0, 0] == pytest.approx(at.var(ddof=1) - 0.03**2, rel=1e-5)


def test_specimens_alike_within_their_errors_do_not_scatter():
    at = np.array([[1.0], [1.001], [0.999], [1.0005], [0.9995]])
    found = fit_mixed(at, np.full((5, 1, 1), 0.05**2), np.ones((5, 1)))
    assert np.sqrt(found.between[0, 0]) < 0.005
    assert found.scatter[0, 0] == 0.0


def test_a_specimen_that_does_not_count_changes_nothing():
    at, errors, design = drawn(np.random.default_rng(6), 20)
    at[3] += 5.0
    weights = np.where(np.arange(20) == 3, 0.0, 1.0)
    kept = np.arange(20) != 3
    with_it, without = fit_mixed(at, errors, design, weights), fit_mixed(at[kept], errors[kept], design[kept])
    assert with_it.means == pytest.approx(without.means, rel=1e-6)
    assert with_it.between == pytest.approx(without.between, rel=1e-4)


def test_intervals_hold_the_truth_as_often_as_they_say():
    rng = np.random.default_rng(seed_of("mixed effects"))
    fits = [fit_mixed(*drawn(rng, 30)) for _ in range(100)]
    sizes = np.sqrt(TRUTH.diagonal())
    means = np.mean([np.abs(fit.means - MEANS) <= fit.widths for fit in fits])
    scatter = np.mean([(fit.scatter[:, 0] <= sizes) & (sizes <= fit.scatter[:, 1]) for fit in fits])
    # four standard deviations of the binomial at 95 %, of 400 and 200 answers
    assert 0.907 <= means <= 0.993
    assert 0.889 <= scatter

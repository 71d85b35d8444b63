"""Intervals of strengths, where samples are independent and where they are not."""

import numpy as np
import pytest
from scipy.signal import lfilter

from dashpot.diagnose.jackknife import PIECES, interval_of, standard_errors

SAMPLES, DRAWS = 2400, 600
EDGES = np.linspace(0, SAMPLES, PIECES + 1).astype(int).tolist()
SHAPES = np.array([np.ones(SAMPLES), np.sin(2.0 * np.pi * 24.0 * np.arange(SAMPLES) / SAMPLES)])


def noise(memory, rng):
    """A first-order autoregressive process."""
    return lfilter([1.0], [1.0, -memory], rng.standard_normal(SAMPLES + 500))[500:]


def test_errors_under_white_noise_are_those_of_least_squares():
    rng = np.random.default_rng(0)
    squares = [standard_errors(noise(0.0, rng), SHAPES, EDGES) ** 2 for _ in range(DRAWS)]
    assert np.mean(squares, axis=0) == pytest.approx(1.0 / np.sum(SHAPES**2, axis=1), rel=0.1)


@pytest.mark.parametrize("memory", [0.0, 0.9])
def test_intervals_cover_95_percent_also_where_samples_follow_from_one_another(memory):
    """With 600 draws the standard error of the share is 0.9 %."""
    rng, covered = np.random.default_rng(1), []
    for _ in range(DRAWS):
        values = 3.0 * SHAPES[0] - 2.0 * SHAPES[1] + noise(memory, rng)
        strengths = np.linalg.lstsq(SHAPES.T, values, rcond=None)[0]
        errors = standard_errors(values, SHAPES, EDGES)
        ends = [interval_of(strength, error, PIECES) for strength, error in zip(strengths, errors, strict=True)]
        covered.append([low < true < high for (low, high), true in zip(ends, (3.0, -2.0), strict=True)])
    assert np.mean(covered, axis=0) == pytest.approx(0.95, abs=0.04)


def test_a_single_piece_tells_no_error():
    assert np.all(np.isinf(standard_errors(SHAPES[0], SHAPES, [0, SAMPLES])))

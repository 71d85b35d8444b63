"""Intervals of strengths, where samples are independent and where they are not."""

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import t

from dashpot.diagnose.jackknife import PIECES, half_widths

SAMPLES, DRAWS = 2400, 600
EDGES = np.linspace(0, SAMPLES, PIECES + 1).astype(int).tolist()
SHAPES = np.array([np.ones(SAMPLES), np.sin(2.0 * np.pi * 24.0 * np.arange(SAMPLES) / SAMPLES)])


def noise(memory, rng):
    """A first-order autoregressive process."""
    return lfilter([1.0], [1.0, -memory], rng.standard_normal(SAMPLES + 500))[500:]


def test_intervals_under_white_noise_are_those_of_least_squares():
    rng = np.random.default_rng(0)
    squares = [half_widths(noise(0.0, rng), SHAPES, EDGES) ** 2 for _ in range(DRAWS)]
    expected = t.ppf(0.975, PIECES - 1) ** 2 / np.sum(SHAPES**2, axis=1)
    assert np.mean(squares, axis=0) == pytest.approx(expected, rel=0.1)


@pytest.mark.parametrize(("memory", "pieces"), [(0.0, PIECES), (0.9, PIECES), (0.0, 3)])
def test_intervals_cover_95_percent_also_of_few_pieces_and_where_samples_follow_from_one_another(memory, pieces):
    """With 600 draws the standard error of the share is 0.9 %."""
    rng, covered = np.random.default_rng(1), []
    for _ in range(DRAWS):
        values = 3.0 * SHAPES[0] - 2.0 * SHAPES[1] + noise(memory, rng)
        strengths = np.linalg.lstsq(SHAPES.T, values, rcond=None)[0]
        covered.append(np.abs(strengths - [3.0, -2.0]) < half_widths(values, SHAPES, EDGES[:: PIECES // pieces]))
    assert np.mean(covered, axis=0) == pytest.approx(0.95, abs=0.04)


def test_a_single_piece_tells_no_interval():
    assert np.all(np.isinf(half_widths(SHAPES[0], SHAPES, [0, SAMPLES])))

"""Facts of the starting points."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from dashpot_optimizers.latin_hypercube import latin_hypercube, scatter


@given(st.integers(0, 2**32 - 1), st.integers(1, 50), st.integers(1, 6))
def test_every_interval_of_every_coordinate_holds_one_point(seed: int, points: int, size: int) -> None:
    block = latin_hypercube(np.random.default_rng(seed), points, size)
    slots = np.sort(np.floor(block * points).astype(int), axis=0)
    assert np.array_equal(slots, np.tile(np.arange(points)[:, None], (1, size)))


@given(st.integers(0, 2**32 - 1), st.integers(1, 9))
def test_scattered_points_begin_with_the_start(seed: int, points: int) -> None:
    start = np.array([0.1, 0.9])
    block = scatter(np.random.default_rng(seed), points, start)
    assert block.shape == (points, 2)
    assert np.array_equal(block[0], start)

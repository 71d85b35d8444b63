"""The noise of short runs with many suspects: unharmed where nothing is hidden, and what is hidden is taken out."""

import numpy as np

from dashpot.assess.noise import flat_noise
from dashpot.assess.projection import SparseRows
from dashpot.assess.screen import Columns
from dashpot.assess.selected import selected_residual

SAMPLES, MANY = 2000, 400


def slow(rng, count):
    """Columns that change slowly, many of them nearly alike."""
    time = np.arange(SAMPLES) / SAMPLES
    return np.sin(2.0 * np.pi * rng.uniform(0.0, 40.0, (count, 1)) * time + rng.uniform(0.0, 6.0, (count, 1)))


def columns_of(rng, strengths):
    tangents, bank = slow(rng, 3), slow(rng, MANY)
    noise = rng.standard_normal(SAMPLES)
    residual = {"a": noise + np.asarray(strengths) @ bank[: len(strengths)] + 5.0 * tangents[0]}
    rows = (SparseRows.dense({"a": each}) for each in (tangents, np.empty((0, SAMPLES)), bank))
    return Columns(residual, *rows, np.empty(0), ()), noise, tangents


def test_where_nothing_is_hidden_only_the_tangents_are_taken_out(rng):
    """At most three columns of four hundred pass by chance; fitting all would leave the noise 10 % too small."""
    columns, noise, tangents = columns_of(rng, [])
    left = selected_residual(columns, flat_noise({"a": 1.0}))["a"]
    plain = noise - np.linalg.lstsq(tangents.T, noise, rcond=None)[0] @ tangents
    assert np.sum(plain**2) - np.sum(left**2) < 3 * 4.0 * np.log(MANY)


def test_what_is_hidden_is_taken_out(rng):
    columns, noise, _ = columns_of(rng, [3.0, -2.0])
    left = selected_residual(columns, flat_noise({"a": 1.0}))["a"]
    assert np.sqrt(np.mean((left - noise) ** 2)) < 0.2

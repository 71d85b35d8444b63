"""A line in the spectra of all runs is found where it is and as large as it is, and none is found in noise."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.diagnose.leftover import SIGNIFICANT
from dashpot.diagnose.lines import strongest_line

STEP = 1e-3
LENGTHS = {"slow": 12000, "first": 5000, "second": 5000}
STEPS = dict.fromkeys(LENGTHS, STEP)


def hum(rng: np.random.Generator, samples: int, frequency: float, size: float) -> np.ndarray:
    phase = rng.uniform(0.0, 2.0 * np.pi)
    return np.sqrt(2.0) * size * np.sin(2.0 * np.pi * frequency * STEP * np.arange(samples) + phase)


def noise(rng: np.random.Generator) -> dict[str, np.ndarray]:
    return {run: rng.standard_normal(samples) for run, samples in LENGTHS.items()}


def test_a_line_of_another_phase_in_every_run_is_found_with_its_size(rng):
    frequency, size = rng.uniform(20.0, 400.0), rng.uniform(0.15, 2.0)
    white = {run: values + hum(rng, values.size, frequency, size) for run, values in noise(rng).items()}
    found = strongest_line(white, STEPS)
    assert found.frequency == pytest.approx(frequency, abs=0.05)
    assert found.score > SIGNIFICANT
    assert found.size == pytest.approx(size, rel=0.3)


def test_white_noise_has_no_line(rng):
    scores = [strongest_line(noise(rng), STEPS).score for _ in range(20)]
    assert 0.0 <= min(scores) and max(scores) < 5.0


def test_a_smooth_rise_of_the_spectrum_is_no_line(rng):
    white = {run: np.convolve(values, np.full(20, 0.2), mode="same") for run, values in noise(rng).items()}
    assert strongest_line(white, STEPS).score < SIGNIFICANT


def test_runs_too_short_for_any_line_show_none():
    found = strongest_line({"short": np.ones(2), "coarse": np.ones(3)}, {"short": 0.01, "coarse": 0.5})
    assert (found.score, found.size) == (0.0, 0.0)

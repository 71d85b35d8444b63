"""Runs that were moved alike are found by their motion."""

from __future__ import annotations

import numpy as np
from seeds import seed_of
from unit.fit.bench import kelvin_voigt, run

from dashpot.fit.alike import moved_alike


def test_proportional_motions_are_alike_at_any_preload_and_in_either_sense():
    runs = [
        run("plain", 1e-3, 5.0, kelvin_voigt),
        run("large", 3e-3, 5.0, kelvin_voigt),
        run("deep", 1e-3, 5.0, kelvin_voigt, middle=9e-3),
        run("opposite", -1e-3, 5.0, kelvin_voigt),
    ]
    assert moved_alike(runs) == [[0, 1, 2, 3]]


def test_noise_of_the_displacement_sensor_does_not_part_them():
    rng = np.random.default_rng(seed_of("test_alike"))
    runs = [run("one", 1e-3, 5.0, kelvin_voigt), run("two", 1e-3, 5.0, kelvin_voigt)]
    runs[1].drive.displacement[:] += 1e-5 * rng.standard_normal(runs[1].drive.samples)
    assert moved_alike(runs) == [[0, 1]]


def test_another_frequency_or_another_length_is_another_motion():
    runs = [
        run("one", 1e-3, 5.0, kelvin_voigt),
        run("other", 1e-3, 5.3, kelvin_voigt),
        run("late", 1e-3, 5.0, kelvin_voigt, first=300),
    ]
    assert moved_alike(runs) == [[0, 2], [1]]

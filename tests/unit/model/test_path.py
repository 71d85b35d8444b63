"""The memory of a cubic path against its integral."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from seeds import seed_of

from dashpot.model.element import Motion
from dashpot.model.path import SERIES_BELOW, fading_travel


def remembered(x: Motion, dt: float, time: float) -> float:
    def faded(s: float) -> float:
        u = s / dt
        bow = x.travel / dt - 0.5 * (x.velocity_old + x.velocity_new)
        velocity = x.velocity_old * (1 - u) + x.velocity_new * u + 6 * u * (1 - u) * bow
        return np.exp(-(dt - s) / time) * velocity

    # what fades within a small part of the step is looked at there
    return sum(
        quad(faded, low, high, epsabs=1e-17, epsrel=1e-12)[0]
        for low, high in ((0.0, max(dt - 40 * time, 0.0)), (max(dt - 40 * time, 0.0), dt))
    )


@pytest.mark.parametrize("ratio", [1e-9, 1e-3, 0.1, SERIES_BELOW * 0.999, SERIES_BELOW * 1.001, 2.0, 30.0, 1e3])
def test_it_is_the_integral_of_the_fading_velocity_for_every_ratio_of_step_and_time(ratio):
    rng = np.random.default_rng(seed_of("test_path"))
    for _ in range(5):
        old, new = rng.uniform(-1e-3, 1e-3, 2)
        x = Motion(old, new, *rng.uniform(-1.0, 1.0, 2), np.nan)
        expected = remembered(x, 1e-3, 1e-3 / ratio)
        scale = 1e-3 / max(ratio, 1.0)
        assert fading_travel(x, 1e-3, 1e-3 / ratio) == pytest.approx(expected, abs=2e-12 * scale)


def test_what_never_fades_is_the_travel():
    x = Motion(1e-3, 4e-3, 0.3, -0.2, np.nan)
    assert fading_travel(x, 1e-3, 1e12) == pytest.approx(3e-3, rel=1e-12)


def test_what_fades_at_once_is_the_last_velocity():
    x = Motion(1e-3, 4e-3, 0.3, -0.2, np.nan)
    assert fading_travel(x, 1e-3, 1e-9) == pytest.approx(-0.2 * 1e-9, rel=1e-3)

"""The end of the driven band, by the motions of rigs."""

from types import SimpleNamespace

import numpy as np
import pytest

from dashpot_causes.band import end_of_band

STEP = 1e-3
TIME = np.arange(20_000) * STEP


def view_of(**paths):
    """A view of runs with these displacements (n,) in m."""
    stroke = max(np.ptp(x) for x in paths.values())
    return SimpleNamespace(runs=tuple(paths), stroke=stroke, displacement=paths.get, step=lambda run: STEP,
                           velocity=lambda run: np.gradient(paths[run], STEP))  # fmt: skip


def linear_sweep(amplitude, stop):
    return amplitude * np.sin(np.pi * stop / TIME[-1] * TIME**2)


def log_sweep(amplitude, start, stop):
    rate = np.log(stop / start) / TIME[-1]
    return amplitude * np.sin(2.0 * np.pi * start / rate * np.expm1(rate * TIME))


@pytest.mark.parametrize(("path", "highest"), [
    (linear_sweep(1e-3, 30.0), 30.0),
    (log_sweep(1e-3, 0.5, 30.0), 30.0),
    (sum(1e-3 / f * np.sin(2.0 * np.pi * f * TIME + f**2) for f in np.arange(1.0, 31.0)), 30.0),
    (1e-3 * np.sin(2.0 * np.pi * 7.0 * TIME), 7.0),
    (1e-3 * TIME, 1.0 / (TIME.size * STEP)),
], ids=["linear", "logarithmic", "many_sines", "one_sine", "ramp"])  # fmt: skip
def test_it_is_the_end_of_a_sweep_and_the_fastest_of_many_sines(path, highest):
    assert end_of_band(view_of(run=path)) == pytest.approx(highest, rel=0.08)


def test_small_strokes_that_are_driven_faster_count_and_noise_does_not():
    noise = 1e-7 * np.random.default_rng().standard_normal(TIME.size)
    driven = {"wide": linear_sweep(10e-3, 5.0), "small": linear_sweep(0.5e-3, 40.0)}
    assert end_of_band(view_of(**driven, rest=noise)) == pytest.approx(40.0, rel=0.08)
    assert end_of_band(view_of(wide=driven["wide"], rest=noise)) == pytest.approx(5.0, rel=0.08)

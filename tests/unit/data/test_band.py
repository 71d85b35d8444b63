"""The end of the driven band, by the motions of rigs."""

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.band import end_of_band
from dashpot.data.drive import drive_from_samples
from dashpot.diagnose.proposals import Sweep, runs_to_choose_from
from dashpot.diagnose.view import ModelView
from dashpot.fit.scored import ScoredRun

STEP = 1e-3
TIME = np.arange(20_000) * STEP


def end_of(*paths):
    """The end of the band in Hz of runs with these displacements (n,) in m."""
    return end_of_band([drive_from_samples(STEP, path) for path in paths], max(np.ptp(path) for path in paths))


def linear_sweep(amplitude, stop):
    return amplitude * np.sin(np.pi * stop / TIME[-1] * TIME**2)


def log_sweep(amplitude, start, stop):
    rate = np.log(stop / start) / TIME[-1]
    return amplitude * np.sin(2.0 * np.pi * start / rate * np.expm1(rate * TIME))


@pytest.mark.parametrize(
    ("path", "highest"),
    [
        (linear_sweep(1e-3, 30.0), 30.0),
        (log_sweep(1e-3, 0.5, 30.0), 30.0),
        (sum(1e-3 / f * np.sin(2.0 * np.pi * f * TIME + f**2) for f in np.arange(1.0, 31.0)), 30.0),
        (1e-3 * np.sin(2.0 * np.pi * 7.0 * TIME), 7.0),
        (1e-3 * TIME, 1.0 / (TIME.size * STEP)),
    ],
    ids=["linear", "logarithmic", "many_sines", "one_sine", "ramp"],
)
def test_it_is_the_end_of_a_sweep_and_the_fastest_of_many_sines(path, highest):
    assert end_of(path) == pytest.approx(highest, rel=0.08)


def test_small_strokes_that_are_driven_faster_count_and_noise_does_not():
    noise = 1e-7 * np.random.default_rng(seed_of("test_band")).standard_normal(TIME.size)
    wide, small = linear_sweep(10e-3, 5.0), linear_sweep(0.5e-3, 40.0)
    assert end_of(wide, small, noise) == pytest.approx(40.0, rel=0.08)
    assert end_of(wide, noise) == pytest.approx(5.0, rel=0.08)


def test_further_runs_of_a_small_stroke_go_to_the_end_of_the_band_and_those_of_a_large_one_as_far_as_speed_allows():
    paths = {"wide": linear_sweep(10e-3, 5.0), "small": linear_sweep(0.5e-3, 40.0)}
    runs = {name: ScoredRun(name, "sweep", drive_from_samples(STEP, path), path, 0) for name, path in paths.items()}
    view = ModelView(runs, paths, {})
    sweeps = [run for run in runs_to_choose_from(view) if isinstance(run, Sweep)]
    ends = {round(1e3 * run.amplitude, 1): [] for run in sweeps}
    for run in sweeps:
        ends[round(1e3 * run.amplitude, 1)].append(run.stop)
        assert 2.0 * np.pi * run.stop * run.amplitude <= 1.501 * view.speed
    assert max(ends[1.0]) == pytest.approx(40.0, rel=0.08)
    assert max(ends[10.0]) == pytest.approx(1.5 * view.speed / (2.0 * np.pi * 10e-3), rel=1e-6)

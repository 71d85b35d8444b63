"""Misfits beside sensors within their data sheet: the chi square is that of the whole covariance."""

from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.assess.erring import beside_sensors, beyond_sensors, less_sensor_errors
from dashpot.assess.noise import ORDER, flat_noise

STEP, SAMPLES, WARM_UP, NOISE = 1e-3, 300, 50, 4.0
SHEET = {"gain": 2e-3, "zero": 1.5, "delay": 3e-5}


@pytest.fixture
def run():
    time = np.arange(SAMPLES) * STEP
    force = 4000.0 + 900.0 * np.sin(60.0 * time)
    return SimpleNamespace(name="a", force=force, drive=SimpleNamespace(dt=STEP), first=WARM_UP,
                           samples=SAMPLES - WARM_UP)  # fmt: skip


def test_chi_square_is_that_of_noise_and_errors_together(run):
    misfits = np.random.default_rng().normal(0.0, 5.0, (3, run.samples))
    white = beside_sensors(flat_noise({"a": NOISE}), [run], {"a": SHEET}, {"a": run.force}).whiten("a", misfits)
    kept = slice(ORDER, None)  # the first samples count nowhere
    force = run.force[WARM_UP:]
    shapes = np.array([2e-3 * force, np.full(force.size, 1.5), 3e-5 * np.gradient(run.force, STEP)[WARM_UP:]])[:, kept]
    covariance = NOISE**2 * np.eye(force.size - ORDER) + shapes.T @ shapes
    expected = [row @ np.linalg.solve(covariance, row) for row in misfits[:, kept]]
    assert np.sum(white**2, axis=1) == pytest.approx(expected, rel=1e-9)


def test_an_error_within_the_data_sheet_costs_little_and_one_beyond_it_much(run):
    whiten = beside_sensors(flat_noise({"a": NOISE}), [run], {"a": SHEET}, {"a": run.force}).whiten
    costs = [np.sum(whiten("a", np.full((1, run.samples), zero)) ** 2) for zero in (1.5, 150.0)]
    assert costs[0] < 1.0 and costs[1] > 100.0


def test_a_gain_that_all_runs_may_have_draws_no_model_to_smaller_noise():
    """By measured forces the 40 runs would have a gain of 0.4 %: their samples times the square of what is admitted."""
    rng, time = np.random.default_rng(), np.arange(4000) * STEP
    truth, slope, share = 4000.0 + 900.0 * np.sin(60.0 * time), 0.0, 0.0
    for _ in range(40):
        run = SimpleNamespace(name="a", force=truth + rng.normal(0.0, NOISE, time.size), samples=time.size, first=0,
                              drive=SimpleNamespace(dt=STEP))  # fmt: skip
        whiten = beside_sensors(flat_noise({"a": NOISE}), [run], {"a": {"gain": 1e-3}}, {"a": truth}).whiten
        misfit, change = whiten("a", run.force - truth), whiten("a", truth)
        slope, share = slope + misfit @ change, share + change @ change
    # the common gain that a model would take up; 0.1 % of a run over the root of 40 is its deviation
    assert abs(slope / share) < 5.0 * 1e-3 / np.sqrt(40.0)


def test_without_a_data_sheet_only_the_noise_counts(run):
    noise = flat_noise({"a": NOISE})
    assert beside_sensors(noise, [run], {}, {}) is noise


def test_what_errors_of_the_sensor_could_have_made_is_taken_out_of_a_misfit_and_nothing_else(run):
    rng = np.random.default_rng()
    force, rate = run.force[WARM_UP:], np.gradient(run.force, STEP)[WARM_UP:]
    errors = rng.uniform(-5.0, 5.0, 3) @ np.array([1e-3 * force, np.ones(force.size), 1e-4 * rate])
    other = rng.normal(0.0, NOISE, run.samples)
    with_errors, without = (less_sensor_errors([misfit], [run], {"a": SHEET})[0] for misfit in (other + errors, other))
    assert with_errors == pytest.approx(without, abs=1e-9)
    # of noise no more than three numbers are taken: 37 is beyond one in ten millions of chi square for three
    assert np.sum((other - without) ** 2) < 37.0 * NOISE**2


@pytest.mark.parametrize(("deviations", "left"), [(2.0, 0.0), (-10.0, -7.0)])
def test_of_an_error_only_what_the_data_sheet_admits_is_taken_out(run, deviations, left):
    """Three standard deviations."""
    misfit = np.full(run.samples, deviations * SHEET["zero"])
    (beyond,) = beyond_sensors([misfit], [run], {"a": {"zero": SHEET["zero"]}})
    assert beyond == pytest.approx(np.full(run.samples, left * SHEET["zero"]), abs=1e-6)


def test_without_a_data_sheet_a_misfit_stays_as_it_is(run):
    misfit = np.random.default_rng().normal(0.0, 5.0, run.samples)
    for taken_out in (less_sensor_errors, beyond_sensors):
        assert np.array_equal(taken_out([misfit], [run], {})[0], misfit)

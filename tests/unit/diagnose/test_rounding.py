"""A force that was recorded in coarse steps: the error of rounding is no law of the specimen."""

from dataclasses import replace

import numpy as np
import pytest
from unit.diagnose.rig import bench, causes, dataset

from dashpot.contract.registry import load_registry
from dashpot.diagnose.diagnose import diagnose
from dashpot.diagnose.folds import folds_of
from dashpot.diagnose.leftover import look_for_leftover
from dashpot.diagnose.look import look_at
from dashpot.diagnose.rounding import rounding_of, steps_of

STEP = 9.765625 / 2.0  # N, of twelve bits over 20 kN


def recorded(force, step=STEP, convert=np.round):
    """What a converter makes of a force (n,) N."""
    return step * convert(force / step)


@pytest.mark.parametrize("digits", [1, 2, 6])
@pytest.mark.parametrize("zero", [0.0, 3.3])
def test_the_step_of_a_record_is_found_as_it_was_written(digits, zero):
    force = 400.0 * np.sin(np.linspace(0.0, 20.0, 5000)) + np.random.default_rng(1).standard_normal(5000)
    step, level = steps_of(np.round(recorded(force) + zero, digits))
    assert step == pytest.approx(STEP, rel=1e-3)
    assert abs((level - zero + 0.5 * STEP) % STEP - 0.5 * STEP) < 10.0**-digits


def test_a_record_without_steps_has_none():
    rng = np.random.default_rng(2)
    assert steps_of(rng.standard_normal(4000))[0] == 0.0
    assert steps_of(np.ones(100))[0] == 0.0
    assert steps_of(np.array([0.0, 1.0, 2.5, 3.5, 7.0]))[0] == 0.0


@pytest.mark.parametrize("convert", [np.round, np.floor])
@pytest.mark.parametrize("noise", [0.1, 0.3])
def test_mean_and_variance_of_the_error_are_sums_of_its_harmonics(convert, noise):
    """A staircase of forces, each recorded 4000 times beside its own noise, in units of the step."""
    force = np.linspace(-3.0, 3.0, 601)
    draws = force + noise * np.random.default_rng(3).standard_normal((4000, 601))
    error = recorded(draws, 1.0, convert) - force
    rounding = rounding_of(recorded(force, 1.0, convert), force)
    ones = np.ones((1, 601))
    for found, shapes in ((error.mean(axis=0), rounding.means), (error.var(axis=0), rounding.variances)):
        rows = np.concatenate([ones, shapes])
        rest = found - np.linalg.lstsq(rows.T, found, rcond=None)[0] @ rows
        assert np.std(found) > 0.03
        assert np.std(rest) < 0.008  # a mean of 4000 draws scatters by 0.0066 at most, a variance by 0.004


def test_steps_finer_than_the_residual_leave_nothing():
    force = np.linspace(-3.0, 3.0, 601)
    found = rounding_of(recorded(force, 1.0), force + np.random.default_rng(4).standard_normal(601))
    assert not found.coarse and not found.means.any() and not found.variances.any()


def leftover_of(data):
    """What is left of runs beside a spring and a dashpot."""
    made = bench(data)
    look = look_at(made.refitter, made.model, causes("friction"), folds_of(made.refitter.runs, made.groups))
    return look_for_leftover(made.refitter, look, [])


def rounded(data, step):
    """The dataset as a coarse converter records it."""
    shown = [replace(run, channels={**run.channels, "force": recorded(run.force, step)}) for run in data.runs]
    return replace(data, runs=tuple(shown))


@pytest.mark.parametrize("seed", range(3))
def test_rounding_alone_is_no_structure(seed):
    """Steps of 16 standard deviations of the noise: a sweep always turns at the same place in one."""
    assert not leftover_of(rounded(dataset(seed=seed, noise=0.5), 8.0)).notable()


def test_runs_of_fine_steps_may_be_beside_runs_of_coarse_ones():
    """Another range of the converter in two of the runs."""
    fine = dataset(noise=0.5)
    coarse = {run.name: run for run in rounded(fine, 8.0).runs if run.name in ("a1_p5", "a3_p8")}
    mixed = replace(fine, runs=tuple(coarse.get(run.name, run) for run in fine.runs))
    assert not leftover_of(mixed).notable()


def test_a_line_beside_rounding_is_found():
    hum = {name: lambda force: force + 2.0 * np.sin(0.7 * np.arange(force.size)) for name in ("a1_p5", "a3_p8")}
    assert leftover_of(rounded(dataset(noise=0.5, fault=hum), 4.0)).notable()


def test_nothing_is_missing_in_a_record_of_coarse_steps():
    data = rounded(dataset(noise=0.5), 8.0)
    found = diagnose(bench(data).model.declared, data, registry=load_registry()).as_dict()
    assert found["verdict"] == "nothing_missing"

"""What a set of numbers is worth."""

from __future__ import annotations

import numpy as np
import pytest
from unit.fit.bench import DAMPING, KELVIN_VOIGT, STIFFNESS, TIME, ready, rows_of, runs

SCORED = runs()
VALUES = np.array([[STIFFNESS, DAMPING], [STIFFNESS, 2.0 * DAMPING], [1.1 * STIFFNESS, DAMPING]])


@pytest.fixture(scope="module", params=[1, 2])
def objective(request):
    return ready(KELVIN_VOIGT, SCORED, jobs=request.param)[1]


def expected_errors(values):
    return [
        np.outer(values[:, 0] - STIFFNESS, run.drive.displacement)
        + np.outer(values[:, 1] - DAMPING, run.drive.velocity)
        for run in SCORED
    ]


def expected_rmse(values):
    return np.array(
        [
            np.sqrt(np.mean(error[:, run.first :] ** 2, axis=1))
            for error, run in zip(expected_errors(values), SCORED, strict=True)
        ]
    )


def test_the_error_of_a_run_is_counted_behind_its_warm_up(objective):
    assert objective.rmse(VALUES) == pytest.approx(expected_rmse(VALUES), abs=1e-8)


def test_all_runs_weigh_the_same_whatever_their_length(objective):
    assert objective.losses(VALUES) == pytest.approx(np.sqrt(np.mean(expected_rmse(VALUES) ** 2, axis=0)), abs=1e-8)


def test_the_root_mean_square_of_the_residuals_is_the_loss(objective):
    residuals = objective.residuals(VALUES)
    assert residuals.shape == (3, objective.total) == (3, 2 * TIME.size - 400)
    assert np.sqrt(np.mean(residuals**2, axis=1)) == pytest.approx(objective.losses(VALUES), abs=1e-9)


def test_misfits_are_simulated_minus_measured(objective):
    misfits = objective.misfits(VALUES[1])
    expected = [DAMPING * run.drive.velocity[run.first :] for run in SCORED]
    assert misfits[0] == pytest.approx(np.concatenate(expected), abs=1e-8)


def test_forces_cover_the_warm_up_too(objective):
    forces = objective.forces(VALUES)
    assert [force.shape for force in forces] == [(3, 1500), (3, 1500)]
    assert forces[1][0] == pytest.approx(SCORED[1].force, abs=1e-8)


def test_a_lane_that_fails_costs_infinity_and_leaves_the_others(objective):
    broken = VALUES.copy()
    broken[1, 0] = np.nan
    assert objective.losses(broken)[1] == np.inf
    assert objective.rmse(broken)[:, 1].tolist() == [np.inf, np.inf]
    assert np.array_equal(objective.losses(broken)[[0, 2]], objective.losses(VALUES)[[0, 2]])


class EverySecond:
    """A whitening that multiplies the signals of each run by a number of its own and keeps every second sample."""

    factors = {"slow": 0.5, "fast": 3.0}

    def whiten(self, run, signals):
        return signals[..., ::2] * self.factors[run]

    def kept(self, run, samples):
        return (samples + 1) // 2


def test_with_whitening_the_loss_is_that_of_the_whitened_misfits():
    objective = ready(KELVIN_VOIGT, SCORED, whitening=EverySecond())[1]
    whitened = [
        factor * error[:, run.first :: 2]
        for factor, error, run in zip((0.5, 3.0), expected_errors(VALUES), SCORED, strict=True)
    ]
    expected = np.concatenate(whitened, axis=1)
    assert objective.total == expected.shape[1]
    assert objective.residuals(VALUES) == pytest.approx(expected, abs=1e-8)
    assert objective.losses(VALUES) == pytest.approx(np.sqrt(np.mean(expected**2, axis=1)), abs=1e-8)
    assert objective.losses(np.full((1, 2), np.nan))[0] == np.inf


@pytest.mark.parametrize(
    "more", ["", "measurement: {force: {gain: {start: 1.2}, offset: {start: 5 N}, delay: {start: 2 ms}}}\n"]
)
def test_the_linearisation_is_the_change_of_the_residual(more):
    _, objective, coordinates = ready(KELVIN_VOIGT, SCORED, more)
    values = coordinates.to_values(coordinates.start)[0]
    which = coordinates.which.tolist()
    shifts = 1e-6 * np.where(values[which] == 0.0, 1.0, values[which])
    residual, changes = rows_of(objective, values, which, shifts)
    moved = np.repeat(values[None], len(which), axis=0)
    moved[np.arange(len(which)), which] += shifts
    residuals = objective.residuals(np.concatenate([values[None], moved]))
    assert residual == pytest.approx(residuals[0], abs=1e-9)
    # behind a delay the changes are shifted along straight lines
    room = (2e-3 if more else 1e-6) * np.max(np.abs(changes), axis=1, keepdims=True)
    assert np.all(np.abs(changes - (residuals[1:] - residuals[0])) <= room)


def test_a_delayed_gain_is_part_of_the_misfit():
    _, objective, coordinates = ready(KELVIN_VOIGT, SCORED, "measurement: {force: {gain: 2.0}}\n")
    values = np.array([[STIFFNESS, DAMPING, 2.0]])
    assert objective.misfits(values)[0] == pytest.approx(
        np.concatenate([run.force[run.first :] for run in SCORED]), abs=1e-7
    )
    assert objective.losses(values) == pytest.approx(
        objective.losses(np.array([[2 * STIFFNESS, 2 * DAMPING, 1.0]])), rel=1e-9
    )

"""Facts of the least-squares method: the small triangle, the Jacobian as one block, the starts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.optimize import least_squares as whole_least_squares

from dashpot.contract.optimizer import Space, losses_of
from dashpot.fit.search import SearchResult, run_search
from dashpot_optimizers.least_squares import LeastSquares, choose
from dashpot_optimizers.surroundings import Surroundings, neighbours
from dashpot_optimizers.tall_matrix import SLICE, triangle_of

TIME = np.linspace(0.0, 3.0, 50)


def model(points: np.ndarray) -> np.ndarray:
    """Two relaxations; the bounds keep the second one the faster, so that the optimum is unique."""
    rates = np.stack([0.2 + points[:, 1], 3.0 + 4.0 * points[:, 2]], axis=1)
    curves = np.exp(-rates[:, :, None] * TIME)
    return points[:, :1] * curves[:, 0] + (1.0 - points[:, :1]) * curves[:, 1]


MEASURED = model(np.array([[0.4, 0.7, 0.3]]))[0] + 1e-3 * np.cos(40.0 * TIME)


def decay(points: np.ndarray) -> np.ndarray:
    return model(points) - MEASURED


SPACE = Space(("share", "slow", "fast"), np.array([0.8, 0.2, 0.9]))


def run(optimizer: LeastSquares, residuals=decay, space: Space = SPACE, seed: int = 1) -> SearchResult:
    return run_search(optimizer, lambda points: losses_of(residuals(points)), residuals, space, seed)


@pytest.mark.parametrize("samples", [3, SLICE - 1, SLICE, 2 * SLICE + 5])
def test_triangle_gives_the_gauss_newton_step_of_the_whole_matrix(samples: int) -> None:
    rng = np.random.default_rng(samples)
    values, steps = rng.normal(size=(4, samples)), np.array([1e-2, -1e-3, 1e-4])
    jacobian = ((values[1:] - values[0]) / steps[:, None]).T
    whole = np.linalg.lstsq(jacobian, values[0])[0]
    triangle = triangle_of(values, steps)
    assert triangle.shape == (min(samples, 4), 4)
    assert np.allclose(np.linalg.lstsq(triangle[:, 1:], triangle[:, 0])[0], whole, rtol=1e-8)
    assert np.isclose(np.linalg.norm(triangle[:, 0]), np.linalg.norm(values[0]), rtol=1e-12)


def test_triangle_keeps_small_singular_values_that_squaring_would_lose() -> None:
    columns = np.linalg.qr(np.random.default_rng(1).normal(size=(20_000, 3)))[0] * [1.0, 1.0, 1e-10]
    mixed = columns @ np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]])
    values = np.vstack([np.zeros(20_000), mixed.T])
    singular = np.linalg.svd(triangle_of(values, np.ones(3))[:, 1:], compute_uv=False)
    assert singular[-1] == pytest.approx(1e-10 / np.sqrt(2.0), rel=1e-4)


@given(arrays(float, 4, elements=st.floats(0.0, 1.0)), st.floats(1e-9, 1e-2))
def test_neighbours_differ_in_one_coordinate_and_stay_inside(point: np.ndarray, step: float) -> None:
    block, steps = neighbours(point, step)
    assert np.all((block >= 0.0) & (block <= 1.0))
    assert np.array_equal(block[0], point)
    assert np.array_equal(block[1:] - point, np.diag(steps))
    assert np.allclose(np.abs(steps), step, rtol=1e-6)


def test_ends_where_scipy_ends_with_the_whole_matrix() -> None:
    whole = whole_least_squares(
        lambda p: decay(p[None, :])[0], SPACE.start, jac="3-point", bounds=(0.0, 1.0), xtol=1e-14, ftol=1e-14
    )
    result = run(LeastSquares(tolerance=1e-12))
    assert np.allclose(result.best, whole.x, atol=1e-6)
    assert result.loss == pytest.approx(np.sqrt(2.0 * whole.cost / len(TIME)), rel=1e-9)


def test_a_step_and_its_jacobian_are_one_block() -> None:
    lanes: list[int] = []

    def counted(points: np.ndarray) -> np.ndarray:
        lanes.append(len(points))
        return decay(points)

    run(LeastSquares(), counted)
    assert set(lanes) == {1 + SPACE.size}


def test_several_starts_are_screened_in_one_block_of_losses_and_advance_together() -> None:
    asked: list[tuple[str, int]] = []
    result = run_search(
        LeastSquares(starts=3, screen=5),
        lambda points: [asked.append(("losses", len(points))), losses_of(decay(points))][1],
        lambda points: [asked.append(("residuals", len(points))), decay(points)][1],
        SPACE,
        1,
    )
    assert asked[0] == ("losses", 15)
    assert asked[1] == ("residuals", 3 * (1 + SPACE.size))
    assert {needs for needs, _ in asked[1:]} == {"residuals"}
    assert "of 3 starts end within 1 % of the best" in result.remark


def test_starts_are_the_given_one_and_the_best_of_the_others() -> None:
    assert choose(np.array([9.0, 4.0, np.inf, 1.0, 7.0]), 3).tolist() == [0, 3, 1]


def test_failed_points_are_no_starts() -> None:
    assert choose(np.array([np.inf, 4.0, np.inf, 1.0]), 3).tolist() == [3, 1]
    assert choose(np.full(4, np.inf), 3).tolist() == []


def test_a_neighbour_that_fails_stops_its_coordinate_only() -> None:
    def walled(points: np.ndarray) -> np.ndarray:
        values = decay(points)
        values[points[:, 1] > SPACE.start[1]] = np.inf
        return values

    around = Surroundings(walled, 1e-5)
    around.residuals(SPACE.start)
    jacobian = around.jacobian(SPACE.start)
    assert np.all(jacobian[:, 1] == 0.0)
    assert np.all(np.linalg.norm(jacobian[:, [0, 2]], axis=0) > 0.0)


def test_says_that_the_only_start_failed() -> None:
    result = run(LeastSquares(), lambda points: np.full((len(points), 5), np.nan))
    assert result.remark == "the start could not be evaluated"
    assert result.evaluations == 1 + SPACE.size


def test_a_perfect_start_ends_at_once() -> None:
    result = run(LeastSquares(), lambda points: np.zeros((len(points), 5)))
    assert (result.loss, result.evaluations) == (0.0, 1 + SPACE.size)


def test_iterations_limit_the_steps() -> None:
    result = run(LeastSquares(iterations=2))
    assert result.evaluations == 2 * (1 + SPACE.size)
    assert result.remark == "the allowed iterations are used up"


@pytest.mark.parametrize(("option", "value"), [("starts", 0), ("screen", 0), ("step", 0.0), ("tolerance", 1.0)])
def test_options_out_of_range_are_refused(option: str, value: float) -> None:
    with pytest.raises(ValueError, match=rf"^{option}: expected .* got {value}"):
        LeastSquares(**{option: value})

"""How often every registered optimizer comes within 1 % of the noise floor, on problems of known truth."""

from __future__ import annotations

import math
import os
import secrets
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from dashpot.contract.optimizer import Space, losses_of
from dashpot.contract.registry import load_registry
from dashpot.fit.search import run_search

TRIALS = 20
BUDGET = 20_000
FALSE_ALARM = 1e-5


@dataclass(frozen=True)
class Problem:
    """Residuals (lanes, n) -> (lanes, samples) whose root mean square at the truth is `floor`."""

    size: int
    residuals: Callable[[np.ndarray], np.ndarray]
    floor: float

    def losses(self, points: np.ndarray) -> np.ndarray:
        return losses_of(self.residuals(points))


def with_floor(size: int, residuals: Callable[[np.ndarray], np.ndarray], floor: float = 0.2) -> Problem:
    """Residuals that vanish at the truth, and as many constant ones that nothing can remove."""

    def floored(points: np.ndarray) -> np.ndarray:
        values = residuals(points)
        return np.hstack([values, np.full_like(values, floor * np.sqrt(2.0))])

    return Problem(size, floored, floor)


def quadratic(rng: np.random.Generator) -> Problem:
    """An oblique ellipsoid in six dimensions, axes 1 : 30."""
    turn, _ = np.linalg.qr(rng.normal(size=(6, 6)))
    matrix, truth = np.geomspace(1.0, 30.0, 6)[:, None] * turn, rng.uniform(0.2, 0.8, 6)
    return with_floor(6, lambda points: (points - truth) @ matrix.T)


def rosenbrock(rng: np.random.Generator) -> Problem:
    """The bent valley in four dimensions, -2 ... 2."""

    def residuals(points: np.ndarray) -> np.ndarray:
        x = 4.0 * points - 2.0
        return np.hstack([10.0 * (x[:, 1:] - x[:, :-1] ** 2), 1.0 - x[:, :-1]])

    return with_floor(4, residuals)


def many_valleys(rng: np.random.Generator) -> Problem:
    """Rastrigin's function in three dimensions as a sum of squares: about a thousand minima."""
    truth = rng.uniform(0.3, 0.7, 3)

    def residuals(points: np.ndarray) -> np.ndarray:
        x = 10.24 * (points - truth)
        return np.hstack([x, np.sqrt(20.0) * np.sin(np.pi * x)])

    return with_floor(3, residuals)


def relaxation(rng: np.random.Generator) -> Problem:
    """Complex stiffness of a spring and three Maxwell branches, 1 ... 25 Hz, logarithmic bounds of 1 : 10 ... 1000."""
    omega = 2.0 * np.pi * np.geomspace(1.0, 25.0, 40)
    low, high = np.r_[5e4, [1e3] * 3, [1e-3] * 3], np.r_[5e5, [1e5] * 3, [1.0] * 3]

    def stiffness(points: np.ndarray) -> np.ndarray:
        values = low * (high / low) ** points
        turns = 1j * omega * values[:, 4:, None]
        whole = values[:, :1] + np.sum(values[:, 1:4, None] * turns / (1.0 + turns), axis=1)
        return np.hstack([whole.real, whole.imag])

    truth = np.r_[220e3, [8e3, 8e3, 12e3], [0.16, 0.032, 0.0064]] * rng.uniform(0.7, 1.4, 7)
    return noisy(7, stiffness, np.log(truth / low) / np.log(high / low), 100.0, rng)


def friction(rng: np.random.Generator) -> Problem:
    """First loading of three Dahl elements, 0 ... 10 mm, logarithmic bounds of 1 : 1000."""
    travel = np.linspace(0.0, 1e-2, 120)
    low, high = np.r_[[3e3] * 3, [1.0] * 3], np.r_[[3e6] * 3, [1e3] * 3]

    def force(points: np.ndarray) -> np.ndarray:
        values = low * (high / low) ** points
        slope, limit = values[:, :3, None], values[:, 3:, None]
        return np.sum(limit * -np.expm1(-slope / limit * travel), axis=1)

    truth = np.r_[60e3, 20e3, 14e3, 6.0, 20.0, 60.0] * rng.uniform(0.7, 1.4, 6)
    return noisy(6, force, np.log(truth / low) / np.log(high / low), 0.2, rng)


def noisy(size: int, model: Callable, truth: np.ndarray, sigma: float, rng: np.random.Generator) -> Problem:
    measured = model(truth[None, :])[0]
    noise = rng.normal(0.0, sigma, len(measured))
    return Problem(size, lambda points: model(points) - measured - noise, float(np.sqrt(np.mean(noise**2))))


ZOO = {maker.__name__: maker for maker in (quadratic, rosenbrock, many_valleys, relaxation, friction)}

# Lower 99 % limits of the rates seen over 150 problems each; a local method claims nothing among many valleys.
AT_LEAST = {
    "pso": {"quadratic": 0.96, "rosenbrock": 0.96, "many_valleys": 0.8, "relaxation": 0.93, "friction": 0.75},
    "least_squares": {"quadratic": 0.96, "rosenbrock": 0.8, "relaxation": 0.96, "friction": 0.92},
    "differential_evolution": {
        "quadratic": 0.96, "rosenbrock": 0.9, "many_valleys": 0.89, "relaxation": 0.96, "friction": 0.93
    },
    "cmaes": {"quadratic": 0.96, "rosenbrock": 0.96, "many_valleys": 0.95, "relaxation": 0.96, "friction": 0.96},
    "multistart": {"quadratic": 0.96, "rosenbrock": 0.96, "relaxation": 0.96, "friction": 0.96},
}  # fmt: skip
CLAIMS = [(word, problem, rate) for word, rates in AT_LEAST.items() for problem, rate in rates.items()]


def fewest(trials: int, rate: float, risk: float) -> int:
    """The smallest number of successes that a method of this rate undercuts with a probability of at most `risk`."""
    below = np.cumsum([math.comb(trials, k) * rate**k * (1.0 - rate) ** (trials - k) for k in range(trials + 1)])
    return int(np.count_nonzero(below <= risk))


def seed_of_this_run() -> int:
    seed = int(os.environ.get("DASHPOT_TEST_SEED", secrets.randbits(32)))
    print(f"DASHPOT_TEST_SEED={seed}")
    return seed


def evaluations_to_goal(word: str, problem: str, seed: list[int]) -> float:
    """Parameter vectors until 1.01 x noise floor, from a random start; inf when the budget does not suffice."""
    rng = np.random.default_rng(seed)
    task, goal = ZOO[problem](rng), 1.01
    space = Space(tuple(f"p{number}" for number in range(task.size)), rng.random(task.size))
    made = load_registry().optimizers[word]()
    result = run_search(made, task.losses, task.residuals, space, seed[0], budget=BUDGET, target=goal * task.floor)
    return result.evaluations if result.loss <= goal * task.floor else np.inf


@pytest.mark.parametrize(("word", "problem", "rate"), CLAIMS)
def test_success_is_as_frequent_as_claimed(word: str, problem: str, rate: float) -> None:
    first = seed_of_this_run()
    spent = [evaluations_to_goal(word, problem, [first, number]) for number in range(TRIALS)]
    reached = sum(np.isfinite(spent))
    print(f"{word} on {problem}: {reached} of {TRIALS}, median {np.median(spent):.0f} evaluations")
    assert reached >= fewest(TRIALS, rate, FALSE_ALARM)


def test_every_built_in_optimizer_makes_a_claim() -> None:
    registry = load_registry()
    built_in = {
        word
        for word, made in registry.optimizers.items()
        if registry.origin("optimizers", word).distribution == "dashpot" and not made.library
    }
    assert built_in == set(AT_LEAST)


def test_least_squares_needs_a_tenth_of_the_evaluations_of_a_swarm() -> None:
    first = seed_of_this_run()
    swarm, squares = (
        np.median([evaluations_to_goal(word, "relaxation", [first, number]) for number in range(9)])
        for word in ("pso", "least_squares")
    )
    assert squares < swarm / 10


@pytest.mark.parametrize("maker", ZOO.values(), ids=ZOO)
def test_noise_floor_is_a_fraction_of_what_a_random_point_is_worth(maker: Callable) -> None:
    rng = np.random.default_rng(seed_of_this_run())
    problem = maker(rng)
    assert np.median(problem.losses(rng.random((200, problem.size)))) > 10.0 * problem.floor


def test_limit_of_successes_follows_the_binomial_law() -> None:
    assert fewest(10, 0.5, 2.0**-10) == 1
    assert fewest(10, 0.5, 0.9 * 2.0**-10) == 0
    # of 3 at 3/4: P(0) = 1/64, P(0 or 1) = 10/64, P(0, 1 or 2) = 37/64
    assert [fewest(3, 0.75, risk / 64) for risk in (0.5, 1, 9, 10, 36, 37)] == [0, 1, 1, 2, 2, 3]

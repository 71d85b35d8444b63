"""How often every registered optimizer comes within 1 % of the noise floor, on problems of known truth."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from seeds import seed_of
from zoo.problems import ZOO, evaluations_to_goal

from dashpot.contract.registry import load_registry

TRIALS = 20
BUDGET = 20_000
FALSE_ALARM = 1e-5


# Lower 99 % limits of the rates seen over 150 problems each; a local method claims nothing among many valleys.
AT_LEAST = {
    "pso": {"quadratic": 0.96, "rosenbrock": 0.96, "many_valleys": 0.8, "relaxation": 0.93, "friction": 0.75},
    "least_squares": {"quadratic": 0.96, "rosenbrock": 0.8, "relaxation": 0.96, "friction": 0.92},
    "differential_evolution": {
        "quadratic": 0.96,
        "rosenbrock": 0.9,
        "many_valleys": 0.89,
        "relaxation": 0.96,
        "friction": 0.93,
    },
    "cmaes": {"quadratic": 0.96, "rosenbrock": 0.96, "many_valleys": 0.95, "relaxation": 0.96, "friction": 0.96},
    "multistart": {"quadratic": 0.96, "rosenbrock": 0.96, "relaxation": 0.96, "friction": 0.96},
}
CLAIMS = [(word, problem, rate) for word, rates in AT_LEAST.items() for problem, rate in rates.items()]


def fewest(trials: int, rate: float, risk: float) -> int:
    """The smallest number of successes that a method of this rate undercuts with a probability of at most `risk`."""
    below = np.cumsum([math.comb(trials, k) * rate**k * (1.0 - rate) ** (trials - k) for k in range(trials + 1)])
    return int(np.count_nonzero(below <= risk))


@pytest.mark.parametrize(("word", "problem", "rate"), CLAIMS)
def test_success_is_as_frequent_as_claimed(word: str, problem: str, rate: float) -> None:
    first = seed_of(f"{word} on {problem}")
    spent = [evaluations_to_goal(word, problem, [first, number], BUDGET) for number in range(TRIALS)]
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
    first = seed_of("least squares and a swarm")
    swarm, squares = (
        np.median([evaluations_to_goal(word, "relaxation", [first, number], BUDGET) for number in range(9)])
        for word in ("pso", "least_squares")
    )
    assert squares < swarm / 10


@pytest.mark.parametrize("maker", ZOO.values(), ids=ZOO)
def test_noise_floor_is_a_fraction_of_what_a_random_point_is_worth(maker: Callable) -> None:
    rng = np.random.default_rng(seed_of(f"floor of {maker.__name__}"))
    problem = maker(rng)
    assert np.median(problem.losses(rng.random((200, problem.size)))) > 10.0 * problem.floor


def test_limit_of_successes_follows_the_binomial_law() -> None:
    assert fewest(10, 0.5, 2.0**-10) == 1
    assert fewest(10, 0.5, 0.9 * 2.0**-10) == 0
    # of 3 at 3/4: P(0) = 1/64, P(0 or 1) = 10/64, P(0, 1 or 2) = 37/64
    assert [fewest(3, 0.75, risk / 64) for risk in (0.5, 1, 9, 10, 36, 37)] == [0, 1, 1, 2, 2, 3]

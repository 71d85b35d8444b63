"""Problems of known truth for optimizers: residuals over the unit cube, with noise that nothing can remove."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from dashpot.contract.optimizer import losses_of

GOAL = 1.01


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


@cache
def tire_network():
    """Spring, damper, Maxwell, Prandtl and Dahl branches on two short sweeps."""
    from dashpot import load_registry
    from dashpot.contract.bench import Bench
    from dashpot.fit.coordinates import search_coordinates
    from dashpot.fit.objective import Objective
    from dashpot.fit.ranges import natural_sizes, with_ranges
    from dashpot.fit.scored import score_run
    from dashpot.fit.virtual_test import virtual_test
    from dashpot.kernel.network import compile_network
    from dashpot.model.reading import parse_network

    registry = load_registry()
    spec = parse_network(TIRE, registry.elements, "tire.yaml")
    rig = registry.rigs["hydropulser"](
        amplitudes=(0.5e-3, 4e-3), preloads=(0.0,), duration=2.0, direction="up", sampling=500.0
    )
    runs = [score_run(run) for run in virtual_test(spec, Bench("zoo", (rig,)))]
    spec = with_ranges(spec, natural_sizes(runs))
    return Objective(compile_network(spec), runs), search_coordinates(spec)


TIRE = """\
format: dashpot-network/1
name: tire
branches:
  stiffness: {element: spring, stiffness: {start: 220 N/mm}}
  damping: {element: damper, damping: {start: 60 N*s/m}}
  maxwell: {element: maxwell, stiffness: {start: 15 N/mm}, relaxation_time: {start: 20 ms}}
  prandtl: {element: prandtl, stiffness: {start: 20 N/mm}, limit: {start: 20 N}}
  friction: {element: dahl, stiffness: {start: 60 N/mm}, limit: {start: 15 N}}
"""


def tire(rng: np.random.Generator) -> Problem:
    """Tire Model 1 with a linear spring on two sweeps; 8 numbers, each over five to seven decades."""
    objective, coordinates = tire_network()
    truth = coordinates.to_values(coordinates.start)
    truth[0, coordinates.which] *= rng.uniform(0.7, 1.4, len(coordinates.paths))
    # both are misfits to the same record, which drops out
    wanted = objective.misfits(truth)[0]
    noise = rng.normal(0.0, 5.0, wanted.size)

    def residuals(points: np.ndarray) -> np.ndarray:
        return objective.misfits(coordinates.to_values(coordinates.from_cube(points))) - wanted - noise

    return Problem(len(coordinates.paths), residuals, float(np.sqrt(np.mean(noise**2))))


ZOO = {maker.__name__: maker for maker in (quadratic, rosenbrock, many_valleys, relaxation, friction, tire)}


def evaluations_to_goal(word: str, problem: str, seed: list[int], budget: int) -> float:
    """Parameter vectors until 1.01 x noise floor, from a random start; inf when the budget does not suffice."""
    from dashpot import load_registry
    from dashpot.contract.chain import make_optimizer
    from dashpot.contract.optimizer import Space
    from dashpot.fit.search import run_search

    rng = np.random.default_rng(seed)
    task = ZOO[problem](rng)
    goal = GOAL * task.floor
    space = Space(tuple(f"p{number}" for number in range(task.size)), rng.random(task.size))
    method = make_optimizer(word, load_registry().optimizers)
    found = run_search(method, task.losses, task.residuals, space, int(rng.integers(2**32)), budget=budget, target=goal)
    return found.evaluations if found.loss <= goal else np.inf

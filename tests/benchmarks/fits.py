"""How soon each method finds the numbers of a noisy tire: ``python tests/benchmarks/fits.py``.

Tire model 5 with numbers drawn within a factor of two of the file's and known curves, on the sweeps of W1, with white
noise of 10 N. A method has found them where the error is 1.01 times the noise. Its evaluations are parameter vectors on
all sweeps, told in whole swarms of 96; a Jacobian counts as one vector for each number.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from numpy.typing import NDArray
from parts import write_part
from workload import LANES, SWEEPS, lanes, network

from dashpot.contract.chain import make_optimizer
from dashpot.contract.optimizer import Space
from dashpot.contract.registry import load_registry
from dashpot.fit.coordinates import Coordinates, search_coordinates
from dashpot.fit.dictionary import dictionary_start
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.refine import DAMPINGS, refine
from dashpot.fit.scored import ScoredRun
from dashpot.fit.search import run_search
from dashpot.fit.starts import refine_from_starts
from dashpot.kernel.network import compile_network

Array = NDArray[np.float64]

NOISE, NEAR_ENOUGH = 10.0, 1.01
OTHERS = ("multistart", "least_squares", "pso")
LARGEST = 200 * LANES


@dataclass(frozen=True, eq=False)
class Problem:
    """A tire to be found, and the loss that is good enough."""

    objective: Objective
    coordinates: Coordinates
    goal: float


@dataclass(frozen=True)
class Found:
    """How a search ended: its loss, the vectors that it took to the goal (None: not reached), seconds."""

    loss: float
    evaluations: int | None
    seconds: float


def problem(seed: int, seconds: float, jobs: int) -> Problem:
    """The tire of a seed."""
    rng = np.random.default_rng(seed)
    true = lanes(network(), 2, seed)[1]
    runs = []
    for number, sweep in enumerate(SWEEPS):
        drive = replace(sweep, seconds=seconds).drive()
        force = network().simulate(network().prepare(drive), true)
        noisy = force + NOISE * rng.standard_normal(force.size)
        runs.append(ScoredRun(f"sweep_{number}", "sweep", drive, noisy, 0))
    spec = with_ranges(network().spec, natural_sizes(runs))
    objective = Objective(compile_network(spec), runs, jobs)
    floor = float(objective.losses(true[None])[0])
    return Problem(objective, search_coordinates(spec, lambda slot: "[" not in slot.path), NEAR_ENOUGH * floor)


Method = Callable[[Problem, int], tuple[list[tuple[int, float]], float]]


def search(method: Method, posed: Problem, seed: int) -> Found:
    """A method on a problem, until the goal or the budget of a whole swarm's 200 steps is reached."""
    began = time.perf_counter()
    history, loss = method(posed, seed)
    reached = next((spent for spent, best in history if best <= posed.goal), None)
    return Found(loss, reached, time.perf_counter() - began)


def own(posed: Problem, seed: int) -> tuple[list[tuple[int, float]], float]:
    """The method of ``dashpot fit``, from many starts, each to its end."""
    best = refine_from_starts(posed.objective, posed.coordinates, seed, lambda done, loss: None)
    return list(best.history), best.refined.loss


def dictionary(posed: Problem, seed: int) -> tuple[list[tuple[int, float]], float]:
    """One start, from a dictionary of branches, and what two swarms allow."""
    start = dictionary_start(posed.objective, posed.coordinates)
    assert start is not None
    losses: list[float] = []
    found = refine(
        posed.objective, posed.coordinates, start.point, watch=losses.append, budget=2 * LANES - start.evaluations
    )
    step = 1 + start.point.size + len(DAMPINGS)
    return [(start.evaluations + 1 + step * number, loss) for number, loss in enumerate(losses, 1)], found.loss


def other(method: str) -> Method:
    """An optimizer by its word, with its own options."""

    def run(posed: Problem, seed: int) -> tuple[list[tuple[int, float]], float]:
        coordinates, objective = posed.coordinates, posed.objective
        optimizer = make_optimizer(method, load_registry().optimizers, {})
        start = np.random.default_rng(seed).uniform(size=len(coordinates.paths))
        found = run_search(
            optimizer,
            lambda cube: objective.losses(coordinates.to_values(coordinates.from_cube(cube))),
            lambda cube: objective.residuals(coordinates.to_values(coordinates.from_cube(cube))),
            Space(coordinates.paths, start),
            seed,
            LARGEST,
            posed.goal,
        )
        return [(standing.evaluations, standing.loss) for standing in found.history], found.loss

    return run


def table(seeds: int, seconds: float, jobs: int) -> Iterator[str]:
    """The comparison as Markdown, a line as soon as it is known."""
    yield f"| method | reached | swarms of {LANES}, median | s, median | error over noise, worst |"
    yield "| --- | ---: | ---: | ---: | ---: |"
    posed = [problem(seed, seconds, jobs) for seed in range(1, seeds + 1)]
    methods = {"dictionary": dictionary, "own": own, **{word: other(word) for word in OTHERS}}
    for word, method in methods.items():
        found = [search(method, each, seed) for seed, each in enumerate(posed, 1)]
        hits = [each.evaluations / LANES for each in found if each.evaluations is not None]
        worst = max(each.loss / one.goal * NEAR_ENOUGH for each, one in zip(found, posed, strict=True))
        swarms = f"{median(hits):.1f}" if hits else ""
        took = median(each.seconds for each in found)
        yield f"| {word} | {len(hits)} of {seeds} | {swarms} | {took:.1f} | {worst:.4f} |"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--seconds", type=float, default=30.0, help="length of each sweep")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--write", action="store_true", help="keep the table")
    options = parser.parse_args()
    lines = []
    for line in table(options.seeds, options.seconds, options.jobs):
        print(line, flush=True)
        lines.append(line)
    if options.write:
        write_part("fits", "\n".join([f"{time.strftime('%Y-%m-%d')}, {options.jobs} threads.", "", *lines]))


if __name__ == "__main__":
    main()

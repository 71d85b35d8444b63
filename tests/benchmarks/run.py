"""Timings, side by side in one run: ``python tests/benchmarks/run.py``. Never part of a passing or failing test.

Machines are shared and noisy: medians of processor time over several rounds, and ratios, are what counts.
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from axle import AXLE, DT, AxleTask, axle, equations, excitation
from by_hand import ByHand, compiler
from counting import instructions, vectors
from fits import problem
from laws import numba_tongue
from measuring import Contestant, time_together
from ordinary import euler_force
from page import table, write
from peers import Entry, forces, missing, peers, runge_kutta
from starting import start_times
from tire import tire_equations
from truth import tire_force
from workload import LANES, NETWORK, SWEEPS, Sweep, Task, lanes, network, network_of

from dashpot.contract.chain import make_optimizer
from dashpot.contract.optimizer import Space
from dashpot.contract.registry import load_registry
from dashpot.data.drive import Drive
from dashpot.fit.search import run_search
from dashpot.kernel.network import CompiledNetwork
from dashpot.kernel.parts import take_apart
from dashpot.kernel.targets.llvm.source import print_source

LADDER = ("spring", "kelvin_voigt", "gehmann", "ftire", "tire_model_1", "tire_model_2", "tire_model_5", "ubs", "eub")
ELEMENTS = {
    "maxwell": "stiffness: 8 N/mm, relaxation_time: 30 ms",
    "prandtl": "stiffness: 9 N/mm, limit: 20 N",
    "dahl": "stiffness: 60 N/mm, limit: 15 N",
}
COUNTS, SHARES, GROUPS = (1, 2, 4, 8, 16), (0.25, 0.5, 0.75, 1.0), (16, 32, 64, 96, 192)
HARDEST = 8  # 5 mm around 10 mm
EXACT_PARTS = 64
LIBRARIES = ("dashpot", "numpy", "llvmlite", "numba", "scipy", "numbalsoda", "scikit-sundae", "casadi")

Row = dict[str, str | float]


def tire_rows(sweeps: tuple[Sweep, ...], rounds: int) -> Iterator[Row]:
    """W1 and the ladder of networks, interleaved: ns per lane and sample."""
    drives = tuple(sweep.drive() for sweep in sweeps)
    hardest = replace(SWEEPS[HARDEST], seconds=sweeps[0].seconds)
    numbers, path = dict(zip(network().paths, network().start.tolist(), strict=True)), hardest.path(hardest.time)[:2]
    tasks = {f"{name}, {LANES} lanes": Task.of(network(name), drives) for name in LADDER}
    tasks[f"{NETWORK}, {LANES} lanes, 2 threads"] = Task.of(network(), drives, jobs=2)
    tasks[f"{NETWORK}, 1 lane"] = Task.of(network(), drives, 1)
    field = [Contestant(name, task.score, task.units) for name, task in tasks.items()]
    field.append(Contestant("explicit Euler, numba, scalar", lambda: euler_force(path, numbers), hardest.time.size))
    by_hand = [ByHand(sweep, network().paths, lanes(network())) for sweep in sweeps] if compiler() else []
    if by_hand:
        units = tasks[f"{NETWORK}, {LANES} lanes"].units
        field.append(Contestant(f"C by hand, {LANES} lanes", lambda: [each.score() for each in by_hand], units))
    error = {
        f"{NETWORK}, {LANES} lanes": tire_error(sweeps),
        "explicit Euler, numba, scalar": rms(euler_force(path, numbers) - tire_force(hardest, numbers)),
    }
    yield from _rows(field, rounds, error)


def growth_rows(sweep: Sweep, rounds: int) -> Iterator[Row]:
    """Milliseconds of more and more elements of a kind, samples and lanes of Tire Model 5."""
    drives, tasks = (sweep.drive(),), {}
    for word, numbers in ELEMENTS.items():
        for count in COUNTS:
            branches = f"  it: {{repeat: {count}, element: {word}, {numbers}}}\n"
            tasks[f"{word} elements", count] = Task.of(network_of(branches), drives)
    for share in SHARES:
        task = Task.of(network(), (replace(sweep, seconds=share * sweep.seconds).drive(),))
        tasks["samples", task.rows[0].drive.samples] = task
    for count in GROUPS:
        tasks["lanes", count] = Task.of(network(), drives, count)
    field = [Contestant(repr(key), task.score) for key, task in tasks.items()]
    found = time_together(field, rounds)
    for what, count in tasks:
        yield {"what": what, "count": count, "ms": found[repr((what, count))].cpu / 1e6}


def axle_rows(seconds: float, rounds: int) -> Iterator[Row]:
    """W2: ns per lane and sample."""
    counts = {f"{LANES} lanes": (LANES, 1), "64 lanes": (64, 1), "64 lanes, 2 threads": (64, 2), "1 lane": (1, 1)}
    tasks = {f"{AXLE}, {what}": AxleTask.of(seconds, *count) for what, count in counts.items()}
    field = [Contestant(name, task.score, task.units) for name, task in tasks.items()]
    yield from _rows(field, rounds, {f"{AXLE}, 64 lanes": axle_error(seconds)[0]})


def _rows(field: list[Contestant], rounds: int, error: dict[str, float]) -> Iterator[Row]:
    for name, timing in time_together(field, rounds).items():
        # work of other threads is not in the time of this one
        time_of = timing.clock if "threads" in name else timing.cpu
        yield {
            "who": name,
            "ns": time_of,
            "clock_ns": timing.clock,
            "spread": timing.spread,
            **({"error": error[name]} if name in error else {}),
        }


def tire_error(sweeps: tuple[Sweep, ...]) -> float:
    """The error (rms, N) over some lanes and all sweeps against closed forms between exact reversals."""
    compiled, values = network(), lanes(network(), 4)
    misses = []
    for sweep in sweeps:
        found = compiled.simulate(compiled.prepare(sweep.drive()), values)
        exact = [tire_force(sweep, dict(zip(compiled.paths, lane.tolist(), strict=True))) for lane in values]
        misses.append(found - np.array(exact))
    return rms(np.array(misses))


def axle_error(seconds: float) -> tuple[float, float]:
    """The error (rms, N) of the axle and of its truth: the same equations with very short Runge-Kutta steps."""
    times, hand = DT * np.arange(round(seconds / DT)), equations(seconds, numba_tongue())
    fine, finer = (forces(hand, times, runge_kutta(hand, times, parts)()) for parts in (32, EXACT_PARTS))
    found = axle().solve(axle().prepare(excitation(seconds)))
    return rms(found.force[0].T - finer), rms(fine - finer)


def peer_rows(seconds: float) -> dict[str, list[Row]]:
    """General integrators on one lane, at the accuracy of dashpot."""
    sweep = replace(SWEEPS[HARDEST], seconds=seconds)
    numbers = dict(zip(network().paths, network().start.tolist(), strict=True))
    exact = tire_force(sweep, numbers)
    goal = rms(network().simulate(network().prepare(sweep.drive())) - exact)
    tire = [_row(entry) for entry in peers(partial(tire_equations, sweep), exact[:, None], sweep.time, goal)]
    times, hand = DT * np.arange(round(seconds / DT)), equations(seconds, numba_tongue())
    truth = forces(hand, times, runge_kutta(hand, times, EXACT_PARTS)())
    return {
        "W1": tire,
        "W2": [_row(entry) for entry in peers(partial(equations, seconds), truth, times, axle_error(seconds)[0])],
    }


def _row(entry: Entry) -> Row:
    return {"who": f"{entry.who}, {entry.setting}", "ns": entry.nanoseconds, "error": entry.error}


def rms(values: np.ndarray) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))


def sum_rows(sweep: Sweep, rounds: int) -> Iterator[Row]:
    """Every shipped network beside the sum of its branches, each as a network of its own: ns per lane and sample."""
    drives, field, recipes = (sweep.drive(),), {}, {}
    for name in LADDER:
        members = take_apart(network(name).spec).members
        recipes[name] = [(print_source(part.network.program, 2), len(part.slots)) for part in members]
        for (text, _), part in zip(recipes[name], members, strict=True):
            field.setdefault(text, _contestant(text, part.network, drives))
        field[name] = _contestant(name, network(name), drives)
    found = time_together(list(field.values()), rounds)
    for name, parts in recipes.items():
        total = sum(count * found[text].cpu for text, count in parts)
        yield {"who": name, "ns": found[name].cpu, "sum_ns": total, "ratio": found[name].cpu / total}


def _contestant(name: str, compiled: CompiledNetwork, drives: tuple[Drive, ...]) -> Contestant:
    task = Task.of(compiled, drives)
    return Contestant(name, task.score, task.units)


def swarm_seconds(seconds: float, iterations: int, jobs: int) -> float:
    """Seconds by the clock of so many iterations of a swarm of 96 on the twelve sweeps of W1."""
    posed = problem(1, seconds, jobs)
    optimizer = make_optimizer("pso", load_registry().optimizers, {"iterations": iterations, "stall": iterations})
    space = Space(posed.coordinates.paths, np.full(len(posed.coordinates.paths), 0.5))

    def losses(cube: np.ndarray) -> np.ndarray:
        return posed.objective.losses(posed.coordinates.to_values(posed.coordinates.from_cube(cube)))

    began = time.perf_counter()
    found = run_search(optimizer, losses, losses, space, 1)
    spent = time.perf_counter() - began
    assert found.evaluations == iterations * LANES
    return spent


def measured(quick: bool, rounds: int) -> dict:
    """All of it."""
    seconds, short, iterations = (3.0, 2.0, 5) if quick else (30.0, 5.0, 200)
    sweeps = tuple(replace(sweep, seconds=seconds) for sweep in (SWEEPS[::5] if quick else SWEEPS))
    before = os.getloadavg()[0]
    content = {
        "machine": {"processor": processor(), "cores": os.cpu_count()},
        "date": time.strftime("%Y-%m-%d"),
        "versions": {name: found for name in LIBRARIES if (found := installed(name))},
        "missing": missing(),
        "seconds": seconds,
        "sweeps": len(sweeps),
        "rounds": rounds,
        "peer_seconds": short,
        "W1": list(tire_rows(sweeps, rounds)),
        "W2": list(axle_rows(seconds, rounds)),
        "swarm": {"iterations": iterations, "seconds": swarm_seconds(seconds, iterations, 2)},
        "growth": list(growth_rows(sweeps[-1], rounds)),
        "sums": list(sum_rows(sweeps[-1], rounds)),
        "start": start_times(1 if quick else rounds),
        "vectors": vectors(),
        "instructions": {} if quick else instructions(),
    }
    for work, rows in peer_rows(short).items():
        content[work] += rows
    return content | {"load": [before, os.getloadavg()[0]]}


def installed(name: str) -> str | None:
    """The version of a library, None where it is not there."""
    try:
        return version(name)
    except ImportError:
        return None


def processor() -> str:
    """The kind of processor, with the widest vectors that it has."""
    found = Path("/proc/cpuinfo")
    text = found.read_text(encoding="utf-8") if found.exists() else ""
    named = next((line.partition(":")[2].strip() for line in text.splitlines() if line.startswith("model name")), "")
    wide = next((word for flag, word in (("avx512f", "AVX-512"), ("avx2", "AVX2")) if flag in text), "")
    return ", ".join(filter(None, [named or platform.machine(), wide]))


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--quick", action="store_true", help="short sweeps, few of them, no instructions counted")
    parser.add_argument("--write", action="store_true", help="keep the results and the table")
    options = parser.parse_args()
    content = measured(options.quick, options.rounds)
    print(table(content))
    if options.write:
        write(content)


if __name__ == "__main__":
    main()

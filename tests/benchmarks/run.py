"""Timings, side by side in one run: ``python tests/benchmarks/run.py``. Never part of a passing or failing test.

Machines are shared and noisy: medians of several rounds, and ratios, are what counts.
"""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
import sys
import tempfile
import time
from importlib.metadata import version
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from ordinary import euler_nanoseconds
from workload import LANES, lanes, network, runs

from dashpot.fit.search import run_search

GENERATIONS = 200
NETWORKS = ("spring", "kelvin_voigt", "gehmann", "ftire", "tire_model_1", "tire_model_2", "tire_model_5")


def seconds_of(work, rounds: int) -> float:
    """Median time of a call, after a first one that does not count."""
    work()
    times = []
    for _ in range(rounds):
        began = time.perf_counter()
        work()
        times.append(time.perf_counter() - began)
    return median(times)


def nanoseconds(name: str, jobs: int, rounds: int, count: int = LANES) -> float:
    """Time per lane and sample of scoring a block on all twelve sweeps."""
    compiled, drives = network(name), runs()
    rows = [compiled.prepare(drive) for drive in drives]
    values, size = lanes(compiled, count), drives[0].samples
    measured, weights = [np.zeros(size)] * len(rows), [np.ones(size)] * len(rows)
    spent = seconds_of(lambda: compiled.score(rows, measured, weights, values, jobs), rounds)
    return 1e9 * spent / (count * size * len(rows))


def swarm_seconds(generations: int, jobs: int) -> float:
    """Time of a particle swarm on the twelve sweeps, through the real optimizer."""
    from dashpot.contract.optimizer import Space
    from dashpot.contract.registry import load_registry

    compiled, drives = network("tire_model_5"), runs()
    rows = [compiled.prepare(drive) for drive in drives]
    force = [compiled.simulate(row) for row in rows]
    weights = [np.ones(drives[0].samples)] * len(rows)
    free = np.array(["[" not in path for path in compiled.paths])

    def losses(cube: np.ndarray) -> np.ndarray:
        values = np.repeat(compiled.start[None], len(cube), axis=0)
        values[:, free] *= np.exp(1.4 * (cube - 0.5))
        return np.sqrt(np.mean(compiled.score(rows, force, weights, values, jobs), axis=0) / drives[0].samples)

    space = Space(tuple(np.array(compiled.paths)[free]), np.full(int(free.sum()), 0.3))
    method = load_registry().optimizers["pso"](particles=LANES, iterations=generations, stall=generations + 1)
    began = time.perf_counter()
    run_search(method, losses, losses, space, 1)
    return time.perf_counter() - began


def start_seconds(code: str, cache: str, rounds: int) -> float:
    """Median time that a fresh process needs for a piece of code, by its own clock."""
    timed = f"import time; began = time.perf_counter()\n{code}\nprint(time.perf_counter() - began)"
    environment = {**os.environ, "DASHPOT_CACHE": cache}
    command = [sys.executable, "-c", timed]
    folder = Path(__file__).parent
    outputs = [subprocess.run(command, env=environment, cwd=folder, capture_output=True, text=True, check=True).stdout
               for _ in range(rounds)]  # fmt: skip
    return median(float(output.split()[-1]) for output in outputs)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--full", action="store_true", help="run all 200 generations of the swarm")
    options = parser.parse_args()
    versions = ", ".join(f"{name} {version(name)}" for name in ("dashpot", "numpy", "numba", "scipy"))
    print(
        f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores, {time.strftime('%Y-%m-%d')}, {versions}"
    )
    print(f"\nns per lane and sample, {LANES} lanes, 12 sweeps of 30 s at 1 kHz")
    for name in NETWORKS:
        print(f"  {name:14s} {nanoseconds(name, 1, options.rounds):7.2f}")
    whole, two = nanoseconds("tire_model_5", 1, options.rounds), nanoseconds("tire_model_5", 2, options.rounds)
    euler = euler_nanoseconds(options.rounds)
    print(f"  tire_model_5 on two threads {two:.2f}, ratio {whole / two:.2f}")
    print(f"  tire_model_5, a single lane {nanoseconds('tire_model_5', 1, 1, 1):.1f}")
    print(f"  scalar explicit Euler of the same laws {euler:.1f}, ratio {euler / whole:.1f}; wrong by newtons")
    generations = GENERATIONS if options.full else 10
    swarm = swarm_seconds(generations, 2) * GENERATIONS / generations
    how = "measured" if options.full else f"from {generations} generations"
    print(f"\nparticle swarm {LANES} x {GENERATIONS} on these runs, two threads: {swarm:.0f} s ({how})")
    with tempfile.TemporaryDirectory() as cold:
        compiling = "from workload import network; network('tire_model_5')"
        first = start_seconds(compiling, cold, 1)
        again = start_seconds(compiling, cold, options.rounds)
    print(f"tire_model_5 in a fresh process: cold {first:.1f} s, from the cache {again:.2f} s, imports included")
    print(f"import dashpot: {start_seconds('import dashpot', '', options.rounds):.3f} s")


if __name__ == "__main__":
    main()

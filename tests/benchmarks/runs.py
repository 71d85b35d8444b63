"""What a fit costs as the number of runs grows: ``python tests/benchmarks/runs.py --write``.

Sweeps of W1 with other amplitudes and preloads, tire model 5 as specimen, noise of 10 N; each fit is a process of its
own.
"""

from __future__ import annotations

import argparse
import resource
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from parts import write_part
from workload import DT, Sweep, network

from dashpot.contract.registry import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.api import fit_network
from dashpot.model.reading import read_network

NOISE, MEGABYTE = 10.0, 1024.0  # N; kB, in which Linux tells the peak


def dataset(count: int) -> Dataset:
    """So many sweeps of 30 s."""
    rng, tire, runs = np.random.default_rng(count), network(), []
    for number in range(count):
        sweep = Sweep(rng.uniform(1e-3, 5e-3), rng.uniform(0.010, 0.025))
        drive = sweep.drive()
        force = tire.simulate(tire.prepare(drive)) + NOISE * rng.standard_normal(drive.samples)
        name, channels = f"r{number}", {"displacement": drive.displacement, "force": force}
        runs.append(Run(name, "sweep", sweep.time, channels, group=name, order=number))
    return Dataset("sweeps", tuple(runs))


def fitted(model: str, count: int) -> tuple[float, float, float]:
    """Processor time in s, peak memory in MB and RMSE in N of a fit on so many runs."""
    registry, data = load_registry(), dataset(count)
    began = time.process_time()
    found = fit_network(read_network(model, registry.elements), data, registry=registry)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / MEGABYTE
    return time.process_time() - began, peak, found.errors.train


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--models", nargs="+", default=["kelvin_voigt", "tire_model_5"])
    parser.add_argument("--runs", nargs="+", type=int, default=[10, 100])
    parser.add_argument("--write", action="store_true", help="put the table into README.md")
    options = parser.parse_args()
    lines = [f"| model | runs of 30 s at {1e-3 / DT:g} kHz | processor time, s | peak memory, MB | RMSE, N |"]
    lines.append("| --- | ---: | ---: | ---: | ---: |")
    for model in options.models:
        for count in options.runs:
            with ProcessPoolExecutor(1, get_context("spawn")) as pool:
                spent, peak, error = pool.submit(fitted, model, count).result()
            lines.append(f"| {model} | {count} | {spent:.1f} | {peak:.0f} | {error:.4g} |")
    print("\n".join(lines))
    if options.write:
        write_part("runs", "\n".join([f"{time.strftime('%Y-%m-%d')}, one thread.", "", *lines]))


if __name__ == "__main__":
    main()

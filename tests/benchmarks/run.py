"""Timings, side by side in one run: ``python tests/benchmarks/run.py``. Never part of a passing or failing test.

Machines are shared and noisy: medians of processor time over several rounds, and ratios, are what counts.
"""

from __future__ import annotations

import argparse
import json
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
from laws import numba_tongue
from measuring import Contestant, time_together
from ordinary import euler_force
from peers import Entry, forces, peers, runge_kutta
from starting import REGISTERS, instructions, start_times, vectors
from tire import tire_equations
from truth import tire_force
from workload import LANES, NETWORK, SWEEPS, Sweep, Task, lanes, network, network_of

LADDER = ("spring", "kelvin_voigt", "gehmann", "ftire", "tire_model_1", "tire_model_2", "tire_model_5", "ubs", "eub")
ELEMENTS = {"maxwell": "stiffness: 8 N/mm, relaxation_time: 30 ms", "prandtl": "stiffness: 9 N/mm, limit: 20 N",
            "dahl": "stiffness: 60 N/mm, limit: 15 N"}  # fmt: skip
COUNTS = (1, 2, 4, 8, 16)
HARDEST = 8  # 5 mm around 10 mm
RESULTS, PAGE = Path(__file__).parent / "results", Path(__file__).parent / "README.md"
BEGIN, END = "<!-- written: results -->", "<!-- end: results -->"
EXACT_PARTS = 64
LIBRARIES = ("dashpot", "numpy", "llvmlite", "numba", "scipy", "numbalsoda", "scikit-sundae")

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
    error = {f"{NETWORK}, {LANES} lanes": tire_error(sweeps), "explicit Euler, numba, scalar":
             rms(euler_force(path, numbers) - tire_force(hardest, numbers))}  # fmt: skip
    yield from _rows(field, rounds, error)


def ladder_rows(sweep: Sweep, rounds: int) -> Iterator[Row]:
    """Networks of one to sixteen elements of a kind, and of fewer samples and lanes: ns per lane and sample."""
    drives = (sweep.drive(),)
    field = []
    for word, numbers in ELEMENTS.items():
        for count in COUNTS:
            branches = f"  it: {{repeat: {count}, element: {word}, {numbers}}}\n"
            task = Task.of(network_of(branches), drives)
            field.append(Contestant(f"{count} {word}", task.score, task.units))
    for share in (0.25, 0.5, 1.0):
        task = Task.of(network(), (replace(sweep, seconds=share * sweep.seconds).drive(),))
        field.append(Contestant(f"{NETWORK}, {task.rows[0].drive.samples} samples", task.score, task.units))
    for count in (8, 16, 32, 192):
        task = Task.of(network(), drives, count)
        field.append(Contestant(f"{NETWORK}, {count} lanes", task.score, task.units))
    yield from _rows(field, rounds, {})


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
        yield {"who": name, "ns": time_of, "clock_ns": timing.clock, "spread": timing.spread,
               **({"error": error[name]} if name in error else {})}  # fmt: skip


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


def measured(quick: bool, rounds: int, count: bool) -> dict:
    """All of it."""
    seconds, short = (3.0, 2.0) if quick else (30.0, 5.0)
    sweeps = tuple(replace(sweep, seconds=seconds) for sweep in (SWEEPS[::5] if quick else SWEEPS))
    others = peer_rows(short)
    content = {
        "machine": {"processor": processor(), "cores": os.cpu_count()}, "date": time.strftime("%Y-%m-%d"),
        "versions": {name: found for name in LIBRARIES if (found := installed(name))},
        "seconds": seconds, "sweeps": len(sweeps), "rounds": rounds, "peer_seconds": short,
        "W1": [*tire_rows(sweeps, rounds), *others["W1"]], "ladder": list(ladder_rows(sweeps[-1], rounds)),
        "W2": [*axle_rows(seconds, rounds), *others["W2"]],
        "start": start_times(1 if quick else rounds), "vectors": vectors(),
    }  # fmt: skip
    return {**content, "instructions": instructions()} if count else content


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


def table(content: dict) -> str:
    """The results as Markdown."""
    versions = ", ".join(f"{name} {found}" for name, found in content["versions"].items())
    lines = [f"{content['date']}, {content['machine']['processor']}, {content['machine']['cores']} cores; {versions}. "
             f"W1: {content['sweeps']} sweeps of {content['seconds']:g} s, W2: one. Medians of {content['rounds']} "
             f"rounds; integrators on {content['peer_seconds']:g} s of one run."]  # fmt: skip
    for work, first in (("W1", f"{NETWORK}, {LANES} lanes"), ("W2", f"{AXLE}, 64 lanes")):
        base = next(row["ns"] for row in content[work] if row["who"] == first)
        lines += ["", f"| {work} | ns per lane and sample | ratio | error rms in N |", "| --- | ---: | ---: | ---: |"]
        lines += [
            f"| {row['who']} | {row['ns']:.3g} | {row['ns'] / base:.3g} | {_error(row)} |" for row in content[work]
        ]
    lines += ["", "| growth | ns per lane and sample |", "| --- | ---: |"]
    lines += [f"| {row['who']} | {row['ns']:.3g} |" for row in content["ladder"]]
    lines += ["", f"| instructions that use | {' | '.join(REGISTERS)} |", "| --- | ---: | ---: | ---: |"]
    lines += [f"| {who} | {' | '.join(map(str, found.values()))} |" for who, found in content["vectors"].items()]
    lines += ["", "| start | s |", "| --- | ---: |"]
    lines += [f"| {what} | {seconds:.3g} |" for what, seconds in content["start"].items()]
    if content.get("instructions"):
        lines += ["", "| instructions per lane and sample, AVX2 | |", "| --- | ---: |"]
        lines += [f"| {name} | {number:.0f} |" for name, number in content["instructions"].items()]
    return "\n".join(lines)


def _error(row: Row) -> str:
    return f"{row['error']:.2g}" if "error" in row else ""


def write(content: dict) -> None:
    """Keep the results of this version, and the table in the README beside this file."""
    RESULTS.mkdir(exist_ok=True)
    text = json.dumps(content, indent=1) + "\n"
    (RESULTS / f"{content['versions']['dashpot']}.json").write_text(text, encoding="utf-8")
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    PAGE.write_text(f"{before}{BEGIN}\n\n{table(content)}\n\n{END}{rest.partition(END)[2]}", encoding="utf-8")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--quick", action="store_true", help="short sweeps, few of them")
    parser.add_argument("--instructions", action="store_true", help="count instructions with valgrind")
    parser.add_argument("--write", action="store_true", help="keep the results and the table")
    options = parser.parse_args()
    content = measured(options.quick, options.rounds, options.instructions)
    print(table(content))
    if options.write:
        write(content)


if __name__ == "__main__":
    main()

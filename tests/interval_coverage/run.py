"""How often 95 % intervals hold the truth: `python tests/interval_coverage/run.py --replicates 300`.

Each replicate measures a network of known numbers on a virtual bench with new coloured noise, identifies it, and looks
whether each interval holds the truth. Printed are the share for each number, the share of all, and its own 95 % range
(Wilson), for each colour of the noise.
"""

from __future__ import annotations

import argparse
import secrets
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from dashpot import load_registry
from dashpot.contract.bench import Bench
from dashpot.contract.measuring import Measuring
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.refine import refine
from dashpot.fit.scored import score_run
from dashpot.fit.uncertainty import assess_uncertainty
from dashpot.fit.virtual_test import virtual_test
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import parse_network

SPECIMEN = """\
format: dashpot-network/1
name: specimen
branches:
  rubber: {element: spring, stiffness: {start: 200 N/mm}}
  oil: {element: damper, damping: {start: 60 N*s/m}}
  slow: {element: maxwell, stiffness: {start: 30 N/mm}, relaxation_time: {start: 25 ms}}
  friction: {element: dahl, stiffness: {start: 60 N/mm}, limit: {start: 20 N}}
"""
NOISE = 9.0
COLOURS = {"white": 0.0, "remembered over 10 ms": 10e-3, "remembered over 50 ms": 50e-3}


@dataclass(frozen=True)
class Case:
    """A network, the bench it is measured on, and its true numbers by path."""

    spec: NetworkSpec
    bench: Bench
    truth: dict[str, float]


def case(memory: float, sweeps: int, duration: float) -> Case:
    """Slow loops and some sweeps."""
    registry = load_registry()
    spec = parse_network(SPECIMEN, registry.elements, "specimen.yaml")
    amplitudes = tuple(np.geomspace(0.3e-3, 3e-3, sweeps))
    rigs = (
        registry.rigs["triangle"](depth=6e-3, speed=4e-3, loops=2),
        registry.rigs["hydropulser"](amplitudes=amplitudes, preloads=(4e-3,), duration=duration, direction="up"),
    )
    bench = Bench("coverage", rigs, Measuring(force_noise=NOISE, noise_memory=memory))
    return Case(spec, bench, {slot.path: slot.value.number for slot in spec.slots()})


def intervals(one: Case, seed: int) -> dict[str, tuple[float, float]]:
    """The 95 % intervals from one measurement, by path."""
    runs = [score_run(run) for run in virtual_test(one.spec, one.bench, seed)]
    spec = with_ranges(one.spec, natural_sizes(runs))
    objective, coordinates = Objective(compile_network(spec), runs), search_coordinates(spec)
    found = refine(objective, coordinates, coordinates.start)
    known = assess_uncertainty(objective, coordinates, found.point)
    return dict(zip(coordinates.paths, known.intervals, strict=True))


def hits(one: Case, replicates: int, seed: int) -> dict[str, list[bool]]:
    """For each number whether each interval held the truth."""
    found: dict[str, list[bool]] = {path: [] for path in one.truth}
    for number in range(replicates):
        for path, (low, high) in intervals(one, seed + number).items():
            found[path].append(low <= one.truth[path] <= high)
    return found


def wilson(count: int, total: int) -> tuple[float, float]:
    """The 95 % range of a share."""
    z, share = 1.96, count / total
    middle = (share + z**2 / (2 * total)) / (1 + z**2 / total)
    half = z * np.sqrt(share * (1 - share) / total + z**2 / (4 * total**2)) / (1 + z**2 / total)
    return middle - half, middle + half


def lines(found: dict[str, list[bool]]) -> Iterator[str]:
    """A line for each number and one for all."""
    rows = {**found, "all": [hit for each in found.values() for hit in each]}
    for path, each in rows.items():
        low, high = wilson(sum(each), len(each))
        yield f"  {path:24s} {100 * np.mean(each):5.1f} %  ({100 * low:.1f} to {100 * high:.1f})  of {len(each)}"


def main() -> None:
    """Print the coverage for every colour of noise."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--replicates", type=int, default=300)
    parser.add_argument("--sweeps", type=int, default=3)
    parser.add_argument("--duration", type=float, default=4.0, help="of a sweep, s")
    parser.add_argument("--seed", type=int, default=secrets.randbits(30))
    given = parser.parse_args()
    print(f"{given.replicates} replicates, {given.sweeps} sweeps of {given.duration:g} s, seed {given.seed}")
    for colour, memory in COLOURS.items():
        print(f"noise {colour}", flush=True)
        print(
            "\n".join(lines(hits(case(memory, given.sweeps, given.duration), given.replicates, given.seed))), flush=True
        )


if __name__ == "__main__":
    main()

"""What every element costs at every kind of its numbers: ``python tests/benchmarks/elements.py``."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from measuring import Contestant, time_together
from parts import write_part
from workload import DT, LANES, Task

from dashpot.contract.registry import load_registry
from dashpot.data.drive import Drive
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element, Parameter
from dashpot.testing import random_drive
from dashpot.testing.specimen import Sizes, draw_specimens
from dashpot.text.quantity import dimensions

SIZES = Sizes(100.0, 1e-3, 0.02)
SAMPLES = 10_000
NEAT = (0.0, 0.5, 1.0, 1.5, 2.0)  # where laws often change their form


@dataclass(frozen=True, eq=False)
class Regime:
    """An element with one of its pure numbers held; without a ``key`` those that have a default are left out."""

    element: type[Element]
    key: str = ""
    number: float = 0.0

    @property
    def name(self) -> str:
        """The regime in words."""
        return f"`{self.key}` {self.number:g}" if self.key else "defaults"

    def task(self, drive: Drive) -> Task:
        """``LANES`` lanes of it on a motion."""
        specimen = draw_specimens(self.element, np.random.default_rng(1), SIZES, LANES)[0 if self.key else -1]
        compiled, values = compile_network(specimen.spec), specimen.values.copy()
        if self.key:
            values[:, [path.rpartition(".")[2] for path in compiled.paths].index(self.key)] = self.number
        return Task(compiled, (compiled.prepare(drive),), values, 1)


def regimes(element: type[Element]) -> Iterator[Regime]:
    """An element with random numbers, and with each of its pure numbers at its ends and at neat values between."""
    yield Regime(element)
    for key, parameter in element.declares.parameters.items():
        if dimensions(parameter.unit) == (0.0, 0.0, 0.0):
            yield from (Regime(element, key, number) for number in _neat(parameter))


def _neat(parameter: Parameter) -> list[float]:
    low, high = parameter.bounds
    return sorted({low, high, *(number for number in NEAT if low < number < high)})


def rows(words: list[str], rounds: int) -> Iterator[str]:
    """The table as Markdown, a line as soon as it is known."""
    yield "| element | ns with its defaults | ns at most | at |"
    yield "| --- | ---: | ---: | --- |"
    drive = random_drive(np.random.default_rng(1), "multisine", SIZES.length, SIZES.time, SAMPLES, DT)
    for word, element in sorted(load_registry().elements.items()):
        if words and word not in words:
            continue
        tasks = {regime.name: regime.task(drive) for regime in regimes(element)}
        found = time_together([Contestant(name, task.score, task.units) for name, task in tasks.items()], rounds)
        plain, *others = ((timing.cpu, name) for name, timing in found.items())
        most, where = max([plain, *others])
        yield f"| `{word}` | {plain[0]:.2g} | {most:.2g} | {where} |"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("elements", nargs="*", help="these alone")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--write", action="store_true", help="keep the table")
    options = parser.parse_args()
    lines = []
    for line in rows(options.elements, options.rounds):
        print(line, flush=True)
        lines.append(line)
    if options.write:
        write_part("elements", "\n".join([f"{time.strftime('%Y-%m-%d')}, {LANES} lanes, one core.", "", *lines]))


if __name__ == "__main__":
    main()

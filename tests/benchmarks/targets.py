"""Every shipped network on every target: ``python tests/benchmarks/targets.py``. Nothing here passes or fails.

One lane, one thread. The difference is the largest one of a force, as a share of its root mean square, from the graph
as numpy interprets it; networks with unknown nodes, which are not interpreted, are held against LLVM. Compiling begins
with the traced network and ends with the first result, with empty caches; numba itself has been started before.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parent))

import numpy as np
from numba import njit
from parity.c_library import Library
from parity.cubics import along_cubics
from parts import write_part
from verification.shipped import NAMES, Dice, filled

from dashpot import load_registry
from dashpot.data.drive import Drive
from dashpot.data.excitation import Excitation
from dashpot.kernel.eager import simulate_interpreted
from dashpot.kernel.export import exported
from dashpot.kernel.jit import jit_network
from dashpot.kernel.network import compile_network
from dashpot.kernel.system import CompiledSystem
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import read_network
from dashpot.testing import random_drive

SYSTEMS = ("quarter_car", "axle_model_1", "axle_model_2", "axle_model_3", "axle_model_3_top_mount")
TARGETS = ("llvm", "numba", "jit", "c")
SEED, SAMPLES, ROUNDS = 1, 4000, 50
RESULTS = Path(__file__).parent / "results" / "targets.json"
PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "use-elsewhere.md"

Force = np.ndarray
Run = Callable[[], Force]


class Task:
    """A network, the motions of its driven nodes, and its numbers."""

    def __init__(self, name: str) -> None:
        rng = np.random.default_rng(SEED)
        self.coupled = name in SYSTEMS
        self.spec: NetworkSpec = (
            read_network(name, load_registry().elements) if self.coupled else filled(name, Dice(SEED))
        )
        found = exported(self.spec)
        motions = {
            node: along_cubics(random_drive(rng, "multisine", 6e-3, 0.01, SAMPLES, 1e-3))
            for node in found.online.driven
        }
        self.drives: list[Drive] = list(motions.values())
        self.excitation = Excitation(motions, {}, {"added_mass": 0.0}, self.drives[0].dt, SAMPLES, "run")
        self.values = np.array(found.values)

    def interpreted(self) -> Force | None:
        """The forces of the graph, where they can be interpreted."""
        return None if self.coupled else simulate_interpreted(self.spec, self.drives[0], self.values)[None]

    def kernel(self, backend: str) -> Run:
        """The kernel of dashpot on a backend."""
        os.environ["DASHPOT_BACKEND"] = backend
        network = compile_network(self.spec)
        if isinstance(network, CompiledSystem):
            prepared = network.prepare(self.excitation)
            return lambda: network.solve(prepared).force[0]
        run = network.prepare(self.drives[0])
        return lambda: network.simulate(run, self.values)[None]

    def jit(self) -> Run:
        """The solver in a loop of somebody's own."""
        solver = jit_network(self.spec)
        given = [
            np.column_stack([getattr(each, name) for each in self.drives]) for name in ("displacement", "velocity")
        ]
        span, dt = max(float(np.ptp(each.displacement)) for each in self.drives), self.drives[0].dt
        out = np.empty((SAMPLES, len(solver.driven) + len(solver.free)))
        loop = _stepping(solver.step) if solver.step else _stepping_nodes(solver.step_nodes)

        def run() -> Force:
            loop(solver.state(span), *given, dt, self.values, out)
            return out[:, : len(self.drives)].T

        return run

    def c(self, folder: Path) -> Run:
        """The C source, behind a loop in C."""
        library = Library.build(self.spec, folder)
        return lambda: library.along(self.drives, self.values)[0][:, : len(self.drives)].T

    def on(self, target: str, folder: Path) -> Run:
        """A run on a target, whose caches are in a folder."""
        os.environ["DASHPOT_CACHE"] = str(folder)
        if target in ("llvm", "numba"):
            return self.kernel(target)
        return self.jit() if target == "jit" else self.c(folder)


def _stepping(step):  # type: ignore[no-untyped-def]
    @njit(nogil=True)
    def loop(state, x, v, dt, numbers, out):  # type: ignore[no-untyped-def]
        for k in range(len(x)):
            out[k, 0] = step(state, x[k, 0], v[k, 0], dt, numbers)

    return loop


def _stepping_nodes(step_nodes):  # type: ignore[no-untyped-def]
    @njit(nogil=True)
    def loop(state, x, v, dt, numbers, out):  # type: ignore[no-untyped-def]
        for k in range(len(x)):
            step_nodes(state, x[k], v[k], x[k, :0], dt, numbers, out[k])

    return loop


def measured(name: str) -> dict[str, dict[str, float]]:
    """The largest difference, s of compiling and ns a sample, by target."""
    task, found = Task(name), {}
    expected = task.interpreted()
    for target in TARGETS:
        with TemporaryDirectory() as folder:
            begin = _spent()
            run = task.on(target, Path(folder))
            force = run()
            spent = _spent() - begin
            expected = force if expected is None else expected
            found[target] = {
                "difference": float(np.max(np.abs(force - expected)) / np.sqrt(np.mean(expected**2))),
                "compile_s": spent,
                "ns": 1e9 * min(map(_timed, [run] * ROUNDS)) / SAMPLES,
            }
    return found


def _spent() -> float:
    """Processor time of this process and of those that it has waited for: others take from the clock alone."""
    return sum(os.times()[:4])


def _timed(run: Run) -> float:
    begin = time.process_time()  # one thread: what others take from the clock does not count
    run()
    return time.process_time() - begin


def table(content: dict[str, dict[str, dict[str, float]]]) -> str:
    """The results as Markdown."""
    head = [
        "| network | " + " | ".join(f"`{target}`" for target in TARGETS) + " |",
        "| --- " * (len(TARGETS) + 1) + "|",
    ]
    rows = [
        f"| `{name}` | {' | '.join(_cell(content[name][target]) for target in TARGETS)} |"
        for name in (*NAMES, *SYSTEMS)
        if name in content
    ]
    return "\n".join(head + rows)


def _cell(found: dict[str, float]) -> str:
    return f"{found['difference']:.0e}, {found['compile_s']:.2g} s, {found['ns']:.3g} ns"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("networks", nargs="*", default=[*NAMES, *SYSTEMS])
    parser.add_argument("--write", action="store_true", help="keep the rows, and the table in the documentation")
    options = parser.parse_args()
    measured("spring")  # what is loaded and started once does not count
    content = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.is_file() and options.write else {}
    for name in options.networks:
        content[name] = measured(name)
        print(table({name: content[name]}).splitlines()[-1], flush=True)
        if options.write:
            RESULTS.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
            write_part("targets", table(content), PAGE)


if __name__ == "__main__":
    main()

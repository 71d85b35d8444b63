"""A compiled network with unknown nodes: simulate and score whole blocks of lanes, with an estimate of the error."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive, refined_path
from dashpot.data.excitation import Excitation
from dashpot.expr.interpret import interpret
from dashpot.kernel.block import Block, blocks_of
from dashpot.kernel.compiled import Compiled
from dashpot.kernel.compiler.compile import system_of
from dashpot.kernel.compiler.mechanics import MOVED, Meter, driven_symbol
from dashpot.kernel.compiler.trace import refuse_missing_numbers
from dashpot.kernel.ir.layout import LANES
from dashpot.kernel.ir.system import FARTHEST, SMALLEST_SPAN, TOLERANCE, UNBALANCED, UNSOLVED, SystemProgram
from dashpot.kernel.scheme import PAIR, alternate
from dashpot.kernel.settings import used_settings, with_settings
from dashpot.kernel.targets.choice import Code, target
from dashpot.kernel.workers import spread
from dashpot.model.network import Characteristic, NetworkSpec
from dashpot.model.topology import Topology, topology_of

Array = NDArray[np.float64]

WIDTH = LANES  # of a group
PAIRS = 1  # coarse steps in a sample, in pairs


class Status(Enum):
    """How a lane ended; the value is the message."""

    GOOD = "solved"
    UNSOLVED = "the forces at the inner nodes could not be balanced in some step"
    UNBALANCED = "no static equilibrium was found at the begin of the record"
    NOT_FINITE = "a force is not a finite number"


_CODES = {0: Status.GOOD, UNSOLVED: Status.UNSOLVED, UNBALANCED: Status.UNBALANCED}


def status_of(code: float, answer: Array) -> Status:
    """How a lane ended, from the code of the kernel and what it answered."""
    return _CODES[int(code)] if np.isfinite(answer).all() else Status.NOT_FINITE


@dataclass(frozen=True, eq=False)
class SystemRows:
    """The part of the work on a run that depends on its excitation alone."""

    excitation: Excitation
    pairs: int
    still: Array
    coarse: Array
    fine: Array


@dataclass(frozen=True, eq=False)
class Solution:
    """Forces (lanes, driven nodes, samples) in N and motions (lanes, unknown nodes, samples) in m, of the nodes named.

    ``error`` (lanes, driven nodes) in N is the estimated root mean square error of the forces, from halving the steps;
    it is that of the short steps, before their leading error was taken away. ``status`` is one for each lane.
    """

    driven: tuple[str, ...]
    unknown: tuple[str, ...]
    force: Array
    motion: Array
    error: Array
    status: tuple[Status, ...]


@dataclass(frozen=True)
class CompiledSystem(Compiled[SystemRows]):
    """A compiled network with unknown nodes; see ``Compiled``. ``signals`` are forces over time that laws refer to."""

    topology: Topology
    system: SystemProgram
    native: Code
    signals: tuple[str, ...] = ()

    @cached_property
    def outputs(self) -> tuple[str, ...]:
        """The driven nodes, whose forces are answered."""
        return self.topology.held("driven")

    @cached_property
    def _knots(self) -> Array:
        return np.array([at for curve in _tabulated(self.spec).values() for at in (curve.at[0], *curve.at)])

    def prepare(self, motion: Drive | Excitation, pairs: int = PAIRS) -> SystemRows:
        """The part of the work that depends on the excitation alone; ``pairs`` of coarse steps lie in a sample."""
        whole = Excitation.of_drive(motion) if isinstance(motion, Drive) else motion
        excitation = whole.at(self.outputs, self.topology.held("loaded"))
        if whole is motion:
            excitation = replace(excitation, settings=used_settings(self.spec, whole.settings, whole.name))
        return SystemRows(
            excitation,
            pairs,
            self._columns({"dt": excitation.dt, **self._still(excitation)}, 1),
            self._moved(excitation, PAIR * pairs),
            self._moved(excitation, 2 * PAIR * pairs),
        )

    def with_signals(self, run: SystemRows, signals: Mapping[str, Array]) -> SystemRows:
        """A prepared run with forces (n,) in N for some of the ``signals``, straight from sample to sample."""
        columns = {node.payload: number for number, node in enumerate(self.program.columns) if not node.arguments}
        still, coarse, fine = run.still.copy(), run.coarse.copy(), run.fine.copy()
        for signal, given in signals.items():
            column = columns[driven_symbol(signal, "load")]
            still[:, column] = given[0]
            for rows in (coarse, fine):
                parts = len(rows) // (given.size - 1)
                rows[:, column] = (given[:-1, None] + np.outer(np.diff(given), np.arange(1, parts + 1) / parts)).ravel()
        return replace(run, still=still, coarse=coarse, fine=fine)

    def solve(self, run: SystemRows, values: Array | None = None) -> Solution:
        """Forces and motions with their estimated errors."""
        lanes = self._lanes(run, values)
        samples, driven, unknown = run.excitation.samples, self.outputs, self.topology.unknown
        out = np.empty((lanes.shape[0], len(driven) + len(unknown), samples))
        error, status = np.empty((lanes.shape[0], len(driven))), np.empty(lanes.shape[0])
        for block in self._blocks(run, lanes):
            answer, miss = np.empty((samples, out.shape[1], WIDTH)), np.zeros((len(driven), WIDTH))
            status[block.place] = self._run(run, block, answer, miss)
            out[block.place] = answer[:, :, : block.count].transpose(2, 1, 0)
            error[block.place] = np.sqrt(miss[:, : block.count] / samples).T / 3.0
        force, motion = out[:, : len(driven)], out[:, len(driven) :]
        for joint, inner in self.topology.mounts.items():
            motion[:, unknown.index(inner)] += run.excitation.motions[joint].displacement
        states = tuple(status_of(code, own) for code, own in zip(status, force, strict=True))
        return Solution(driven, unknown, force, motion, error, states)

    def forces(self, run: SystemRows, values: Array | None = None) -> Array:
        """The forces at the driven nodes (lanes, nodes, samples) in N; a lane that failed answers NaN."""
        found = self.solve(run, values)
        found.force[[status is not Status.GOOD for status in found.status]] = np.nan
        return found.force

    def simulate(self, run: SystemRows, values: Array | None = None, end: str | None = None) -> Array:
        """The force at a driven node (lanes, samples) in N, by default the first one; a lane that failed answers NaN.

        One lane is answered as (samples,).
        """
        force = self.forces(run, values)[:, self.number_of(end) if end else 0]
        return force[0] if values is None or np.ndim(values) == 1 else force

    def last_rows(self, run: SystemRows, values: Array | None = None) -> tuple[dict[str, Array], Array]:
        """Every row of the workspace by name after the last sample, (2, lanes): long steps, short steps; and the codes.

        ``Equations`` names the rows.
        """
        lanes = self._lanes(run, values)
        zeros = np.zeros((run.excitation.samples, len(self.outputs)))
        spaces, codes = [], []
        for block in self._blocks(run, lanes):
            out, miss = np.zeros((2, len(self.outputs), WIDTH))
            codes.append(self._run(run, block, out, miss, (zeros, zeros)))
            spaces.append(block.workspace[..., : block.count])
        rows = np.concatenate(spaces, axis=2)
        return {name: rows[:, self.system.row(name)] for name in self.program.states}, np.concatenate(codes)

    def number_of(self, end: str) -> int:
        """The place of a driven node among all; a network with a single one has it under any name."""
        return 0 if len(self.outputs) == 1 else self.outputs.index(end)

    def score(self, runs: Sequence[SystemRows], measured: Sequence[Array], weights: Sequence[Array], values: Array,
              jobs: int = 1) -> Array:  # fmt: skip
        """Weighted sums of squared errors (runs, nodes, lanes) against ``measured`` (nodes, samples), no force stored.

        A lane that fails scores NaN.
        """

        def work(run: SystemRows, target: Array, weight: Array) -> Array:
            return self._score(run, _by_sample(target), _by_sample(weight), values)

        return np.array(spread(work, runs, measured, weights, jobs=jobs))

    def _score(self, run: SystemRows, measured: Array, weight: Array, values: Array) -> Array:
        lanes = self._lanes(run, values)
        total = np.empty((len(self.outputs), lanes.shape[0]))
        for block in self._blocks(run, lanes):
            out, miss = np.zeros((2, len(self.outputs), WIDTH))
            status = self._run(run, block, out, miss, (measured, weight))
            total[:, block.place] = np.where(status, np.nan, out[:, : block.count])
        return total

    def _run(self, run: SystemRows, block: Block, out: Array, miss: Array,
             scoring: tuple[Array, Array] | None = None) -> Array:  # fmt: skip
        status = np.zeros(WIDTH)
        measured, weight = scoring or (None, None)
        self.native(
            run.still, run.coarse, run.fine, PAIR * run.pairs, run.excitation.samples, block.workspace, status,
            block.tables, self._knots, measured, weight, out, miss, int(scoring is not None), block.count,
        )  # fmt: skip
        return status[: block.count]

    def _blocks(self, run: SystemRows, lanes: Array) -> Iterator[Block]:
        step = run.excitation.dt / (PAIR * run.pairs)
        workspace = np.stack([self._fill(self.system.rows, dt, lanes) for dt in (step, 0.5 * step)])
        return blocks_of(self._tabulate(_tabulated(self.spec), lanes), workspace, WIDTH)

    def _lanes(self, run: SystemRows, values: Array | None) -> Array:
        return with_settings(
            self.spec, np.atleast_2d(self.start if values is None else values), run.excitation.settings
        )

    def _moved(self, excitation: Excitation, parts: int) -> Array:
        seen: dict[str, Array | float] = {"dt": excitation.dt / parts}
        count = (excitation.samples - 1) * parts
        for joint in self.outputs:
            x, v, a = refined_path(excitation.motions[joint], parts)
            moved = dict(zip(MOVED, (x[:-1], x[1:], v[:-1], v[1:], a[1:]), strict=True))
            seen |= {driven_symbol(joint, key): column for key, column in moved.items()}
        for joint in self.topology.held("loaded"):
            at = np.arange(1, count + 1) / parts
            seen[driven_symbol(joint, "load")] = _between(excitation.loads[joint], at)
        seen |= dict.fromkeys((driven_symbol(signal, "load") for signal in self.signals), 0.0)
        rule = alternate(excitation.dt / parts, count // PAIR)
        seen |= {f"rule.{key}": getattr(rule, key) for key in ("slope", "now", "before", "swing")}
        return self._columns({**seen, **self._newton(excitation)}, count)

    def _still(self, excitation: Excitation) -> dict[str, float]:
        seen = {f"rule.{key}": 0.0 for key in ("now", "before", "swing")} | self._newton(excitation)
        seen["rule.slope"] = 1.0 / excitation.dt
        for joint in self.outputs:
            motion = excitation.motions[joint]
            place, speed = float(motion.displacement[0]), float(motion.velocity[0])
            begin = dict(zip(MOVED, (place, place, speed, speed, float(motion.acceleration[0])), strict=True))
            seen |= {driven_symbol(joint, key): number for key, number in begin.items()}
        for joint in self.topology.held("loaded"):
            seen[driven_symbol(joint, "load")] = float(excitation.loads[joint][0])
        return seen | dict.fromkeys((driven_symbol(signal, "load") for signal in self.signals), 0.0)

    def _newton(self, excitation: Excitation) -> dict[str, float]:
        spans = [np.ptp(drive.displacement) for drive in excitation.motions.values()]
        span = float(max([SMALLEST_SPAN, *spans]))
        return {"newton.tolerance": TOLERANCE * span, "newton.farthest": FARTHEST * span}

    def _columns(self, seen: dict[str, Array | float], count: int) -> Array:
        found = np.zeros((count, len(self.program.columns)))
        for column, values in zip(found.T, interpret(self.program.columns, seen), strict=True):
            column[:] = values
        return found


def compile_system(
    spec: NetworkSpec, topology: Topology | None = None, meter: Meter | None = None, signals: Sequence[str] = ()
) -> CompiledSystem:
    """Trace, balance, sort, print, compile; a ``meter`` goes along. InputError for what cannot be compiled.

    A law may refer to a force over time, one of the ``signals``, by its ``driven_symbol``; see ``with_signals``.
    """
    refuse_missing_numbers(spec)
    topology = topology or topology_of(spec)
    system = system_of(spec, topology, meter, signals)
    return CompiledSystem(spec, system.program, topology, system, target().system(system), tuple(signals))


def _tabulated(spec: NetworkSpec) -> dict[str, Characteristic]:
    return {path: curve for path, curve in spec.curves().items() if curve.form == "table"}


def _by_sample(rows: Array) -> Array:
    return np.ascontiguousarray(np.transpose(rows), dtype=float)


def _between(samples: Array, at: Array) -> Array:
    from scipy.interpolate import make_interp_spline

    return make_interp_spline(np.arange(samples.size), samples, k=3 if samples.size > 3 else 1)(at)

"""A compiled network with unknown nodes: simulate and score whole blocks of lanes, with an estimate of the error."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
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
PIECE = 20_000  # samples, with a pair of coarse steps in each, that are prepared at a time
KEPT = 10 * PIECE  # of a record that stays prepared; a longer one is prepared piece by piece, each time anew


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
class Piece:
    """Samples ``first`` up to ``end`` of a record, and what drives the steps that lead to them."""

    first: int
    end: int
    coarse: Array
    fine: Array


@dataclass(frozen=True, eq=False)
class SystemRows:
    """The part of the work on a run that depends on its excitation alone; ``pieces`` may be gone through again."""

    excitation: Excitation
    pairs: int
    still: Array
    pieces: Iterable[Piece]

    @property
    def nbytes(self) -> int:
        """The bytes of the pieces that stay prepared."""
        kept = self.pieces if isinstance(self.pieces, tuple) else ()
        return sum(piece.coarse.nbytes + piece.fine.nbytes for piece in kept)


@dataclass(frozen=True, eq=False)
class _Pieces:
    """The pieces of a record, made when they are asked for."""

    samples: int
    size: int
    make: Callable[[int, int], Piece]

    def __iter__(self) -> Iterator[Piece]:
        for first in range(0, self.samples, self.size):
            yield self.make(first, min(first + self.size, self.samples))


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
        still = self._columns({"dt": excitation.dt, **self._still(excitation)}, 1)
        newton, loads = self._newton(excitation), {node: _spline(load) for node, load in excitation.loads.items()}

        def make(first: int, end: int) -> Piece:
            coarse, fine = (
                self._moved(excitation, loads, newton, parts, first, end) for parts in (PAIR * pairs, 2 * PAIR * pairs)
            )
            return Piece(first, end, coarse, fine)

        pieces = _Pieces(excitation.samples, max(PIECE // pairs, 1), make)
        return SystemRows(excitation, pairs, still, tuple(pieces) if pairs * excitation.samples <= KEPT else pieces)

    def with_signals(self, run: SystemRows, signals: Mapping[str, Array]) -> SystemRows:
        """A prepared run with forces (n,) in N for some of the ``signals``, straight from sample to sample."""
        columns = {node.payload: number for number, node in enumerate(self.program.columns) if not node.arguments}
        places = {columns[driven_symbol(signal, "load")]: given for signal, given in signals.items()}
        still = run.still.copy()
        for column, given in places.items():
            still[:, column] = given[0]

        def signalled(piece: Piece) -> Piece:
            coarse, fine = piece.coarse.copy(), piece.fine.copy()
            for column, given in places.items():
                own = given[max(piece.first - 1, 0) : piece.end]
                for rows in (coarse, fine):
                    parts = len(rows) // max(own.size - 1, 1)
                    rows[:, column] = (own[:-1, None] + np.outer(np.diff(own), np.arange(1, parts + 1) / parts)).ravel()
            return Piece(piece.first, piece.end, coarse, fine)

        return replace(run, still=still, pieces=[signalled(piece) for piece in run.pieces])

    def solve(self, run: SystemRows, values: Array | None = None) -> Solution:
        """Forces and motions with their estimated errors."""
        lanes = self._lanes(run, values)
        samples, driven, unknown = run.excitation.samples, self.outputs, self.topology.unknown
        out = np.empty((lanes.shape[0], len(driven) + len(unknown), samples))
        blocks = list(self._blocks(run, lanes))
        misses, states = np.zeros((len(blocks), len(driven), WIDTH)), np.zeros((len(blocks), WIDTH))
        for piece in run.pieces:
            answer = np.empty((piece.end - piece.first, out.shape[1], WIDTH))
            for block, miss, state in zip(blocks, misses, states, strict=True):
                self._run(run, piece, block, answer, miss, state)
                out[block.place, :, piece.first : piece.end] = answer[:, :, : block.count].transpose(2, 1, 0)
        error = np.sqrt(_of_lanes(misses, lanes.shape[0]) / samples).T / 3.0
        status = _of_lanes(states, lanes.shape[0])
        force, motion = out[:, : len(driven)], out[:, len(driven) :]
        for joint, inner in self.topology.mounts.items():
            motion[:, unknown.index(inner)] += run.excitation.motions[joint].displacement
        return Solution(
            driven,
            unknown,
            force,
            motion,
            error,
            tuple(status_of(code, own) for code, own in zip(status, force, strict=True)),
        )

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
        blocks, _, codes = self._scored(run, zeros, zeros, lanes)
        rows = np.concatenate([block.workspace[..., : block.count] for block in blocks], axis=2)
        return {name: rows[:, self.system.row(name)] for name in self.program.states}, codes

    def number_of(self, end: str) -> int:
        """The place of a driven node among all; a network with a single one has it under any name."""
        return 0 if len(self.outputs) == 1 else self.outputs.index(end)

    def score(
        self,
        runs: Sequence[SystemRows],
        measured: Sequence[Array],
        weights: Sequence[Array],
        values: Array,
        jobs: int = 1,
    ) -> Array:
        """Weighted sums of squared errors (runs, nodes, lanes) against ``measured`` (nodes, samples), no force stored.

        A lane that fails scores NaN.
        """

        def work(run: SystemRows, target: Array, weight: Array) -> Array:
            return self._score(run, _by_sample(target), _by_sample(weight), values)

        return np.array(spread(lambda each: work(*each), zip(runs, measured, weights, strict=True), jobs))

    def _score(self, run: SystemRows, measured: Array, weight: Array, values: Array) -> Array:
        _, totals, codes = self._scored(run, measured, weight, self._lanes(run, values))
        return np.where(codes, np.nan, totals)

    def _scored(
        self, run: SystemRows, measured: Array, weight: Array, lanes: Array
    ) -> tuple[list[Block], Array, Array]:
        """The blocks as they are after the last sample, the scores (nodes, lanes), and how each lane ended."""
        blocks = list(self._blocks(run, lanes))
        totals, misses = np.zeros((2, len(blocks), len(self.outputs), WIDTH))
        states = np.zeros((len(blocks), WIDTH))
        for piece in run.pieces:
            scoring = measured[piece.first : piece.end], weight[piece.first : piece.end]
            for block, total, miss, state in zip(blocks, totals, misses, states, strict=True):
                self._run(run, piece, block, total, miss, state, scoring)
        return blocks, _of_lanes(totals, lanes.shape[0]), _of_lanes(states, lanes.shape[0])

    def _run(
        self,
        run: SystemRows,
        piece: Piece,
        block: Block,
        out: Array,
        miss: Array,
        status: Array,
        scoring: tuple[Array, Array] | tuple[None, None] = (None, None),
    ) -> None:
        self.native(
            run.still,
            piece.coarse,
            piece.fine,
            PAIR * run.pairs,
            piece.end - piece.first,
            block.workspace,
            status,
            block.tables,
            self._knots,
            *scoring,
            out,
            miss,
            int(scoring[0] is not None),
            int(piece.first == 0),
            block.count,
        )

    def _blocks(self, run: SystemRows, lanes: Array) -> Iterator[Block]:
        step = run.excitation.dt / (PAIR * run.pairs)
        workspace = np.stack([self._fill(self.system.rows, dt, lanes) for dt in (step, 0.5 * step)])
        return blocks_of(self._tabulate(_tabulated(self.spec), lanes), workspace, WIDTH)

    def _lanes(self, run: SystemRows, values: Array | None) -> Array:
        return with_settings(
            self.spec, np.atleast_2d(self.start if values is None else values), run.excitation.settings
        )

    def _moved(
        self,
        excitation: Excitation,
        loads: Mapping[str, Callable[[Array], Array]],
        newton: Mapping[str, float],
        parts: int,
        first: int,
        end: int,
    ) -> Array:
        # the steps to the samples from `first` up to `end`, from the sample before
        seen: dict[str, Array | float] = {"dt": excitation.dt / parts}
        before = max(first - 1, 0)
        count = (end - 1 - before) * parts
        for joint in self.outputs:
            x, v, a = refined_path(excitation.motions[joint], parts, before, end)
            moved = dict(zip(MOVED, (x[:-1], x[1:], v[:-1], v[1:], a[1:]), strict=True))
            seen |= {driven_symbol(joint, key): column for key, column in moved.items()}
        for joint in self.topology.held("loaded"):
            at = np.arange(before * parts + 1, before * parts + count + 1) / parts
            seen[driven_symbol(joint, "load")] = loads[joint](at)
        seen |= dict.fromkeys((driven_symbol(signal, "load") for signal in self.signals), 0.0)
        rule = alternate(excitation.dt / parts, count // PAIR, begins=before == 0)
        seen |= {f"rule.{key}": getattr(rule, key) for key in ("slope", "now", "before", "swing")}
        return self._columns({**seen, **newton}, count)

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


def _of_lanes(blocks: Array, count: int) -> Array:
    """From numbers (blocks, ..., WIDTH) to those of the lanes (..., lanes) that were asked for."""
    return np.concatenate(list(blocks), axis=-1)[..., :count]


def _spline(samples: Array) -> Callable[[Array], Array]:
    from scipy.interpolate import make_interp_spline

    return make_interp_spline(np.arange(samples.size), samples, k=3 if samples.size > 3 else 1)

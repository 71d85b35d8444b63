"""A compiled network: simulate and score whole blocks of lanes."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.data.excitation import Excitation
from dashpot.kernel.block import Block, aligned_copy
from dashpot.kernel.columns import Rows, prepare_rows
from dashpot.kernel.compiled import Compiled, padded
from dashpot.kernel.layout import Passes, score_row
from dashpot.kernel.native import Native, load_native
from dashpot.kernel.settings import with_settings
from dashpot.kernel.source import WIDTH, print_source
from dashpot.kernel.system import CompiledSystem, compile_system
from dashpot.kernel.tiers import sort_tiers
from dashpot.kernel.trace import refuse_missing_numbers, trace_network
from dashpot.model.network import END, Characteristic, NetworkSpec
from dashpot.model.topology import topology_of

Array = NDArray[np.float64]


@dataclass(frozen=True)
class CompiledNetwork(Compiled):
    """A compiled network all of whose elements see the motion of its driven end; see ``Compiled``."""

    native: Native

    @cached_property
    def curves(self) -> dict[str, Characteristic]:
        """Every curve of the network by path."""
        return self.spec.curves()

    @cached_property
    def rows(self) -> int:
        """How many rows the workspace of a block has."""
        return Passes.of(self.program).rows

    def prepare(self, motion: Drive | Excitation) -> Rows:
        """The part of the work that depends on the drive alone."""
        if isinstance(motion, Drive):
            return prepare_rows(self.program, self.curves, motion, {})
        return prepare_rows(self.program, self.curves, motion.at((END,), ()).motions[END], motion.settings)

    def simulate(self, run: Rows, values: Array | None = None) -> Array:
        """The force of the specimen (lanes, samples) in N; one lane is answered as (samples,)."""
        lanes = with_settings(self.spec, np.atleast_2d(self.start if values is None else values), run.settings)
        out = np.empty((lanes.shape[0], run.drive.samples))
        for block in self._blocks(run.drive.dt, lanes):
            buffer = np.empty((run.drive.samples, block.width))
            self.native.simulate(*_arguments(run, block, block.fresh_workspace()), buffer)
            out[block.place] = buffer.T[: block.count]
        return out[0] if values is None or np.ndim(values) == 1 else out

    def score(self, runs: Sequence[Rows], measured: Sequence[Array], weights: Sequence[Array], values: Array,
              jobs: int = 1) -> Array:  # fmt: skip
        """Weighted sums of squared errors (runs, lanes) against ``measured``, without storing any force.

        A lane whose force is not finite scores NaN.
        """
        lanes = np.atleast_2d(values)
        blocks: dict[Hashable, list[Block]] = {}
        for run in runs:
            if _make(run) not in blocks:
                blocks[_make(run)] = self._blocks(run.drive.dt, with_settings(self.spec, lanes, run.settings))

        def work(run: Rows, target: Array, weight: Array) -> Array:
            return self._score(run, target, weight, blocks[_make(run)], lanes.shape[0])

        if jobs == 1:
            return np.array(list(map(work, runs, measured, weights)))
        with ThreadPoolExecutor(jobs) as pool:
            return np.array(list(pool.map(work, runs, measured, weights)))

    def _score(self, run: Rows, measured: Array, weight: Array, blocks: Sequence[Block], count: int) -> Array:
        out = np.empty(count)
        for block in blocks:
            workspace = block.fresh_workspace()
            self.native.score(*_arguments(run, block, workspace), measured, weight)
            out[block.place] = workspace[WIDTH * score_row(self.program) :][: block.count]
        return out

    def _blocks(self, dt: float, lanes: Array) -> list[Block]:
        return [self._block(dt, first, lanes[first : first + WIDTH]) for first in range(0, lanes.shape[0], WIDTH)]

    def _block(self, dt: float, first: int, lanes: Array) -> Block:
        wide = padded(lanes)
        curves = {look.curve: self.curves[look.curve] for look in self.program.lookups}
        workspace = self._fill(self.rows, dt, wide)
        return Block(first, lanes.shape[0], wide.shape[0], aligned_copy(self._tabulate(curves, wide)), workspace)


def _make(run: Rows) -> Hashable:
    return run.drive.dt, tuple(sorted(run.settings.items()))


def compile_network(spec: NetworkSpec) -> CompiledNetwork | CompiledSystem:
    """Trace, sort, print, compile; a network with nodes whose motion is unknown becomes a ``CompiledSystem``.

    Raises InputError for a network that cannot be compiled, such as one whose curve is still to come from data.
    """
    refuse_missing_numbers(spec)
    topology = topology_of(spec)
    if not topology.parallel:
        return compile_system(spec, topology)
    program = sort_tiers(trace_network(spec))
    return CompiledNetwork(spec, program, load_native(print_source(program)))


def _arguments(run: Rows, block: Block, workspace: Array) -> tuple[Any, ...]:
    return run.columns, run.index, run.local, run.turn_at, run.turn_columns, block.tables, workspace, block.width

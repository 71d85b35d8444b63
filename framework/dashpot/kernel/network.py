"""A compiled network: simulate and score whole blocks of lanes."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.data.excitation import Excitation
from dashpot.kernel.block import Block, blocks_of
from dashpot.kernel.columns import Constants, Rows, prepare_rows
from dashpot.kernel.compiled import Compiled
from dashpot.kernel.compiler.compile import program_of
from dashpot.kernel.compiler.trace import refuse_missing_numbers
from dashpot.kernel.following import channels_of
from dashpot.kernel.ir.layout import LANES, score_row, vectors_of
from dashpot.kernel.settings import used_settings, with_constants
from dashpot.kernel.system import CompiledSystem, compile_system
from dashpot.kernel.targets.choice import Code, backend, target
from dashpot.kernel.workers import spread
from dashpot.model.network import END, Characteristic, NetworkSpec
from dashpot.model.topology import topology_of

Array = NDArray[np.float64]

MAKES = 64  # constants of runs for which lanes are made ready at once

# vectors in a group, and whether it holds a single lane
Group = tuple[int, bool]
ALONE: Group = (1, True)


@dataclass(frozen=True)
class CompiledNetwork(Compiled[Rows]):
    """A compiled network all of whose elements see the motion of its driven end; see ``Compiled``."""

    @cached_property
    def curves(self) -> dict[str, Characteristic]:
        """Every curve of the network by path."""
        return self.spec.curves()

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """How lanes are put together: a single one, then more and more of them in powers of two."""
        widest = vectors_of(self.program)
        return ALONE, *((2**power, False) for power in range(widest.bit_length()))

    def native(self, vectors: int, alone: bool = False) -> Code:
        """The compiled code for groups of so many vectors of lanes, or for a single lane."""
        group = backend(), vectors, alone
        if group not in self._natives:
            self._natives[group] = target().network(self.program, vectors, alone)
        return self._natives[group]

    @cached_property
    def _natives(self) -> dict[tuple[str, int, bool], Code]:
        return {}

    @cached_property
    def prepared_by(self) -> Hashable:
        """All of the network that ``prepare`` depends on: where it is equal, what is prepared of a run is the same."""
        looked_up = tuple((look.curve, self.curves[look.curve].at) for look in self.program.lookups)
        told = tuple(
            (slot.value.setting, over and (over.word, over.way, over.channel))
            for _, slot in self.spec.told_by_runs
            for over in (slot.value.over,)
        )
        return self.program, looked_up, told

    def prepare(self, motion: Drive | Excitation) -> Rows:
        """The part of the work that depends on the drive alone."""
        if isinstance(motion, Drive):
            alone = channels_of(self.spec, Excitation.of_drive(motion))
            return prepare_rows(self.program, self.curves, motion, {}, alone)
        settings, channels = used_settings(self.spec, motion.settings, motion.name), channels_of(self.spec, motion)
        return prepare_rows(self.program, self.curves, motion.at((END,), ()).motions[END], settings, channels)

    def simulate(self, run: Rows, values: Array | None = None, out: Array | None = None) -> Array:
        """The force of the specimen (lanes, samples) in N, in ``out`` if given; one lane is answered as (samples,)."""
        lanes = np.atleast_2d(self.start if values is None else values)
        if out is None:
            out = np.empty((lanes.shape[0], run.drive.samples))
        code, width = self._group(lanes.shape[0])
        for block in self._ready(run, lanes, width):
            buffer = np.empty((run.drive.samples, width))
            code(*_arguments(run, block, block.fresh_workspace()), None, None, buffer, block.count)
            out[block.place] = buffer.T[: block.count]
        return out[0] if values is None or np.ndim(values) == 1 else out

    def score(
        self, runs: Sequence[Rows], measured: Sequence[Array], weights: Sequence[Array], values: Array, jobs: int = 1
    ) -> Array:
        """Weighted sums of squared errors (runs, lanes) against ``measured``, without storing any force.

        A lane whose force is not finite scores NaN.
        """
        lanes = np.atleast_2d(values)
        code, width = self._group(lanes.shape[0])

        def work(run: Rows, target: Array, weight: Array) -> Array:
            out = np.empty(lanes.shape[0])
            aims = [np.ascontiguousarray(aim, dtype=float) for aim in (target, weight)]
            for block in self._ready(run, lanes, width):
                workspace = block.fresh_workspace()
                code(*_arguments(run, block, workspace), *aims, None, block.count)
                out[block.place] = workspace[-1, : block.count]
            return out

        return np.array(spread(lambda each: work(*each), zip(runs, measured, weights, strict=True), jobs))

    def _group(self, count: int) -> tuple[Code, int]:
        alone, *wider = self.groups
        if count == 1:
            return self.native(*alone), alone[0] * LANES
        vectors, _ = next((group for group in wider if group[0] * LANES >= count), wider[-1])
        return self.native(vectors), vectors * LANES

    def _ready(self, run: Rows, lanes: Array, width: int) -> list[Block]:
        """Lanes (lanes, slots) as they are in a run, in blocks of ``width``.

        A fit asks for the same lanes run by run, and it takes hardly longer to make them ready for many: that is done
        for the constants of all runs that were asked for before.
        """
        asked = width, lanes.tobytes()
        found = self._last.get(asked, {})
        if run.constants not in found:
            makes = [run.constants, *(one for one in [*self._seen] if one not in found and one != run.constants)]
            fresh = zip(makes, self._fresh_blocks(makes, lanes, width), strict=True)
            found = dict([*list(found.items())[-MAKES:], *fresh])
            self._keep_last(asked, found)
            if len(self._seen) < MAKES:
                self._seen[run.constants] = None
        return found[run.constants]

    def expect(self, runs: Iterable[Rows]) -> None:
        """Make lanes ready for the constants of these runs, too, when one of them is simulated."""
        self._seen.update(dict.fromkeys(islice((run.constants for run in runs), MAKES)))

    @cached_property
    def _seen(self) -> dict[Constants, None]:
        return {}

    def _fresh_blocks(self, makes: Sequence[Constants], lanes: Array, width: int) -> list[list[Block]]:
        each = np.concatenate([with_constants(self.spec, lanes, dict(settings)) for _, settings in makes])
        steps = np.repeat([dt for dt, _ in makes], len(lanes))
        curves = {look.curve: self.curves[look.curve] for look in self.program.lookups}
        tables, workspace = self._tabulate(curves, each), self._fill(1 + score_row(self.program), steps, each)
        own = (slice(first, first + len(lanes)) for first in range(0, len(each), len(lanes)))
        return [list(blocks_of(tables[..., at], workspace[:, at], width)) for at in own]


def compile_network(spec: NetworkSpec) -> CompiledNetwork | CompiledSystem:
    """Trace, sort, print, compile; a network with nodes whose motion is unknown becomes a ``CompiledSystem``.

    Raises InputError for a network that cannot be compiled, such as one whose curve is still to come from data.
    """
    refuse_missing_numbers(spec)
    topology = topology_of(spec)
    if not topology.parallel:
        return compile_system(spec, topology)
    return CompiledNetwork(spec, program_of(spec))


def _arguments(run: Rows, block: Block, workspace: Array) -> tuple[Any, ...]:
    return (
        run.columns,
        run.index,
        run.local,
        run.drive.samples,
        run.turn_at,
        run.turn_columns,
        block.tables,
        workspace,
    )

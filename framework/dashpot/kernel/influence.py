"""What small forces between two nodes do to the forces at the driven nodes.

For small forces the change is linear in them. Each lane is pushed by a force of its own, between all pairs of nodes at
once, and compared with the lane that nothing pushes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.excitation import Excitation
from dashpot.expr.node import symbol
from dashpot.kernel.compiler.mechanics import driven_symbol
from dashpot.kernel.pieces import SystemRows
from dashpot.kernel.system import WIDTH, CompiledSystem, compile_system
from dashpot.model.element import Element, Parameter, Response
from dashpot.model.network import Branch, Ends, NetworkSpec, Value
from dashpot.model.topology import topology_of

Array = NDArray[np.float64]
Pair = tuple[str, str]

SMALL = 1e-3  # of the span of the force at the driven nodes: a change as large as this is taken to be linear
FIRST = "push:0"


@dataclass(frozen=True, eq=False)
class Influence:
    """A network with numbers, pushed between ``pairs`` of nodes, the lower one first."""

    network: NetworkSpec
    pairs: tuple[Pair, ...]

    @cached_property
    def system(self) -> CompiledSystem:
        """The network with a force between each pair that is given lane by lane."""
        pushed = _with_pushes(self.network, self.pairs)
        signals = [_signal(number, lane) for number in range(len(self.pairs)) for lane in range(WIDTH)]
        return compile_system(pushed, topology_of(pushed), signals=signals)

    def changes(self, excitation: Excitation, forces: Mapping[Pair, Array]) -> Array:
        """Changes (m, driven nodes, n) of the forces at the driven nodes, one for each of m small forces.

        Some pairs have ``forces`` (m, n) in N, which press the two nodes apart; the m-th ones of all pairs act at once.
        A change that cannot be computed is NaN.
        """
        rows = self.system.prepare(excitation)
        base = self.system.forces(rows)[0]
        peaks = np.max([np.max(np.abs(each), axis=1) for each in forces.values()], axis=0)
        scale = SMALL * np.ptp(base) / np.where(peaks > 0.0, peaks, np.inf)
        found = np.zeros((len(peaks), *base.shape))
        for block in _blocks(np.flatnonzero(scale)):
            pushes = {pair: each[block] * scale[block, None] for pair, each in forces.items()}
            found[block] = (self._pushed(rows, pushes) - base) / scale[block, None, None]
        return found

    def _pushed(self, rows: SystemRows, pushes: Mapping[Pair, Array]) -> Array:
        # pushes (lanes, n) of each pair, each in the lane of its number
        signals = {
            _signal(self.pairs.index(pair), lane): push
            for pair, each in pushes.items()
            for lane, push in enumerate(each)
        }
        lanes = np.repeat(self.system.start[None], len(next(iter(pushes.values()))), axis=0)
        for lane, values in enumerate(lanes):
            values[self.system.paths.index(f"{FIRST}.{_share(lane)}")] = 1.0
        return self.system.forces(self.system.with_signals(rows, signals), lanes)


def _blocks(columns: NDArray[np.intp]) -> Iterator[NDArray[np.intp]]:
    for first in range(0, columns.size, WIDTH):
        yield columns[first : first + WIDTH]


def _with_pushes(network: NetworkSpec, pairs: Sequence[Pair]) -> NetworkSpec:
    shares = {_share(lane): Value(0.0, "1") for lane in range(WIDTH)}
    pushes = [
        Branch(f"push:{number}", _push(number), shares, {}, shares=FIRST if number else "")
        for number in range(len(pairs))
    ]
    ends = {push.name: Ends(*pair) for push, pair in zip(pushes, pairs, strict=True)}
    root = replace(network.root, members=(*network.root.members, *pushes))
    return replace(network, root=root, ends={**network.ends, **ends})


def _signal(number: int, lane: int) -> str:
    return f"push:{number}:{lane}"


def _share(lane: int) -> str:
    return f"share_{lane}"


@lru_cache
def _push(number: int) -> type[Element]:
    """The law of a force that is given, a share of the signal of each lane."""

    def step(self: Element, x: Any, z: Any, p: Any, dt: Any) -> Response:
        signals = (symbol(driven_symbol(_signal(number, lane), "load")) for lane in range(WIDTH))
        return Response(sum(getattr(p, _share(lane)) * signal for lane, signal in enumerate(signals)))

    shares = {_share(lane): Parameter("1", "share of the signal") for lane in range(WIDTH)}
    return type("Push", (Element,), {"__doc__": _push.__doc__, "step": step, **shares})

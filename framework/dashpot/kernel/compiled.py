"""What every compiled network is: constant, with the slots of its file, run in blocks of lanes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.data.excitation import Excitation
from dashpot.kernel.block import Block
from dashpot.kernel.compiler.compile import recipe_of
from dashpot.kernel.curves import cubic_coefficients
from dashpot.kernel.following import moved
from dashpot.kernel.ir.program import Program
from dashpot.kernel.observe import PLAIN, Observation, read_observation
from dashpot.kernel.settings import with_channel
from dashpot.model.network import Characteristic, NetworkSpec

Array = NDArray[np.float64]
Prepared = TypeVar("Prepared")
LAST = 4  # sets of lanes that stay ready for the next run


@dataclass(frozen=True)
class Compiled(ABC, Generic[Prepared]):
    """A network that is constant: one per topology and number of knots, never per parameter value.

    ``values`` are blocks of lanes, (lanes, slots) in SI, in the order of ``spec.slots()``.
    """

    spec: NetworkSpec
    program: Program

    @cached_property
    def paths(self) -> tuple[str, ...]:
        """The paths of the slots."""
        return tuple(slot.path for slot in self.spec.slots())

    @cached_property
    def start(self) -> Array:
        """The values of the file as a single lane (slots,)."""
        return np.array([slot.value.number for slot in self.spec.slots()])

    @abstractmethod
    def prepare(self, motion: Drive | Excitation) -> Prepared:
        """The part of the work that depends on the motion alone."""

    @abstractmethod
    def simulate(self, run: Prepared, values: Array | None = None) -> Array:
        """The force (lanes, samples) in N along what is prepared; one lane is answered as (samples,)."""

    def along(self, motion: Drive | Excitation) -> Callable[..., Array]:
        """What simulates ``values`` along a motion; this is prepared once."""
        return partial(self.simulate, self.prepare(motion))

    def observation(self, values: Array, excitation: Excitation | None = None) -> Observation:
        """How the load cells see each lane in a run; gain and offset may follow channels of it, sample by sample."""
        if not self.spec.measurement:
            return PLAIN
        lanes = np.atleast_2d(values)
        if excitation is None:
            return read_observation(self.paths, lanes)
        seen = read_observation(self.paths, with_channel(self.spec, lanes, excitation.settings))
        return replace(seen, **dict(self._moving_channel(lanes, excitation))) if excitation.channels else seen

    def _moving_channel(self, lanes: Array, excitation: Excitation) -> Iterator[tuple[str, Array]]:
        # gain and offset (lanes, n) of the force channel where they follow one that was measured beside it
        for number, slot in enumerate(self.spec.slots()):
            over, (force, _, key) = slot.value.over, slot.path.rpartition(".")
            if over and over.channel and over.word in excitation.channels and force == "measurement.force":
                inner = lanes[:, number + 1 : number + 1 + len(over.numbers)].T[:, :, None]
                signal = excitation.channels[over.word]
                yield key, moved(over, lanes[:, number, None], list(inner), signal, slot.value.sensible)

    @cached_property
    def _last(self) -> dict[Hashable, dict[Hashable, list[Block]]]:
        return {}

    def _keep_last(self, asked: Hashable, ready: dict[Hashable, list[Block]]) -> None:
        # lanes for the next run, which may be in another thread
        for oldest in list(self._last)[: -LAST + 1]:
            self._last.pop(oldest, None)
        self._last[asked] = ready

    def _fill(self, rows: int, dt: float | Array, lanes: Array) -> Array:
        # a workspace (rows, lanes) with the constants of the lanes in its first rows; dt may be of each lane
        space = np.zeros((rows, lanes.shape[0]))
        known = {"dt": dt, "gravity": self.spec.gravity, **dict(zip(self.paths, lanes.T, strict=True))}
        for row, number in zip(space, recipe_of(self.program)(known), strict=False):
            row[:] = number
        return space

    def _tabulate(self, curves: Mapping[str, Characteristic], lanes: Array) -> Array:
        # coefficients (segments, 4, lanes) of one curve after the other
        parts = [np.empty((0, 4, lanes.shape[0]))]
        for path, curve in curves.items():
            numbers = [number for number, slot in enumerate(self.paths) if slot.startswith(f"{path}[")]
            parts.append(cubic_coefficients(curve, lanes[:, numbers].T))
        return np.concatenate(parts)

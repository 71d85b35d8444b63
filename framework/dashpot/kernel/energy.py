"""The balance of energy over a run: work put in = stored + dissipated, branch by branch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive
from dashpot.data.excitation import Excitation
from dashpot.kernel.compiler.mechanics import row_of
from dashpot.kernel.compiler.meter import BEGIN, STORED, WORK, EnergyMeter, edge_row
from dashpot.kernel.solution import Status, status_of
from dashpot.kernel.system import CompiledSystem, compile_system
from dashpot.model.network import NetworkSpec
from dashpot.model.topology import topology_of

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Share:
    """A branch or a node with a mass over a run, in J: the work done on it, and how much more it stores at the end.

    ``error`` is the estimated error of the work, from halving the steps. ``stored`` is None where the element does not
    say what it stores.
    """

    name: str
    word: str
    work: float
    stored: float | None
    error: float

    @property
    def dissipated(self) -> float | None:
        """The work that is not stored."""
        return None if self.stored is None else self.work - self.stored


@dataclass(frozen=True)
class EnergyBalance:
    """A run in J: the work that the drives put in and where it is at the end.

    The run begins at rest in equilibrium. ``error`` is the estimated error of ``put_in``.
    """

    run: str
    put_in: float
    error: float
    branches: tuple[Share, ...]
    masses: tuple[Share, ...]

    @property
    def stored(self) -> float | None:
        """What all branches and masses store more at the end than at the begin."""
        return _sum([share.stored for share in (*self.branches, *self.masses)])

    @property
    def dissipated(self) -> float | None:
        """What all branches lose."""
        return _sum([share.dissipated for share in self.branches])

    @property
    def missing(self) -> float:
        """The work put in that was done on no branch and no mass: what the time steps take away, and impacts at rigid
        stops; the work of an impulse that a driven node gives is not in ``put_in``.
        """
        return self.put_in - sum(share.work for share in (*self.branches, *self.masses))


@dataclass(frozen=True)
class EnergyCounter:
    """A network compiled with meters of its energy, for any number of runs."""

    system: CompiledSystem

    @classmethod
    def of(cls, spec: NetworkSpec) -> EnergyCounter:
        """Compile a network of any kind. Raises InputError for one that cannot be compiled."""
        topology = topology_of(spec)
        return cls(compile_system(spec, topology, EnergyMeter(topology)))

    def balance(self, motion: Drive | Excitation, values: Array | None = None, pairs: int = 1) -> EnergyBalance:
        """The energies of a run for one lane of ``values`` (slots,), by default the parameters of the network.

        ``pairs`` of steps lie in a sample. ArithmeticError with the reason for a run that cannot be simulated.
        """
        run = self.system.prepare(motion, pairs)
        rows, codes = self.system.last_rows(run, values)
        found = {name: _Refined(*(float(number) for number in both[:, 0])) for name, both in rows.items()}
        name = run.excitation.name
        topology = self.system.topology
        inputs = [found[row_of(joint, WORK)] for joint in topology.held("driven", "loaded")]
        status = status_of(int(codes[0]), np.array([work.value for work in inputs]))
        if status is not Status.GOOD:
            raise ArithmeticError(f"run '{name}': {status.value}")
        branches = tuple(
            _branch(
                edge.branch.name,
                edge.branch.element.word,
                found[edge_row(edge, WORK)],
                found.get(edge_row(edge, STORED)),
                found.get(edge_row(edge, BEGIN)),
            )
            for edge in topology.edges
        )
        masses = tuple(
            _mass(joint, "fixture" if joint in topology.mounts else "mass", found)
            for joint in topology.joints
            if row_of(joint, STORED) in found
        )
        return EnergyBalance(
            name, sum(work.value for work in inputs), sum(work.error for work in inputs), branches, masses
        )


def energy_balance(spec: NetworkSpec, motion: Drive | Excitation) -> EnergyBalance:
    """The energies of a network over a run. Raises as ``EnergyCounter`` does.

    Examples:
        >>> from dashpot.data.excitation import Excitation
        >>> run = dp.load_dataset("mount").run("a1_p2_up")
        >>> balance = dp.energy_balance(dp.load("mount.yaml"), Excitation.of_run(run))
        >>> [share.name for share in balance.branches]
        ['rubber', 'damping']
    """
    return EnergyCounter.of(spec).balance(motion)


@dataclass(frozen=True)
class _Refined:
    """A number after long and after short steps."""

    long: float
    short: float

    @property
    def value(self) -> float:
        """Without its leading error."""
        return self.short + (self.short - self.long) / 3.0

    @property
    def error(self) -> float:
        """The estimated error of the short steps."""
        return abs(self.short - self.long) / 3.0


def _branch(name: str, word: str, work: _Refined, stored: _Refined | None, begin: _Refined | None) -> Share:
    if stored is None:
        return Share(name, word, work.value, None, work.error)
    return Share(name, word, work.value, stored.value - (begin.value if begin else 0.0), work.error)


def _mass(joint: str, word: str, found: Mapping[str, _Refined]) -> Share:
    gained = found[row_of(joint, STORED)].value - found[row_of(joint, BEGIN)].value
    return Share(joint or word, word, gained, gained, found[row_of(joint, STORED)].error)


def _sum(numbers: Sequence[float | None]) -> float | None:
    return None if None in numbers else float(sum(number for number in numbers if number is not None))

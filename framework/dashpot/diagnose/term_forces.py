"""What each term of a model adds to the force: the force of the network less that of the network without it.

Of branches in parallel those that both networks have cancel, so that only the others are simulated. What they add goes
through the force channel with the rest of the force, as the channel may be limited.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.term import Model, without_term
from dashpot.fit.objective import Objective
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.model.network import Branch, Group, NetworkSpec
from dashpot.model.topology import topology_of

Array = NDArray[np.float64]


def term_forces(refitter: Refitter, model: Model) -> list[dict[str, Array]]:
    """For each term what it adds to the force (n,) by run in N, all other numbers as they are."""
    whole = _Whole(refitter, model.fitted)
    return [whole.less(_without(refitter, model, number)) for number in range(len(model.terms))]


def _without(refitter: Refitter, model: Model, number: int) -> NetworkSpec:
    if (rest := without_term(model, number)) is not None:
        return rest
    return refitter.without(model, [other for k, other in enumerate(model.terms) if k != number])


@dataclass(frozen=True, eq=False)
class _Whole:
    """A network on the runs of a refitter; its forces are simulated when they are asked for."""

    refitter: Refitter
    network: NetworkSpec

    def less(self, rest: NetworkSpec) -> dict[str, Array]:
        """By how much its force (n,) by run is larger than that of another network."""
        if not (_is_sum(self.network) and _is_sum(rest)):
            other = self.refitter.forces(rest)
            return {run: force - other[run] for run, force in self._shown.items()}
        mine, theirs = self.network.root.members, rest.root.members
        own = self._specimen([one for one in mine if one not in theirs])
        lost = self._specimen([one for one in theirs if one not in mine])
        runs, channel = self.refitter.runs, _compiled(replace(rest, root=Group("", "parallel", ())))
        return {run.name: self._more(number, own[number] - lost[number], channel) for number, run in enumerate(runs)}

    def _more(self, number: int, change: Array, channel: CompiledNetwork) -> Array:
        """What the channel shows of a run less what another ``channel`` shows of the force without ``change`` (n,)."""
        run = self.refitter.runs[number]
        other = channel.observation(channel.start, run.excitation)
        if other.plain and not self.network.measurement:
            return run.seen(change)
        return self._shown[run.name] - run.seen(other.see((self._force[number] - change)[None], run.drive.dt))[0]

    @cached_property
    def _shown(self) -> dict[str, Array]:
        return self.refitter.forces(self.network)

    @cached_property
    def _force(self) -> list[Array]:
        return self._specimen(self.network.root.members)

    def _specimen(self, members: Sequence[Branch | Group]) -> list[Array]:
        """The force (n,) of parallel branches in each run, as it is before the channel."""
        runs = self.refitter.runs
        if not members:
            return [np.zeros(run.drive.samples) for run in runs]
        network = _compiled(NetworkSpec(self.network.name, Group("", "parallel", tuple(members))))
        rows_of = partial(Objective(network, runs, shelf=self.refitter.shelf).rows_of, network)
        return [network.simulate(rows_of(number), network.start) for number in range(len(runs))]


def _is_sum(network: NetworkSpec) -> bool:
    """Whether the force is the sum over branches each of which has its numbers itself."""
    own = not any(one.shares for one in network.leaves()) and not any(slot.value.expression for slot in network.slots())
    return own and network.root.kind == "parallel" and topology_of(network).parallel


def _compiled(parallel: NetworkSpec) -> CompiledNetwork:
    found = compile_network(parallel)
    assert isinstance(found, CompiledNetwork)
    return found

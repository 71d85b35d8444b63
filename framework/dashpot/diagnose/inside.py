"""The inside of a fitted network with nodes: how its sites move, and what is measured of a small force there."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Suspect
from dashpot.data.drive import drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.data.interpolating import QUINTIC, interpolated_rates
from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.view import ModelView
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.influence import Influence
from dashpot.kernel.network import compile_network
from dashpot.kernel.system import CompiledSystem
from dashpot.kernel.workers import streamed
from dashpot.model.element import Element
from dashpot.model.network import Group, NetworkSpec
from dashpot.model.sites import Pair, Site, sites_of
from dashpot.text.problem import InputError, Place

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SiteView(ModelView):
    """A site as suspected causes may look at it: its runs are those of the network, once for each pair of its nodes."""

    members: NetworkSpec | None = None

    def force(self, run: str) -> Array:
        """The force (n,) in N of what lies at the site already."""
        return self._carried[run]

    def moved(self, run: str, change: Array) -> Array:
        """Not known inside a network: raises InputError."""
        raise InputError.at(
            Place(),
            "how the network would answer another deflection is known at the rig only",
            "declare such a suspect as 'measured'",
        )

    @cached_property
    def _carried(self) -> dict[str, Array]:
        assert self.members is not None
        objective = Objective(compile_network(self.members), list(self.scored.values()))
        forces = objective.forces(objective.network.start)
        return {run: force[0] for run, force in zip(self.scored, forces, strict=True)}


@dataclass(frozen=True, eq=False)
class Inside:
    """A fitted network with nodes on scored runs."""

    network: NetworkSpec
    runs: Sequence[ScoredRun]
    elements: Mapping[str, type[Element]]

    @cached_property
    def sites(self) -> tuple[Site, ...]:
        """Where an element could be added."""
        return sites_of(self.network)

    @cached_property
    def records(self) -> dict[str, list[ScoredRun]]:
        """The forces that were measured together."""
        found: dict[str, list[ScoredRun]] = {}
        for run in self.runs:
            found.setdefault(run.record or run.name, []).append(run)
        return found

    def members(self, site: Site) -> NetworkSpec:
        """The network without what lies elsewhere."""
        return replace(self.network, root=replace(self.network.root, members=site.members))

    def view(self, site: Site) -> SiteView:
        """A site as causes see it."""
        if site not in self._views:
            runs = [self._at(site, pair, record) for record in self.records for pair in site.pairs]
            members = NetworkSpec(site.words, Group("", "parallel", site.members))
            self._views[site] = SiteView({run.name: run for run in runs}, {}, self.elements, members=members)
        return self._views[site]

    def bank(
        self, candidates: Sequence[Candidate], jobs: int = 1, watch: Callable[[float], None] = lambda done: None
    ) -> dict[str, tuple[NDArray[np.intp], Array]]:
        """The changes of the measured forces (k, samples) by the candidates that have a site, and their columns (k,).

        By run, warm-up cut off.
        """
        inner = [candidate for site in self.sites for candidate in candidates if candidate.site == site]
        changes: dict[str, tuple[NDArray[np.intp], Array]] = {}
        answers = partial(self._answers, inner)
        for number, found in enumerate(streamed(answers, self.records, jobs)):
            watch(number / len(self.records))
            for run, rows in found.items():
                alive = np.flatnonzero(rows.any(axis=1) & np.isfinite(rows).all(axis=1))
                # there are many columns, known to three digits: seven are kept
                changes[run] = _places(inner)[alive], rows[alive].astype(np.float32)
        return changes

    def _answers(self, inner: Sequence[Candidate], record: str) -> dict[str, Array]:
        at = {site: [one.suspect for one in inner if one.site == site] for site in self.sites}
        found = [self._changes(site, suspects, record) for site, suspects in at.items() if suspects]
        return {
            run.name: np.concatenate([np.empty((0, run.samples)), *(changes[run.name] for changes in found)])
            for run in self.records[record]
        }

    def _changes(self, site: Site, suspects: Sequence[Suspect], record: str) -> dict[str, Array]:
        view = self.view(site)
        forces = {
            pair: np.concatenate([np.atleast_2d(suspect.columns(view, _name(record, pair))) for suspect in suspects])
            for pair in site.pairs
        }
        runs = self.records[record]
        changes = self._influence.changes(runs[0].excitation, forces)
        observation = self._system.observation(self._system.start, runs[0].excitation)
        seen = {}
        for run in runs:
            end = self._system.number_of(run.end)
            base = self._solved[record][1][end]
            seen[run.name] = observation.linear(np.vstack([base, changes[:, end]]), run.drive.dt)[1:, run.first :]
        return seen

    def _at(self, site: Site, pair: Pair, record: str) -> ScoredRun:
        run, (motions, _) = self.records[record][0], self._solved[record]
        deflection = motions[pair[0]] - motions[pair[1]] + site.offset
        # a simulated motion has no sensor noise
        drive = drive_from_path(run.drive.dt, deflection, *interpolated_rates(run.drive.dt, deflection, QUINTIC))
        driven = Excitation.of_drive(drive)
        whole = replace(driven, settings=run.excitation.settings, channels=run.excitation.channels)
        return replace(run, name=_name(record, pair), drive=drive, end="", record="", whole=whole)

    @cached_property
    def _views(self) -> dict[Site, SiteView]:
        return {}

    @cached_property
    def _system(self) -> CompiledSystem:
        system = compile_network(self.network)
        assert isinstance(system, CompiledSystem)
        return system

    @cached_property
    def _influence(self) -> Influence:
        return Influence(self.network, tuple(pair for site in self.sites for pair in site.pairs))

    @cached_property
    def _solved(self) -> dict[str, tuple[dict[str, Array], Array]]:
        """Motions (n,) of all nodes and forces (driven nodes, n) of every record."""
        found = {}
        for record, (run, *_) in self.records.items():
            rows = self._system.prepare(run.excitation)
            solution = self._system.solve(rows)
            driven = {node: rows.excitation.motions[node].displacement for node in self._system.outputs}
            still = dict.fromkeys(self._system.topology.held("ground"), np.zeros(rows.excitation.samples))
            inner = dict(zip(solution.unknown, solution.motion[0], strict=True))
            found[record] = {**driven, **still, **inner}, solution.force[0]
        return found


def _name(record: str, pair: Pair) -> str:
    return f"{record} {pair[0]}-{pair[1]}"


def _places(candidates: Sequence[Candidate]) -> NDArray[np.intp]:
    return np.concatenate([np.arange(0), *(np.arange(one.columns.start, one.columns.stop) for one in candidates)])

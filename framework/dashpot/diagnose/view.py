"""The present model on all runs, as suspected causes may look at it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive, moved_drive
from dashpot.data.excitation import Excitation
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.fit.thinned import highest_frequency, largest_stroke
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.system import CompiledSystem
from dashpot.model.element import Element
from dashpot.model.network import Branch, Characteristic, Group, NetworkSpec, Over, Value
from dashpot.text.problem import InputError, Place, nearest

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ModelView:
    """A fitted network on scored runs; see ``contract.cause.View`` for what the members mean."""

    scored: Mapping[str, ScoredRun]
    forces: Mapping[str, Array]
    elements: Mapping[str, type[Element]]
    network: NetworkSpec | None = None

    @property
    def runs(self) -> tuple[str, ...]:
        """Names of the runs."""
        return tuple(self.scored)

    @cached_property
    def reach(self) -> tuple[float, float]:
        """Smallest and largest deflection in m."""
        paths = [run.drive.displacement for run in self.scored.values()]
        return float(min(x.min() for x in paths)), float(max(x.max() for x in paths))

    @cached_property
    def speed(self) -> float:
        """Largest speed in m/s."""
        return float(max(np.abs(run.drive.velocity).max() for run in self.scored.values()))

    @cached_property
    def stroke(self) -> float:
        """The largest stroke of a single dynamic run in m, of any run if there is no dynamic one."""
        return largest_stroke(self.scored.values())

    @cached_property
    def highest_frequency(self) -> float:
        """The highest frequency in Hz that was driven, in any run."""
        return highest_frequency(self.scored.values())

    @cached_property
    def duration(self) -> float:
        """Median length of a run in s."""
        return float(np.median([run.drive.dt * run.drive.samples for run in self.scored.values()]))

    @cached_property
    def dt(self) -> float:
        """Smallest sample time in s."""
        return min(run.drive.dt for run in self.scored.values())

    def displacement(self, run: str) -> Array:
        """The deflection (n,) in m."""
        return self.scored[run].drive.displacement

    def velocity(self, run: str) -> Array:
        """The velocity (n,) in m/s."""
        return self.scored[run].drive.velocity

    def force(self, run: str) -> Array:
        """The force of the present model (n,) in N."""
        return self.forces[run]

    def step(self, run: str) -> float:
        """The sample time in s."""
        return self.scored[run].drive.dt

    def settings(self, run: str) -> Mapping[str, float]:
        """What was set at a run, and the means of its further channels, SI."""
        return self.scored[run].excitation.settings

    def channels(self, run: str) -> Mapping[str, Array]:
        """What was measured (n,) beside motion and force, in SI by name."""
        return self.scored[run].excitation.channels

    def unit_of(self, setting: str) -> str:
        """The unit in which the runs tell a setting; nothing for a bare number."""
        known = (run.excitation.units for run in self.scored.values())
        return next((units[setting] for units in known if setting in units), "")

    def moved(self, run: str, change: Array) -> Array:
        """The force (n,) of the model along a changed deflection. ValueError for a view without its network."""
        scored = self.scored[run]
        moved = replace(scored, drive=moved_drive(scored.drive, change))
        return Objective(self._compiled, [moved]).forces(self._compiled.start)[0][0]

    @cached_property
    def _compiled(self) -> CompiledNetwork | CompiledSystem:
        if self.network is None:
            raise ValueError("expected a view that knows its network, got one made of forces alone")
        return compile_network(self.network)

    def respond(self, run: str, element: str, values: Sequence[Mapping[str, float | Array]]) -> Array:
        """The forces (m, n) of an element with each of m sets of values; what a set leaves out has its default.

        A value may be another one (n,) at every sample. Raises InputError for an element that no plugin provides and
        for a value that is missing and has no default.
        """
        if element not in self.elements:
            raise InputError.at(Place(), f"there is no element '{element}'", nearest(element, self.elements))
        law = self.elements[element]
        keys = tuple(dict.fromkeys(key for entry in values for key in entry))
        complete = [_with_defaults(law, keys, entry) for entry in values]
        drive = self.scored[run].drive
        moving = frozenset(key for entry in complete for key, value in entry.items() if np.ndim(value))
        if moving:
            return np.array([_along(_probe(law, keys, moving), drive, entry, moving) for entry in complete])
        probe = _probe(law, keys)
        lanes = np.array([[entry[path.partition(".")[2]] for path in probe.paths] for entry in complete])
        return np.atleast_2d(probe.simulate(probe.prepare(drive), lanes))


def view_of(
    network: NetworkSpec, runs: Sequence[ScoredRun], elements: Mapping[str, type[Element]], jobs: int = 1
) -> ModelView:
    """A fitted network on runs as causes see it."""
    objective = Objective(compile_network(network), runs, jobs)
    forces = objective.forces(objective.network.start)
    seen = {run.name: force[0] for run, force in zip(runs, forces, strict=True)}
    return ModelView({run.name: run for run in runs}, seen, elements, network)


def _along(probe: CompiledNetwork, drive: Drive, entry: Mapping[str, float | Array], moving: frozenset[str]) -> Array:
    """The force (n,) of a probe some of whose values move along the run."""
    signals = {key: np.broadcast_to(entry[key], (drive.samples,)).astype(float) for key in moving}
    rows = probe.prepare(replace(Excitation.of_drive(drive), channels=signals))
    own_of = zip(probe.paths, probe.start, strict=True)
    numbers = {f"probe.{key}": value for key, value in entry.items() if key not in moving}
    return probe.simulate(rows, np.array([numbers.get(path, own) for path, own in own_of]))


def _with_defaults(
    law: type[Element], keys: Sequence[str], entry: Mapping[str, float | Array]
) -> dict[str, float | Array]:
    parameters = law.declares.parameters
    given = {key: entry.get(key, parameters[key].default if key in parameters else None) for key in keys}
    if missing := [key for key, value in given.items() if value is None]:
        raise InputError.at(Place(), f"'{missing[0]}' is missing in a set of values, and it has no default")
    return {key: value if np.ndim(value) else float(value) for key, value in given.items() if value is not None}


@lru_cache(maxsize=64)
def _probe(element: type[Element], keys: tuple[str, ...], moving: frozenset[str] = frozenset()) -> CompiledNetwork:
    """One branch of an element; each ``moving`` number is that of a channel of its name."""
    declared = element.declares

    def value(key: str, unit: str) -> Value:
        follows = Over(key, "slope", (0.0,), (Value(1.0, "1"),), channel=True)
        return Value(0.0, unit, over=follows) if key in moving else Value(1.0, unit)

    values = {key: value(key, declared.parameters[key].unit) for key in keys if key in declared.parameters}
    curves = {
        key: Characteristic(declared.curves[key], "constant", (value(key, declared.curves[key].slope_unit),))
        for key in keys
        if key in declared.curves
    }
    branch = Branch("probe", element, values, curves)
    probe = compile_network(NetworkSpec("probe", Group("", "parallel", (branch,))))
    assert isinstance(probe, CompiledNetwork)
    return probe

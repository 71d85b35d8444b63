"""Refitting extended networks: the finalists of the screen become real models and are judged as such."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.noise import NoiseModel
from dashpot.assess.screen import Finding
from dashpot.fit.coordinates import Coordinates, search_coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.refine import Outcome, refine
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element
from dashpot.model.network import NetworkSpec, Value
from dashpot.model.reading import parse_network

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Model:
    """A fitted network: its declaration without and with fitted numbers, and what it costs.

    ``chi_square`` is the sum of squared whitened misfits on the training runs.
    """

    declared: NetworkSpec
    fitted: NetworkSpec
    coordinates: Coordinates
    point: Array
    chi_square: float
    outcome: Outcome

    @property
    def values(self) -> Array:
        """All slots (slots,) in SI."""
        return self.coordinates.to_values(self.point)[0]


@dataclass(frozen=True, eq=False)
class Bench:
    """What every refit needs: the training runs, the elements, the noise."""

    runs: Sequence[ScoredRun]
    elements: Mapping[str, type[Element]]
    jobs: int = 1

    def fit(self, declared: NetworkSpec, start: NetworkSpec, noise: NoiseModel, steps: int = 25) -> Model:
        """Refit a network from the numbers of ``start``, against whitened misfits."""
        objective = Objective(compile_network(start), self.runs, self.jobs, noise.whiten)
        coordinates = search_coordinates(start)
        found = refine(objective, coordinates, coordinates.start, steps, tolerance=1e-6)
        fitted = renumber(start, coordinates, found.point)
        return Model(declared, fitted, coordinates, found.point, found.loss**2 * objective.total, found.outcome)

    def extend(self, model: Model, extend: Callable[[str], str], noise: NoiseModel) -> Model:
        """The model with a patch of its text, refitted from its own numbers and those of the patch."""
        declared = parse_network(extend(model.declared.document.text), self.elements)
        return self.fit(declared, inherit_numbers(declared, model.fitted), noise)


@dataclass(frozen=True, eq=False)
class Trial:
    """A finalist after its refit. ``merit`` is the fall of chi square less the price of its new parameters."""

    finding: Finding
    model: Model
    gain: float
    merit: float
    failure: str = ""


def try_finding(bench: Bench, base: Model, finding: Finding, noise: NoiseModel, samples: int) -> Trial:
    """Extend the base by a finding and refit both on equal terms."""
    suspect = finding.candidate.suspect
    model = bench.extend(base, lambda text: suspect.extend(text, finding.atoms), noise)
    gain = base.chi_square - model.chi_square
    price = (model.point.size - base.point.size) * np.log(samples)
    failure = "the refit did not come to a finite end" if not np.isfinite(model.chi_square) else ""
    return Trial(finding, model, gain, gain - price if not failure else -np.inf, failure)


def inherit_numbers(declared: NetworkSpec, fitted: NetworkSpec) -> NetworkSpec:
    """A network with the fitted numbers and curves of another one, wherever the two share a path."""
    curves = {f"{branch.name}.{key}": curve for branch in fitted.leaves()
              for key, curve in branch.characteristics().items()}  # fmt: skip
    for path in declared.data_curves():
        declared = declared.with_curve(path, curves[path])
    known = {slot.path: slot.value for slot in fitted.slots()}
    shared = {slot.path: with_number(slot.value, known[slot.path].number)
              for slot in declared.slots() if slot.path in known}  # fmt: skip
    return declared.with_values(shared)


def renumber(spec: NetworkSpec, coordinates: Coordinates, point: Array) -> NetworkSpec:
    """The network with the numbers of a point."""
    values = coordinates.to_values(point)[0]
    slots = {slot.path: slot.value for slot in spec.slots()}
    paths = [slot.path for slot in spec.slots()]
    return spec.with_values({path: with_number(slots[path], float(values[paths.index(path)]))
                             for path in coordinates.paths})  # fmt: skip


def with_number(value: Value, number: float) -> Value:
    """The value with another number."""
    return Value(number, value.unit, value.role, value.bounds, value.scale, value.interval, value.node)

"""Refitting extended networks: the finalists of the screen become real models and are judged as such."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.noise import NoiseModel
from dashpot.assess.screen import Finding
from dashpot.fit.coordinates import Coordinates, search_coordinates, with_point
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.refine import Outcome, refine
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import parse_network

Array = NDArray[np.float64]

STEPS = 20
TOLERANCE = 1e-5


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
    """What every refit needs; ``sensors`` is the data sheet of the force channel by run."""

    runs: Sequence[ScoredRun]
    elements: Mapping[str, type[Element]]
    sensors: Mapping[str, Mapping[str, float]]
    jobs: int = 1

    def fit(self, declared: NetworkSpec, start: NetworkSpec, noise: NoiseModel | None) -> Model:
        """Refit a network from the numbers of ``start``: to whitened misfits, or to the plain error without a noise."""
        objective = Objective(compile_network(start), self.runs, self.jobs, noise.whiten if noise else None)
        coordinates = search_coordinates(start)
        found = refine(objective, coordinates, coordinates.start, STEPS, TOLERANCE)
        fitted = with_point(start, coordinates, found.point)
        return Model(declared, fitted, coordinates, found.point, found.loss**2 * objective.total, found.outcome)

    def extend(self, model: Model, extend: Callable[[str], str], noise: NoiseModel) -> Model:
        """The model with a patch of its text, refitted from its own numbers and those of the patch."""
        declared = parse_network(extend(model.declared.text), self.elements, model.declared.file)
        return self.fit(declared, self.start_from(declared, model.fitted), noise)

    def start_from(self, declared: NetworkSpec, fitted: NetworkSpec) -> NetworkSpec:
        """A network ready to be fitted: shared numbers inherited, the others given a range."""
        return with_ranges(inherit_numbers(declared, fitted), natural_sizes(self.runs))


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
    curves = {
        f"{branch.name}.{key}": curve for branch in fitted.leaves() for key, curve in branch.characteristics().items()
    }
    for path in declared.data_curves():
        declared = declared.with_curve(path, curves[path])
    known = {slot.path: slot.value for slot in fitted.slots()}
    shared = {
        slot.path: replace(known[slot.path], node=slot.value.node) for slot in declared.slots() if slot.path in known
    }
    return declared.with_values(shared)

"""Simulating a sensitivity study, a block of parameter vectors at a time."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.metric import Metric
from dashpot.contract.rig import PlannedRun
from dashpot.data.excitation import Excitation
from dashpot.data.run import Run
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.system import CompiledSystem
from dashpot.kernel.within import FINEST, TOLERANCE, steps_within
from dashpot.model.derived import derived_of
from dashpot.study.sensitivity.declaration import Scatter, SensitivitySpec, Variation
from dashpot.text.problem import InputError, Place

Array = NDArray[np.float64]
Progress = Callable[[str, float], None]

BLOCK = 64  # lanes that are simulated at a time


@dataclass(frozen=True, eq=False)
class Changed:
    """A variation at its value number ``at``, with every metric (metrics, values of the variation over)."""

    variation: Variation
    at: int
    metrics: Array


@dataclass(frozen=True, eq=False)
class SensitivityResult:
    """What a sensitivity study found.

    ``plain`` (metrics, over), with nothing else changed; ``changed`` for each value of each other variation; ``drawn``
    (metrics, over, draws), without draws where nothing scatters. A metric that a specimen does not have is NaN.
    """

    study: SensitivitySpec
    plain: Array
    changed: tuple[Changed, ...]
    drawn: Array


def run_sensitivity(study: SensitivitySpec, progress: Progress | None = None) -> SensitivityResult:
    """Simulate every parameter vector of a study; the same seed gives the same numbers.

    ``progress`` hears of each block, with the share of those before it. Raises InputError for a network that cannot be
    simulated, and for a test that has none of the metrics, or one of them several times.
    """
    bench = _Bench(study)
    lanes, places = bench.lanes()
    found = np.empty((len(study.metrics), len(lanes)))
    for first in range(0, len(lanes), BLOCK):
        if progress:
            progress("simulating", first / len(lanes))
        block = slice(first, first + BLOCK)
        found[:, block] = bench.measure(lanes[block])
    count = len(study.over.values)
    table = found.reshape(len(study.metrics), -1, count)
    changed = [Changed(variation, at, table[:, 1 + number]) for number, (variation, at) in enumerate(places)]
    return SensitivityResult(study, table[:, 0], tuple(changed), table[:, 1 + len(places) :].transpose(0, 2, 1))


class _Bench:
    """The network of a study in its test."""

    def __init__(self, study: SensitivitySpec) -> None:
        self.study = study
        self.network = compile_network(study.network)
        slots = study.network.slots()
        self._place = {slot.path: number for number, slot in enumerate(slots)}
        self._derived = derived_of(slots)
        varied = [path for each in (study.over, *study.vary) for path in each.paths]
        varied += [path for each in study.scatter for path in each.paths]
        given = {slots[self._place[path]].value.setting for path in varied}
        self._tests = [_Test(self.network, planned, given) for planned in study.bench.runs()]
        self._measured_by = [self._only_test(metric) for metric in study.metrics]

    def lanes(self) -> tuple[Array, list[tuple[Variation, int]]]:
        """All lanes (lanes, slots), those of one row of the result together, and what each row after the first is."""
        study, start = self.study, np.array(self.network.start, dtype=float)
        places = [(variation, at) for variation in study.vary for at in range(len(variation.values))]
        drawn = self._drawn(start) if study.scatter else np.empty((0, start.size))
        rows = [start, *(self._set(start, variation, variation.values[at]) for variation, at in places), *drawn]
        lanes = np.array([self._set(row, study.over, value) for row in rows for value in study.over.values])
        return self._derived.fill(lanes), places

    def measure(self, lanes: Array) -> Array:
        """Every metric (metrics, lanes) of some lanes (lanes, slots)."""
        found = np.full((len(self.study.metrics), len(lanes)), np.nan)
        for test in self._tests:
            own = [number for number, other in enumerate(self._measured_by) if other is test]
            for lane, run in enumerate(test.runs(lanes)):
                for number in own:
                    value = self.study.metrics[number]().measure(run)
                    found[number, lane] = np.nan if value is None else value
        return found

    def _only_test(self, metric: type[Metric]) -> _Test:
        having = [test for test in self._tests if metric().measure(test.plain) is not None]
        if len(having) == 1:
            return having[0]
        names = [test.planned.name for test in having]
        told = f"several of its runs have it: {', '.join(names)}" if names else "none of its runs has it"
        raise InputError.at(
            Place(self.study.name),
            f"'{metric.word}' cannot be taken from '{self.study.bench.name}' with '{self.network.spec.name}': {told}",
            "choose another rig or other options of it",
        )

    def _set(self, lane: Array, variation: Variation, value: float) -> Array:
        changed, own = lane.copy(), [self._place[path] for path in variation.paths]
        changed[own] = lane[own] * value if variation.relative else value
        return changed

    def _drawn(self, start: Array) -> Array:
        rng = np.random.default_rng(self.study.seed)
        lanes = np.tile(start, (self.study.draws, 1))
        for scatter in self.study.scatter:
            own = [self._place[path] for path in scatter.paths]
            drawn = _draws(scatter, self.study.draws, rng)[:, None]
            lanes[:, own] = lanes[:, own] * drawn if scatter.between is None else drawn
        return lanes


class _Test:
    """One planned run on the network; settings that the study varies itself, ``given``, are not those of the run."""

    def __init__(self, network: CompiledNetwork | CompiledSystem, planned: PlannedRun, given: Collection[str]) -> None:
        self.network, self.planned = network, planned
        own = {key: value for key, value in planned.settings.items() if key not in given}
        self._excitation = replace(planned.excitation(), settings=own)
        self._rows = _prepared(network, self._excitation)
        [self.plain] = self.runs(np.array([network.start], dtype=float))

    def runs(self, lanes: Array) -> Iterator[Run]:
        """What is measured with each of the lanes (lanes, slots), at the first node that the rig drives.

        InputError where one cannot be simulated.
        """
        end, path = next(iter(self.planned.motion.items()))
        if isinstance(self.network, CompiledSystem):
            forces = self.network.simulate(self._rows, lanes, end or None)
        else:
            forces = self.network.simulate(self._rows, lanes)
        if not np.isfinite(forces).all():
            raise InputError.at(
                Place(self.network.spec.file),
                f"'{self.planned.name}' cannot be simulated with every parameter vector of the study",
                "narrow the values, the factors or the scatter",
            )
        for force in forces:
            channels = {"displacement": path.displacement, "force": force}
            yield Run(self.planned.name, self.planned.kind, self.planned.time, channels, self.planned.settings)


def _prepared(network: CompiledNetwork | CompiledSystem, excitation: Excitation) -> Any:
    if isinstance(network, CompiledNetwork):
        return network.prepare(excitation)
    return network.prepare(excitation, steps_within(network, excitation, network.start, TOLERANCE, FINEST))


def _draws(scatter: Scatter, count: int, rng: np.random.Generator) -> Array:
    if scatter.between is not None:
        return rng.uniform(*scatter.between, count)
    return rng.normal(1.0, scatter.deviation or 0.0, count)

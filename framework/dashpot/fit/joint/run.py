"""Identifying several specimens together: each alone, then all at once with the parameters that they share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dashpot.data.dataset import Dataset
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.api import (
    REFINEMENT_STEPS,
    Progress,
    Setting,
    fit_each,
    fitted_or_raised,
    measure_errors,
    prepare,
    silent,
)
from dashpot.fit.coordinates import Coordinates, search_coordinates
from dashpot.fit.derived_intervals import derived_intervals
from dashpot.fit.joint.declaration import JointSpec, Tie
from dashpot.fit.joint.objective import JointObjective, Member
from dashpot.fit.joint.tied import Common, common_coordinates
from dashpot.fit.kept_curves import Refinement, refinement
from dashpot.fit.known import known_numbers
from dashpot.fit.objective import Objective
from dashpot.fit.prior import WithPriors, priors_of
from dashpot.fit.refine import Outcome, refine
from dashpot.fit.result import FitResult, with_intervals
from dashpot.fit.uncertainty import Uncertainty, assess_uncertainty, effective_error
from dashpot.kernel.network import compile_network
from dashpot.kernel.workers import threads
from dashpot.model.network import NetworkSpec, Slot, Value
from dashpot.text.problem import InputError, Problem

if TYPE_CHECKING:
    from dashpot.kernel.workers import Jobs

Array = NDArray[np.float64]

METHOD = "joint Gauss-Newton"
BY_CHANCE = 0.05  # a difference that is as probable as that needs no other explanation


@dataclass(frozen=True)
class SharedNumber:
    """A number in common, in SI: its value and interval; ``alone`` holds value and interval of each specimen's own fit.

    ``apart`` is how often chance would make the specimens differ in it as much as they do (Cochran's Q), None where the
    data of fewer than two specimens determine it.
    """

    title: str
    unit: str
    value: float
    interval: tuple[float, float]
    alone: Mapping[str, tuple[float, tuple[float, float]]]
    apart: float | None


@dataclass(frozen=True, eq=False)
class JointResult:
    """The fits of all specimens together, by name, and ``alone`` those of each by itself."""

    spec: JointSpec
    fits: Mapping[str, FitResult]
    alone: Mapping[str, FitResult]
    shared: tuple[SharedNumber, ...]
    ending: str
    evaluations: int

    def as_dict(self) -> dict[str, Any]:
        """The result in plain values, SI."""
        return {
            "format": "dashpot-joint-result/1",
            "name": self.spec.name,
            "about": self.spec.about,
            "shared": [
                {
                    "number": each.title,
                    "unit": each.unit,
                    "value": each.value,
                    "interval": list(each.interval),
                    "alone": {
                        name: {"value": value, "interval": list(pair)} for name, (value, pair) in each.alone.items()
                    },
                    "probability": each.apart,
                }
                for each in self.shared
            ],
            "specimens": {
                name: {**fit.as_dict(), "rmse_alone": self.alone[name].as_dict()["rmse"]}
                for name, fit in self.fits.items()
            },
            "evaluations": self.evaluations,
            "ending": self.ending,
        }


def fit_joint(
    spec: JointSpec,
    datasets: Mapping[str, Dataset],
    *,
    jobs: Jobs = 1,
    progress: Progress | None = None,
) -> JointResult:
    """Identify the specimens of a joint file on their ``datasets``, by name. InputError for one that has no fit.

    On a pool or a cluster each specimen is fitted alone as a piece of work, and all together in this process.
    """
    return _fitted(spec, datasets, jobs, progress or silent)


@single_threaded_algebra
def _fitted(spec: JointSpec, datasets: Mapping[str, Dataset], pool: Jobs, progress: Progress) -> JointResult:
    jobs = threads(pool)
    settings = {name: prepare(dataset, spec.seed) for name, dataset in datasets.items()}
    networks = [_with_first_priors(each.network, each.name, spec.ties) for each in spec.specimens]
    found_alone = fit_each(networks, [settings[each.name] for each in spec.specimens], None, spec.seed, pool, progress)
    alone = {each.name: fitted_or_raised(fit) for each, fit in zip(spec.specimens, found_alone, strict=True)}
    progress("all together", 0.0, None, None)
    bodies = {name: _Body.of(fit.fitted, settings[name], jobs) for name, fit in alone.items()}
    whole = JointObjective([body.member for body in bodies.values()])
    own = {name: body.whole.coordinates for name, body in bodies.items()}
    common = common_coordinates(own, spec.ties, {name: _errors(alone[name], each) for name, each in own.items()})
    found = refine(whole, common.coordinates, common.coordinates.start, REFINEMENT_STEPS)
    if found.outcome is Outcome.FAILED:
        message = f"the specimens cannot be simulated with one value of {', '.join(tie.title for tie in spec.ties)}"
        raise InputError([Problem(spec.ties[0].place, message, "share fewer parameters, or check their units")])
    values = common.coordinates.to_values(found.point)[0]
    fitted = {
        name: body.whole.at(own[name].of_values(values[part]))
        for (name, body), part in zip(bodies.items(), whole.slices, strict=True)
    }
    return _judged(spec, fitted, settings, alone, bodies, found.outcome.value, found.evaluations, jobs)


def _with_first_priors(network: NetworkSpec, name: str, ties: tuple[Tie, ...]) -> NetworkSpec:
    """The network without the priors of shared numbers that stand in the network of another specimen, too."""
    later = {tie.paths[name] for tie in ties if name in tie.paths and next(iter(tie.paths)) != name}
    slots = {slot.path: slot.value for slot in network.slots()}
    return network.with_values({path: replace(slots[path], prior=None) for path in later if slots[path].prior})


@dataclass(frozen=True, eq=False)
class _Body:
    """A specimen that takes part in the joint fit."""

    whole: Refinement
    member: Member

    @classmethod
    def of(cls, fitted: NetworkSpec, setting: Setting, jobs: int) -> _Body:
        objective = Objective(compile_network(fitted), setting.train, jobs)
        whole = refinement(fitted, objective, lambda slot: True)
        error = effective_error(objective, whole.coordinates, whole.coordinates.start, setting.floor.value)
        priors = priors_of(whole.free)
        loss = whole.loss if priors is None else WithPriors(whole.loss, objective, priors, error)
        return cls(whole, Member(objective, loss, error))


def _errors(fit: FitResult, coordinates: Coordinates) -> Array:
    """The standard errors (p,) of a fit in natural steps; those of kept knots are as good as unknown."""
    assert fit.errors_of_numbers is not None
    known = dict(zip(fit.free, fit.errors_of_numbers.tolist(), strict=True))
    si = np.array([known.get(path, np.inf) for path in coordinates.paths])
    return si / (coordinates.slopes(coordinates.start) * coordinates.unit)


def _judged(
    spec: JointSpec,
    fitted: Mapping[str, NetworkSpec],
    settings: Mapping[str, Setting],
    alone: Mapping[str, FitResult],
    bodies: Mapping[str, _Body],
    ending: str,
    evaluations: int,
    jobs: int,
) -> JointResult:
    own = {name: search_coordinates(network) for name, network in fitted.items()}
    common = common_coordinates(own, spec.ties, {name: np.ones(len(each.paths)) for name, each in own.items()})
    objectives = {name: Objective(compile_network(fitted[name]), settings[name].train, jobs) for name in bodies}
    whole = JointObjective([Member(each, each, bodies[name].member.error) for name, each in objectives.items()])
    known = _uncertainty(whole, common, fitted)
    intervals = _intervals(common, known, fitted, whole)
    for tie in spec.ties:
        for name, path in tie.paths.items():
            value = _value(fitted[name], path)
            intervals[name][path] = _widened(value, intervals[name][path], tie, alone)
    fits = {
        name: replace(
            alone[name],
            fitted=with_intervals(network, intervals[name]),
            errors=measure_errors(network, settings[name], jobs),
            optimizer=METHOD,
            ending=ending,
            evaluations=alone[name].evaluations + evaluations,
            at_bound=tuple(path for path in own[name].paths if _title(path, name, spec.ties) in known.at_bound),
            correlation=None,
            errors_of_numbers=None,
            priors=(),
        )
        for name, network in fitted.items()
    }
    shared = tuple(_shared(tie, fits, alone) for tie in spec.ties)
    return JointResult(spec, fits, alone, shared, ending, evaluations)


def _title(path: str, name: str, ties: tuple[Tie, ...]) -> str:
    return next((tie.title for tie in ties if tie.paths.get(name) == path), f"{name}: {path}")


def _uncertainty(whole: JointObjective, common: Common, fitted: Mapping[str, NetworkSpec]) -> Uncertainty:
    """Intervals of all coordinates: with the priors of all specimens, and with what is known from elsewhere."""
    coordinates, size = common.coordinates, common.coordinates.base.size
    steps, rows = [], []
    for network, part in zip(fitted.values(), whole.slices, strict=True):
        for each in known_numbers(network):
            step = np.zeros(size)
            step[part] = each.step
            steps.append(step)
        priors = priors_of(network)
        if priors:
            rows.append(replace(priors, slots=priors.slots + part.start).rows(coordinates, coordinates.start))
    before = np.concatenate(rows) if rows else None
    return assess_uncertainty(whole, coordinates, coordinates.start, steps, None, before, 1.0 if rows else 0.0)


def _intervals(
    common: Common, known: Uncertainty, fitted: Mapping[str, NetworkSpec], whole: JointObjective
) -> dict[str, dict[str, tuple[float, float]]]:
    """The intervals of the numbers of each specimen by path, those that follow from others among them."""
    slots = [
        Slot(f"{name}: {slot.path}", slot.value, slot.of)
        for name, network in fitted.items()
        for slot in network.slots()
    ]
    derived = derived_intervals(slots, common.coordinates, known)
    found = {}
    for (name, network), part in zip(fitted.items(), whole.slices, strict=True):
        own = [slot.path for slot in slots[part]]
        found[name] = {path.partition(": ")[2]: derived[path] for path in own if path in derived}
        paths = search_coordinates(network).paths
        found[name] |= {path: known.intervals[k] for path, k in zip(paths, common.places[name], strict=True)}
    return found


def _shared(tie: Tie, fits: Mapping[str, FitResult], alone: Mapping[str, FitResult]) -> SharedNumber:
    from scipy.special import chdtrc

    name, path = next(iter(tie.paths.items()))
    value = _value(fits[name].fitted, path)
    assert value.interval is not None
    own = {other: _value(alone[other].fitted, where) for other, where in tie.paths.items()}
    statistic, freedom = _contradiction(tie, alone)
    return SharedNumber(
        tie.title,
        value.unit,
        value.number,
        value.interval,
        {other: (each.number, each.interval or (-np.inf, np.inf)) for other, each in own.items()},
        float(chdtrc(freedom, statistic)) if freedom else None,
    )


def _value(network: NetworkSpec, path: str) -> Value:
    return next(slot.value for slot in network.slots() if slot.path == path)


def _contradiction(tie: Tie, alone: Mapping[str, FitResult]) -> tuple[float, int]:
    """Cochran's Q of a shared number over the specimens whose data determine it, and its degrees of freedom."""
    at = np.array([_value(alone[name].fitted, path).number for name, path in tie.paths.items()])
    known = np.array(
        [
            dict(zip(alone[name].free, np.asarray(alone[name].errors_of_numbers), strict=True))[path]
            for name, path in tie.paths.items()
        ]
    )
    sure = np.isfinite(known) & (known > 0.0)
    if sure.sum() < 2:
        return 0.0, 0
    weight = known[sure] ** -2.0
    middle = weight @ at[sure] / weight.sum()
    return float(weight @ (at[sure] - middle) ** 2), int(sure.sum()) - 1


def _widened(
    value: Value, interval: tuple[float, float], tie: Tie, alone: Mapping[str, FitResult]
) -> tuple[float, float]:
    """The interval of a shared number times the Birge ratio, where specimens differ by more than chance explains.

    Source: Birge, Physical Review 40 (1932) 207.
    """
    from scipy.special import chdtri

    statistic, freedom = _contradiction(tie, alone)
    ratio = float(np.sqrt(statistic / freedom)) if freedom and statistic > chdtri(freedom, BY_CHANCE) else 1.0
    low, high = value.bounds or value.sensible
    ends = (value.number + ratio * (end - value.number) for end in interval)
    lower, upper = (float(np.clip(end, low, high)) for end in ends)
    return lower, upper

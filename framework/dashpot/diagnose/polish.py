"""The parameters of the final files: fitted to the plain error, with intervals, and read back as they are written."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.term import Model
from dashpot.fit.coordinates import Coordinates, with_point
from dashpot.fit.linear import linearise
from dashpot.fit.objective import Objective
from dashpot.fit.order import ordered
from dashpot.fit.refine import candidates, refine
from dashpot.fit.result import with_intervals
from dashpot.fit.scored import ScoredRun
from dashpot.fit.uncertainty import assess_uncertainty
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec

Array = NDArray[np.float64]

STEPS, FEWER_STEPS = 60, 10  # fewer from a structure that was refitted


def polished(model: Model, runs: Sequence[ScoredRun], jobs: int, steps: int = STEPS) -> NetworkSpec:
    """The network of a model with the numbers at which the plain error of the runs is smallest, all weighing alike."""
    objective = Objective(compile_network(model.fitted), runs, jobs)
    found = refine(objective, model.coordinates, model.coordinates.start, steps, thorough=False)
    return ordered(model.fitted, with_point(model.fitted, model.coordinates, found.point))


def left_out_error(
    network: NetworkSpec, coordinates: Coordinates, runs: Sequence[ScoredRun], groups: Mapping[str, str], jobs: int
) -> float | None:
    """The RMSE in N of a network on groups of runs left out in turn, its ``coordinates`` fitted to the others.

    None for a single group, and where nothing is fitted.

    A fit to the others is a step from that to all runs, along the products of their Jacobian, with the damping that
    gives the lowest error on them. What the others hardly tell, such as the force at a deflection that one run alone
    reaches, is not put to the test: all runs together count as much as one group.
    """
    names = list(dict.fromkeys(groups[run.name] for run in runs))
    if len(names) < 2 or not coordinates.paths:
        return None
    objective = Objective(compile_network(network), runs, jobs)
    point = coordinates.of_values(objective.network.start)
    linear = linearise(objective, coordinates, point)
    grams = np.zeros((len(names), *linear.gram.shape))
    for number, gram in linear.each(lambda number, rows: (number, rows @ rows.T)):
        grams[names.index(groups[runs[number].name])] += gram
    tries = []
    for gram in grams:
        others = linear.gram - gram
        others[1:, 1:] += linear.normal / len(names)
        tries.append(np.vstack([point, candidates(replace(linear, gram=others), coordinates, point)]))
    squares = np.square(objective.rmse(coordinates.to_values(np.concatenate(tries))))
    group, left_out = np.array([names.index(groups[run.name]) for run in runs]), []
    for number, found in enumerate(np.split(squares, len(names), axis=1)):
        mine = group == number
        best = np.argmin(found[~mine].sum(axis=0) + found.sum(axis=0) / len(names))
        left_out += found[mine, best].tolist()
    return float(np.sqrt(np.mean(left_out)))


def known(
    network: NetworkSpec,
    model: Model,
    runs: Sequence[ScoredRun],
    groups: Mapping[str, str],
    jobs: int,
    floor: float | None,
) -> NetworkSpec:
    """The network with the intervals of its numbers; runs of one of the ``groups`` err alike."""
    objective = Objective(compile_network(network), runs, jobs)
    point = model.coordinates.of_values(objective.network.start)
    alike: dict[str, list[int]] = {}
    for number, run in enumerate(runs):
        alike.setdefault(groups[run.name], []).append(number)
    found = assess_uncertainty(objective, model.coordinates, point, (), floor, repeats=list(alike.values()))
    return with_intervals(network, dict(zip(model.coordinates.paths, found.intervals, strict=True)))

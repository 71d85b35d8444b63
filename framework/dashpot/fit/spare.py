"""Branches that may go: without them, all else refitted, the data are explained as well.

A branch is worth what the likelihood loses without it. Where the specimen has no such branch, twice the loss of its
logarithm, (|r without|^2 - |r|^2)/e^2 with what a sample counts for, e, has the distribution of chi square with as many
degrees of freedom as the branch has free numbers, or less where they cannot be told apart (Wilks, The large-sample
distribution of the likelihood ratio, 1938). So of branches that are not needed 95 % are found. One that is needed is
taken for spare only where it shows no more than the noise does in all but 5 % of measurements.

Only branches are tried of which some number may as well be zero: the others show too clearly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.model.network import Branch, NetworkSpec
from dashpot.text.problem import InputError

Array = NDArray[np.float64]

MISSED = 0.05  # of the branches that are not needed
EXACT = 1e-6  # of the swing of the force: where there is no noise nothing is told from what a refit leaves over


def spare_branches(
    fitted: NetworkSpec,
    coordinates: Coordinates,
    errors: Array,
    runs: Sequence[ScoredRun],
    error: float,
    refit: Callable[[NetworkSpec], NetworkSpec],
    jobs: int = 1,
) -> tuple[str, ...]:
    """The names of branches that may go together, tried from the last one to the first.

    ``errors`` (p,) are the standard errors of the free numbers in SI, ``error`` is what a sample counts for in N;
    ``refit`` fits a network from its numbers.
    """
    exact = EXACT * float(np.sqrt(np.mean([np.var(run.force[run.first :]) for run in runs])))
    present, found = fitted, []
    whole = _square(fitted, runs, jobs)
    for name, numbers in reversed(_candidates(fitted, coordinates, errors).items()):
        kept = tuple(member for member in present.root.members if member.name != name)
        if not kept:
            break  # a network has a branch
        with suppress(InputError):  # another branch asks for it, or a node needs it
            less = refit(replace(present, root=replace(present.root, members=kept)))
            square = _square(less, runs, jobs)
            if square - whole <= _quantile(numbers) * max(error, exact) ** 2:
                present, whole = less, square
                found.append(name)
    return tuple(found[::-1])


def _candidates(fitted: NetworkSpec, coordinates: Coordinates, errors: Array) -> dict[str, int]:
    """Branches by name, with how many free numbers, one of which is no farther from zero than it may err."""
    values = coordinates.to_values(coordinates.start)[0][coordinates.which]
    found = {}
    for branch in (member.name for member in fitted.root.members if isinstance(member, Branch)):
        own = np.array([path.startswith(f"{branch}.") for path in coordinates.paths], dtype=bool)
        numbers = int(own.sum())
        if numbers and np.any(np.abs(values[own]) < np.sqrt(_quantile(numbers)) * errors[own]):
            found[branch] = numbers
    return found


def _square(network: NetworkSpec, runs: Sequence[ScoredRun], jobs: int) -> float:
    """The sum of the squares of the residual in N^2; infinite for a network that cannot be solved."""
    objective = Objective(compile_network(network), runs, jobs)
    return float(objective.losses(objective.network.start)[0]) ** 2 * objective.total


def _quantile(numbers: int) -> float:
    from scipy.special import chdtri

    return float(chdtri(numbers, MISSED))

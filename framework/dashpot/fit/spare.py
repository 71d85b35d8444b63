"""Branches that may go: without them, all else refitted, the data are explained as well.

A branch is worth what the likelihood loses without it. Where the specimen has no such branch, twice the loss of its
logarithm, (|r without|^2 - |r|^2)/e^2 with what a sample counts for, e, has the distribution of chi square with as many
degrees of freedom as the branch has free numbers, or less where they cannot be told apart (Wilks, The large-sample
distribution of the likelihood ratio, 1938). So of branches that are not needed 95 % are found. One that is needed is
taken for spare only where it shows no more than the noise does in all but 5 % of measurements.

A refit ends as soon as a branch shows: where the square of the residual stays too large even if all the steps that a
refit may take did as much as the last two. It also ends where all of them together could not move it by ``SETTLED``.

Only branches are tried of which some number may as well be zero, or all knots of a curve: the others show too clearly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.fit.coordinates import Coordinates, search_coordinates
from dashpot.fit.kept_curves import Refinement, refinement
from dashpot.fit.objective import Objective
from dashpot.fit.prior import refine_beside_priors
from dashpot.fit.refine import TOLERANCE
from dashpot.fit.scored import ScoredRun
from dashpot.fit.uncertainty import effective_error
from dashpot.model.network import Branch, NetworkSpec, Slot
from dashpot.text.problem import InputError

Array = NDArray[np.float64]

MISSED = 0.05  # of the branches that are not needed
REFIT_STEPS = 40  # of a network with a branch less, which begins near to where it ends
SETTLED = 0.1  # e^2: to which the square is taken, a fortieth of what decides of a branch with one free number
EXACT = 1e-6  # of the swing of the force: where there is no noise nothing is told from what a refit leaves over


def spare_branches(
    fitted: NetworkSpec,
    coordinates: Coordinates,
    errors: Array,
    objective_of: Callable[[NetworkSpec], Objective],
    chosen: Callable[[Slot], bool],
    noise: float | None,
) -> tuple[str, ...]:
    """The names of branches that may go together, tried from the last one to the first.

    ``errors`` (p,) are the standard errors of the free numbers in SI; those that are ``chosen`` are refitted, beside a
    ``noise`` in N. The network with all branches is refitted as the others are: what a search has left over counts for
    none of them.
    """
    candidates = _candidates(fitted, coordinates, errors)
    if not candidates:
        return ()
    objective = objective_of(fitted)
    present, found = _refitted(fitted, objective, chosen, noise, _error(objective, fitted, noise)), []
    error, whole = _error(objective, present, noise), _square(objective, present)
    for name, numbers in reversed(candidates.items()):
        without = _without(present, name)
        if not without.root.members:
            break  # a network has a branch
        with suppress(InputError):  # another branch asks for it, or a node needs it
            objective, most = objective_of(without), whole + _quantile(numbers) * error**2
            less = _refitted(without, objective, chosen, noise, error, most)
            square = _square(objective, less)
            if square <= most:
                present, whole = less, square
                found.append(name)
    return tuple(found[::-1])


def _without(spec: NetworkSpec, name: str) -> NetworkSpec:
    """The network without a branch, and without those that have their numbers from it."""
    kept = tuple(each for each in spec.root.members if not (isinstance(each, Branch) and each.numbers == name))
    ends = {each.name: spec.ends[each.name] for each in kept if each.name in spec.ends}
    return replace(spec, root=replace(spec.root, members=kept), ends=ends)


def _error(objective: Objective, spec: NetworkSpec, noise: float | None) -> float:
    """What a sample counts for in N."""
    among = search_coordinates(spec)
    return max(effective_error(objective, among, among.start, noise), _exact(objective.runs))


def _exact(runs: Sequence[ScoredRun]) -> float:
    return EXACT * float(np.sqrt(np.mean([np.var(run.force[run.first :]) for run in runs])))


def _refitted(
    spec: NetworkSpec,
    objective: Objective,
    chosen: Callable[[Slot], bool],
    noise: float | None,
    error: float,
    most: float | None = None,
) -> NetworkSpec:
    """The network with its numbers refitted, or left where a square of no more than ``most`` N^2 is out of reach."""
    whole = refinement(spec, objective, chosen)
    square = float(whole.loss.losses(whole.coordinates.to_values(whole.coordinates.start))[0]) ** 2 * objective.total
    # half of a change of the square is one of the loss
    enough = 0.5 * SETTLED * error**2 / REFIT_STEPS / square if 0.0 < square < np.inf else 0.0
    hopeless = _never if most is None else OutOfReach(whole, objective.total, most)
    found, _ = refine_beside_priors(
        whole, objective, REFIT_STEPS, noise, tolerance=max(enough, TOLERANCE), hopeless=hopeless
    )
    return whole.at(found.point)


def _never(point: Array, loss: float) -> bool:
    return False


@dataclass
class OutOfReach:
    """Whether the square of the residual stays above ``most`` N^2 if as many steps as a refit may take all do as the
    last one."""

    whole: Refinement
    total: int
    most: float
    last: float = np.inf

    def __call__(self, point: Array, loss: float) -> bool:
        square = self.whole.of_data(point, loss) ** 2 * self.total
        before, self.last = self.last, square
        return REFIT_STEPS * (before - square) < square - self.most and square > self.most


def _candidates(fitted: NetworkSpec, coordinates: Coordinates, errors: Array) -> dict[str, int]:
    """Branches by name, with how many free numbers, one of which is no farther from zero than it may err.

    A curve is zero only where all of its knots are.
    """
    values = np.abs(coordinates.to_values(coordinates.start)[0][coordinates.which])
    aways = np.divide(values, errors, out=np.full(values.shape, np.inf), where=errors > 0.0)
    found = {}
    for branch in (member.name for member in fitted.root.members if isinstance(member, Branch)):
        own = {path: away for path, away in zip(coordinates.paths, aways, strict=True) if path.startswith(f"{branch}.")}
        farthest: dict[str, float] = {}
        for path, away in own.items():
            number = path.partition("[")[0]
            farthest[number] = max(away, farthest.get(number, 0.0))
        if own and min(farthest.values()) < np.sqrt(_quantile(len(own))):
            found[branch] = len(own)
    return found


def _square(objective: Objective, spec: NetworkSpec) -> float:
    """The sum of the squares of the residual in N^2 of a network like that of the objective; infinite where it cannot
    be solved."""
    values = np.array([slot.value.number for slot in spec.slots()])
    return float(objective.losses(values)[0]) ** 2 * objective.total


def _quantile(numbers: int) -> float:
    from scipy.special import chdtri

    return float(chdtri(numbers, MISSED))

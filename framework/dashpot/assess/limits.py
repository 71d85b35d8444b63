"""How small an effect the silence of a diagnosis is about."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.screen import Candidate, Columns, Screen, independent, usable_columns
from dashpot.assess.suspicion import left_by_refit

Array = NDArray[np.float64]

POWER = 0.95
QUANTILE = 1.6448536269514722  # of the normal distribution, at this power
RIDGE = 1e-9


@dataclass(frozen=True, eq=False)
class Limit:
    """The smallest effect of a cause that would have been found with 95 % power, where the cause shows best.

    ``strengths`` (m,) are those of the columns of the candidate, ``force`` is the RMS in N that they make, and
    ``scatter`` the standard deviation with which these data tell their size, as a share of it.
    """

    candidate: Candidate
    strengths: Array
    force: float
    scatter: float

    @property
    def size(self) -> float:
        """The largest of the strengths."""
        return float(np.max(np.abs(self.strengths)))

    @property
    def possible(self) -> bool:
        """Whether the cause can be as large as that."""
        return self.size <= self.candidate.suspect.largest

    def grown(self, factor: float) -> Limit:
        """An effect that is larger by a factor, told with the same deviation."""
        return replace(
            self, strengths=factor * self.strengths, force=factor * self.force, scatter=self.scatter / factor
        )


def find_limits(columns: Columns, screen: Screen, least_force: float) -> list[tuple[Candidate, Limit | None]]:
    """The limit of every cause at every site, none where these runs would not show the largest effect there can be.

    Effects of which a refit seems to leave less than ``least_force`` (RMS, N) are not named.
    """
    clearest: dict[tuple[str, str], Limit] = {}
    for candidate in columns.candidates:
        limit = _limit(candidate, columns, screen)
        if limit and (candidate.name not in clearest or limit.force < clearest[candidate.name].force):
            clearest[candidate.name] = limit
    found = []
    for name, candidate in {candidate.name: candidate for candidate in columns.candidates}.items():
        limit = of_interest(clearest[name], columns, least_force) if name in clearest else None
        found.append((limit.candidate, limit) if limit and limit.possible else (candidate, None))
    return found


def _limit(candidate: Candidate, columns: Columns, screen: Screen) -> Limit | None:
    """The limit of the form of a cause that a candidate is, or None where no run shows it."""
    from scipy.special import chndtrinc

    where, usable = candidate.columns, usable_columns(candidate, screen.projected)
    if usable.size == 0:
        return None
    forces = columns.bank.gram(where.start + usable) / screen.samples
    told = screen.projected.spread[where, where][np.ix_(usable, usable)]
    rank = independent(told)[1] if candidate.suspect.joint else 1
    price = (rank + candidate.suspect.unknowns) * np.log(screen.samples) + screen.threshold
    needed = float(chndtrinc(price, rank, 1.0 - POWER))
    direction = _clearest(told, forces) if candidate.suspect.joint else _clearest_place(told, forces)
    direction = direction * np.sqrt(needed / (direction @ told @ direction))
    strengths = np.zeros(where.stop - where.start)
    strengths[usable] = direction
    return Limit(candidate, strengths, float(np.sqrt(direction @ forces @ direction)), float(needed**-0.5))


def _clearest(told: Array, forces: Array) -> Array:
    """The strengths (m,) together of which the data tell most for the force that they make."""
    from scipy.linalg import eigh

    scale = np.sqrt(np.diag(forces))
    inside = [matrix / np.outer(scale, scale) for matrix in (told, forces)]
    inside[1] = inside[1] + RIDGE * np.eye(scale.size)
    return eigh(*inside, subset_by_index=(scale.size - 1, scale.size - 1))[1][:, 0] / scale


def _clearest_place(told: Array, forces: Array) -> Array:
    """As ``_clearest``, where one place acts at a time."""
    return np.eye(len(told))[int(np.argmax(np.diag(told) / np.diag(forces)))]


def of_interest(limit: Limit, columns: Columns, least_force: float) -> Limit:
    """The limit where effects of which a refit seems to leave less than ``least_force`` (RMS, N) are not named.

    The size that it seems to have scatters about the true one, which has to be that much larger.
    """
    seems = least_force / max(left_force(limit, columns), 1e-300)
    return limit.grown(max(1.0, seems + QUANTILE * limit.scatter))


def left_force(limit: Limit, columns: Columns) -> float:
    """The RMS in N that a refit leaves of an effect at its limit; all runs weigh the same."""
    strengths = np.zeros(columns.bank.size)
    strengths[limit.candidate.columns] = limit.strengths
    effect = {run: columns.bank.combined(strengths, run) for run in columns.residual}
    return float(np.sqrt(left_by_refit(columns.tangents, effect) / len(effect)))

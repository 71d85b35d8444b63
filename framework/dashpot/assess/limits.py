"""How small an effect the silence of a diagnosis is about."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.screen import Candidate, Columns, Screen, independent, usable_columns

Array = NDArray[np.float64]

POWER = 0.95
QUANTILE = 1.6448536269514722  # of the normal distribution, at this power
SHAPES = 400
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Limit:
    """The smallest effect of a cause that would have been found with 95 % power.

    ``strengths`` (m,) are those of the columns of the candidate where they show best, ``force`` is the RMS in N that
    they make, ``left`` what a refit of the model leaves of that, and ``hardest`` what it has to leave at the place, or
    of the shape, that shows worst. All runs weigh the same. ``scatter`` is the standard deviation with which these data
    tell the size, as a share of it.
    """

    candidate: Candidate
    strengths: Array
    force: float
    left: float
    hardest: float
    scatter: float

    @property
    def size(self) -> float:
        """The largest of the strengths."""
        return float(np.max(np.abs(self.strengths)))

    @property
    def possible(self) -> bool:
        """Whether the cause can be as large as that."""
        return self.size <= self.candidate.suspect.largest

    def of_interest(self, least_force: float) -> Limit:
        """The limit where effects of which a refit seems to leave less than ``least_force`` (RMS, N) are not named.

        The size that an effect seems to have scatters about the true one, which has to be that much larger.
        """
        grown, hardest = (
            max(1.0, least_force / max(left, 1e-300) + QUANTILE * self.scatter) for left in (self.left, self.hardest)
        )
        return replace(self, strengths=grown * self.strengths, force=grown * self.force, left=grown * self.left,
                       hardest=hardest * self.hardest, scatter=self.scatter / grown)  # fmt: skip


def find_limits(columns: Columns, screen: Screen, least_force: float) -> list[tuple[Candidate, Limit | None]]:
    """The limit of every cause at every site, none where these runs would not show the largest effect there can be.

    It is that of the form and the place of its grid that show best, but for ``hardest``, which is that of them all.
    Of columns that act together 95 % of the shapes show better. Effects below ``least_force`` are not named; see
    ``of_interest``.
    """
    found: dict[tuple[str, str], tuple[Candidate, Limit | None]] = {}
    for candidate in columns.candidates:
        _, best = found.setdefault(candidate.name, (candidate, None))
        limit = _limit(candidate, columns, screen)
        limit = limit.of_interest(least_force) if limit else None
        if limit and limit.possible:
            best, hardest = best or limit, max(limit.hardest, best.hardest if best else 0.0)
            found[candidate.name] = (candidate, replace(min(best, limit, key=_force), hardest=hardest))
    return list(found.values())


def _limit(candidate: Candidate, columns: Columns, screen: Screen) -> Limit | None:
    """The limit of the form of a cause that a candidate is, or None where no run shows it."""
    from scipy.special import chndtrinc

    where, usable = candidate.columns, usable_columns(candidate, screen.projected)
    if usable.size == 0:
        return None
    forces, left = _products(columns, where.start + usable)
    told = screen.projected.spread[where, where][np.ix_(usable, usable)]
    rank = independent(told)[1] if candidate.suspect.joint else 1
    price = (rank + candidate.suspect.unknowns) * np.log(screen.samples) + screen.threshold
    needed = float(chndtrinc(price, rank, 1.0 - POWER))
    shapes = np.eye(usable.size)
    if candidate.suspect.joint:
        shapes = _hard_shape(told, left, candidate.suspect.sign)[None]
    told, forces, left = (np.einsum("ij,jk,ik->i", shapes, of, shapes) for of in (told, forces, left))
    at = int(np.argmax(told / forces))
    strengths = np.zeros(where.stop - where.start)
    strengths[usable] = np.sqrt(needed / told[at]) * shapes[at]
    force, seen = (float(np.sqrt(needed / told[at] * of[at])) for of in (forces, left))
    return Limit(candidate, strengths, force, seen, float(np.sqrt(needed * np.max(left / told))), needed**-0.5)


def _force(limit: Limit) -> float:
    return limit.force


def _hard_shape(told: Array, left: Array, sign: int) -> Array:
    """The strengths (m,) of which only 5 % of all others tell less for the force that a refit leaves of them."""
    shapes = np.random.default_rng(0).standard_normal((SHAPES, len(told))) / np.sqrt(np.diag(left))
    shapes = np.abs(shapes) if sign else shapes
    clear = np.einsum("ij,jk,ik->i", shapes, told, shapes) / np.einsum("ij,jk,ik->i", shapes, left, shapes)
    return shapes[np.argsort(clear)[int((1.0 - POWER) * SHAPES)]]


def _products(columns: Columns, chosen: NDArray[np.intp]) -> tuple[Array, Array]:
    """Mean products (k, k) of chosen columns of the bank, and what a refit of the model leaves of them.

    All runs weigh the same.
    """
    bank, fixed = columns.bank, columns.tangents.size
    total, new = np.zeros((fixed + chosen.size,) * 2), np.full(bank.size, -1)
    new[chosen] = fixed + np.arange(chosen.size)
    for run, places in bank.places.items():
        here = np.flatnonzero(new[places] >= 0)
        rows = np.concatenate([columns.tangents.values[run], bank.values[run][here]])
        at = np.concatenate([np.arange(fixed), new[places[here]]])
        total[np.ix_(at, at)] += rows @ rows.T / (rows.shape[1] * len(bank.places))
    forces, cross = total[fixed:, fixed:], total[:fixed, fixed:]
    left = forces - cross.T @ np.linalg.lstsq(total[:fixed, :fixed], cross, rcond=1e-12)[0]
    # rounding may leave less than nothing of a column that the numbers of the model can follow
    np.fill_diagonal(left, np.maximum(np.diag(left), ROUNDING * np.diag(forces)))
    return forces, left

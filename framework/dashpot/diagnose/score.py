"""The score of a structure: what it predicts of runs that took no part in its fit, and its prior odds.

For each group of runs (a run with its repeats) the structure is fitted to all others, to first order, and predicts it;
minus the predictive log likelihood, under one variance for all groups, is

    n / 2 log(mean square of what is not predicted),

in nats, with the n independent samples of all groups. A variance for each group would let a structure win that follows
some runs to the noise and gives up the others. A term that only follows the noise, or the error of another term's form,
does not predict. The prior odds of each term are stated in ``Odds``.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.linear_step import STEADY, Added, Held, LinearStep, Structure
from dashpot.diagnose.term import Model

Array = NDArray[np.float64]

FALSE_ALARMS = 0.01  # of data sets in which nothing is hidden
RIG_ODDS = 0.01  # of a fault of the measurement against a law of the specimen
NUMBER_ODDS = 0.1  # of a law with a number more against one without it


@dataclass(frozen=True)
class Odds:
    """Prior odds of a term, in nats: with ``columns`` to choose from, none is named by chance but in 1 % of cases."""

    columns: int

    def price(self, kind: str, numbers: int = 1) -> float:
        """What a term with so many numbers has to predict before it is more likely than not."""
        found = np.log(max(self.columns, 1) / FALSE_ALARMS) - max(numbers - 1, 0) * np.log(NUMBER_ODDS)
        return float(found - (np.log(RIG_ODDS) if kind == "measurement" else 0.0))

    def of_model(self, model: Model) -> float:
        """The price of all terms of a model."""
        return sum(self.price(term.cause.kind, model.count(number)) for number, term in enumerate(model.terms))


@dataclass(eq=False)
class Scores(LinearStep):
    """The scores of structures at one look; what was computed once is kept."""

    odds: Odds = field(init=False)
    known: dict[Structure, tuple[Array, float] | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__post_init__()
        self.odds = Odds(self.look.layout.bank)
        self.kinds = [term.cause.kind for term in self.look.model.terms]

    def predicted(self, structure: Structure) -> tuple[Array, float] | None:
        """Mean square (groups,) of each group, predicted from all others, and what errors of forms cost in nats.

        None where a strength has the wrong sign.
        """
        if structure not in self.known:
            self.known[structure] = self._predicted(structure) if self.admitted(structure) else None
        return self.known[structure]

    def _predicted(self, structure: Structure) -> tuple[Array, float]:
        front, gone, foreseen = self.look.front, structure.dropped, structure != Structure()
        fit = self.fit(structure) if foreseen else self._fit(structure, Held())
        grams = front.groups(fit.combined / self.scale[:, None], gone)
        left = _left_out(grams, fit.whole, fit.right, foreseen)
        rest = (fit.rest if foreseen else fit.combined[:, -1]) * self.scale[0] / self.scale
        return np.maximum(left * self.scale[0] ** 2 / self.look.samples, 1e-12), front.beside(gone).unlikely(rest)

    def exact(self) -> Array:
        """Mean square (groups,) of each group, predicted from all others by the present structure.

        The laws are as they are: no errors of their forms are allowed for.
        """
        total = self.look.exact.sum(axis=0)
        scale = np.sqrt(np.maximum(np.diag(total), 1e-300))
        alive = 1 + np.flatnonzero(np.diag(total)[1:] > 0.0)
        unit = scale[alive]
        known = np.diag(1.0 / unit**2)
        combined = np.zeros((scale.size, alive.size + 1))
        combined[alive, np.arange(alive.size)] = 1.0 / unit
        combined[0, -1] = 1.0 / scale[0]
        products = combined.T @ total @ combined
        whole = products[:-1, :-1] + known + STEADY * np.eye(alive.size)
        left = _left_out(combined.T @ self.look.exact @ combined, whole, products[:-1, -1], foreseen=False)
        return np.maximum(left * scale[0] ** 2 / self.look.samples, 1e-12)

    def price(self, structure: Structure) -> float:
        """The prior of a structure in nats: what joins less what goes."""
        joins = sum(self.joining(added) for added in structure.added)
        model = self.look.model
        return joins - sum(self.odds.price(self.kinds[number], model.count(number)) for number in structure.dropped)

    def joining(self, added: Added) -> float:
        """The price of what joins."""
        candidate = self.look.candidates[added.candidate]
        numbers = len(added.places) * (1 + (0 if candidate.suspect.joint else candidate.suspect.unknowns))
        return self.odds.price(candidate.cause.kind, numbers)

    def score(self, structure: Structure) -> float:
        """Minus the log of likelihood and prior; the smaller, the better; infinite for one of the wrong sign."""
        found = self.predicted(structure)
        return np.inf if found is None else float(nats(found[0], self.look.samples)) + found[1] + self.price(structure)


def nats(squares: Array, samples: Array) -> Array:
    """Minus the log likelihood (...) of mean squares (..., groups) of ``samples`` (..., groups), of one variance."""
    whole = samples.sum(axis=-1)
    found: Array = 0.5 * whole * np.log(np.sum(samples * squares, axis=-1) / whole)
    return found


def _left_out(grams: Array, whole: Array, right: Array, foreseen: bool) -> Array:
    """The squares (groups,) of a target that k columns leave in each group, with strengths from all others.

    ``grams`` (groups, k + 1, k + 1) are those of the columns and the target; ``whole`` (k, k) and ``right`` (k,), of
    the columns and of these with the target, are their sums over the groups, and what is known of the strengths
    beforehand. Where the strengths are not ``foreseen`` the model stays as it is, but for what leaving a group out
    changes: a step that a fit has not made promises too much.
    """
    inner, cross, square = grams[:, :-1, :-1], grams[:, :-1, -1], grams[:, -1, -1]
    # what the other groups hardly tell is not put to the test: there the fit to all runs stands in
    tied = 1.0 / len(inner)
    solved = np.linalg.solve((1.0 + tied) * whole - inner, ((1.0 + tied) * right - cross)[..., None])
    if not foreseen:
        solved -= np.linalg.solve(whole, right)[:, None]
    left: Array = square - 2.0 * np.sum(solved[..., 0] * cross, axis=1)
    return left + np.sum(solved * (inner @ solved), axis=(1, 2))

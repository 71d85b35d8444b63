"""Specimens that do not belong to the population, with the probability of each way in which they may not."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.campaign.mixed import Mixed, fit_mixed
from dashpot.campaign.numbers import Numbers
from dashpot.text.quantity import dimensions

Array = NDArray[np.float64]

PRIOR = 0.005  # of a specimen to be unlike the others, before it was measured
FAR = 6.0  # standard deviations, typical for a number of a specimen that is unlike the others
GAIN = 0.3  # typical relative error of a sensor with a wrong gain
SCREEN = 4.0  # robust standard deviations at which a specimen does not count at first
MAD = 1.4826
FEWEST = 8
MOST_ROUNDS = 30
SETTLED = 1e-4
PARALLEL = 0.999
FORCE, TRAVEL, BOTH, SEVERAL = "gain of the force", "gain of the travel", "gain of the force or the travel", "several"


@dataclass(frozen=True, eq=False)
class Unlike:
    """The population of the specimens that belong to it, and how far each does not.

    ``ways`` names h ways to be unlike: a number alone by its path, several of them, or a gain; ``probability`` (n, h)
    is that of each. ``distances`` (n, p) are the deviations from what the others predict, in standard deviations, and
    ``shifts`` (n, p) the same in coordinates. With fewer specimens than ``needed`` none was ``tested``.
    """

    population: Mixed
    ways: tuple[str, ...]
    probability: Array
    distances: Array
    shifts: Array
    needed: int

    @property
    def tested(self) -> bool:
        """Whether there are specimens enough to hold each against the others."""
        return len(self.shifts) >= self.needed

    @property
    def outside(self) -> Array:
        """The probability (n,) of each specimen to be unlike the others."""
        return self.probability.sum(axis=1)


def unlike(numbers: Numbers, apart: Container[str] = ()) -> Unlike:
    """Fit the population and judge every specimen by the others, until both agree.

    A specimen that belongs to it is predicted by the others with a multivariate t distribution; one that does not
    scatters ``FAR`` times as far in one number or in all, or has every number times a power of one factor, as where the
    gain of a sensor is wrong. Specimens count as far as they belong, those that are known to be ``apart`` not at all.
    With fewer than ``FEWEST`` none is doubted.

    Sources: Aitkin and Wilson, Technometrics 22 (1980) 325, for the mixture; Box and Tiao, Biometrika 55 (1968) 119.
    """
    counting = np.array([float(name not in apart) for name in numbers.specimens])
    few = len(numbers.specimens) < needed(numbers)
    weights = counting * (1.0 if few else _screened(numbers))
    for _ in range(1 if few else MOST_ROUNDS):
        population = fit_mixed(numbers.at, numbers.errors, numbers.design, np.maximum(weights, 1e-6))
        found = _judged(numbers, population, weights)
        belonging = counting * np.clip(1.0 - found.outside, 0.0, 1.0)
        if few or np.abs(belonging - weights).max() < SETTLED:
            break
        weights = belonging
    return replace(found, probability=np.zeros_like(found.probability)) if few else found


def detectable(found: Unlike, probability: float) -> float:
    """How many standard deviations a number alone must be off, so that a specimen is outside with a ``probability``.

    That of a number that is correlated with no other, and of a specimen that the others predict without error; infinite
    where they are too few for that. Few others know their own scatter badly, so that it takes more.
    """
    numbers = found.shifts.shape[1]
    freedom = _freedom(found.population.freedom - 1.0, numbers)
    wider = 1.0 + FAR**2
    odds = probability / (1.0 - probability) * (1.0 - PRIOR) / (PRIOR / len(found.ways))
    # (1 + u) / (1 + u / wider) to the power of (freedom + numbers) / 2 is the ratio of the two densities
    ratio = (odds * np.sqrt(wider)) ** (2.0 / (freedom + numbers))
    return float(np.sqrt(freedom * (ratio - 1.0) / (1.0 - ratio / wider))) if ratio < wider else float("inf")


def _judged(numbers: Numbers, population: Mixed, weights: Array) -> Unlike:
    ways, spreads = _ways(numbers, population)
    freedom = _freedom(float(weights.sum()) - numbers.design.shape[1], len(numbers.paths))
    total = np.einsum("n,njk->jk", weights, population.moments)
    odds = np.empty((len(weights), 1 + len(ways)))
    distances, shifts = np.empty_like(numbers.at), np.empty_like(numbers.at)
    prior = np.log([1.0 - PRIOR, *[PRIOR / len(ways)] * len(ways)])
    for i, weight in enumerate(weights):
        others = (total - weight * population.moments[i]) / max(weights.sum() - weight, 1.0)
        shifts[i], told = _predicted(numbers, others, np.where(np.arange(len(weights)) == i, 0.0, weights), i)
        expected = others + numbers.errors[i] + told
        odds[i] = prior + [_log_t(shifts[i], expected + spread, freedom) for spread in (0.0, *spreads)]
        distances[i] = shifts[i] / np.sqrt(expected.diagonal())
    shares = np.exp(odds - odds.max(axis=1, keepdims=True))
    shares /= shares.sum(axis=1, keepdims=True)
    return Unlike(population, ways, shares[:, 1:], distances, shifts, needed(numbers))


def _freedom(others: float, numbers: int) -> float:
    """The degrees of freedom of a prediction of so many numbers."""
    return max(others - numbers, 2.0)


def needed(numbers: Numbers) -> int:
    """The fewest specimens of which each can be held against the others."""
    return FEWEST + numbers.design.shape[1]


def _predicted(numbers: Numbers, between: Array, weights: Array, which: int) -> tuple[Array, Array]:
    """How far a specimen is from its mean as the others tell it, and the covariance of that mean."""
    p, q = numbers.at.shape[1], numbers.design.shape[1]
    inverse = np.linalg.inv(between + numbers.errors) * weights[:, None, None]
    normal = np.einsum("njk,na,nb->jakb", inverse, numbers.design, numbers.design).reshape(p * q, p * q)
    right = np.einsum("njk,nk,na->ja", inverse, numbers.at, numbers.design).reshape(p * q)
    covariance = np.linalg.pinv(normal, hermitian=True)
    means, row = (covariance @ right).reshape(p, q), numbers.design[which]
    return numbers.at[which] - means @ row, np.einsum("a,jakb,b->jk", row, covariance.reshape(p, q, p, q), row)


def _ways(numbers: Numbers, population: Mixed) -> tuple[tuple[str, ...], list[Array]]:
    """The ways to be unlike, and the covariance (p, p) that each adds."""
    typical = np.median(numbers.errors.diagonal(axis1=1, axis2=2), axis=0)
    far = FAR**2 * np.diag(population.between.diagonal() + typical)
    alone = [np.diag(np.where(np.arange(len(far)) == k, far.diagonal(), 0.0)) for k in range(len(far))]
    found = dict(zip(numbers.paths, alone, strict=True))
    if len(numbers.paths) > 1:
        found[SEVERAL] = far
        found |= {way: GAIN**2 * np.outer(line, line) for way, line in _gains(numbers, population.means[0])}
    return tuple(found), list(found.values())


def _gains(numbers: Numbers, means: Array) -> Sequence[tuple[str, Array]]:
    """How the parameters move with a gain: the powers of force and length in their units."""
    powers = np.array([dimensions(unit)[:2] for unit in numbers.units])
    force, travel = (powers * np.where(numbers.log, 1.0, means)[:, None]).T
    lines = [(way, line) for way, line in ((FORCE, force), (TRAVEL, travel)) if np.count_nonzero(line) > 1]
    if len(lines) == 2 and abs(force @ travel) > PARALLEL * np.linalg.norm(force) * np.linalg.norm(travel):
        return [(BOTH, force)]
    return lines


def _log_t(shift: Array, scale: Array, freedom: float) -> float:
    """The logarithm of a multivariate t density, up to a constant of its size and freedom."""
    _, size = np.linalg.slogdet(scale)
    square = shift @ np.linalg.solve(scale, shift)
    return float(-0.5 * size - 0.5 * (freedom + shift.size) * np.log1p(square / freedom))


def _screened(numbers: Numbers) -> Array:
    """One for every specimen near the bulk, zero for the others, number by number without any covariance."""
    kept = np.ones(len(numbers.at), dtype=bool)
    for column in numbers.at.T:
        rest = column - numbers.design @ _robust_line(numbers.design, column)
        rest -= np.median(rest)
        size = MAD * np.median(np.abs(rest))
        kept &= np.abs(rest) <= SCREEN * size if size > 0.0 else True
    return kept.astype(float) if kept.sum() > numbers.design.shape[1] + 2 else np.ones(len(kept))


def _robust_line(design: Array, column: Array) -> Array:
    """Least absolute deviations, by weighted least squares again and again."""
    line, weights = np.zeros(design.shape[1]), np.ones(len(column))
    for _ in range(30):
        root = np.sqrt(weights)[:, None]
        line[:] = np.linalg.lstsq(design * root, column * root[:, 0], rcond=None)[0]
        rest = np.abs(column - design @ line)
        weights = 1.0 / np.maximum(rest, 1e-6 * max(rest.max(), 1e-300))
    return line

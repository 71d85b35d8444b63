"""How well a fit knows its parameters, from the scatter of its gradient between blocks of records and between runs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from dashpot.data.steady import STEADY
from dashpot.fit.alike import moved_alike
from dashpot.fit.coordinates import Coordinates
from dashpot.fit.decided import decide, doubt_of
from dashpot.fit.linear import Linear, Loss, linearise
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

LEVEL = 0.975
NORMAL = 1.959964  # the quantile of LEVEL of a normal distribution
BLOCK_SECONDS = 0.5
FEWEST_BLOCKS = 8
FEWEST_RUNS = 3
WEAK = 1e-6
UNDECIDED = 1e-12  # of the largest eigenvalue, with parameters scaled alike
MOST_LEVERAGE = 0.99
ABSORBED = 8.0
NOISE_KNOWN = 1.05  # noise floors may be this much too low


class OfRuns(Loss, Protocol):
    """A loss of ``runs``, with ``total`` samples."""

    runs: tuple[ScoredRun, ...]
    total: int

    def repeated(self) -> list[list[int]]:
        """Numbers of runs, grouped: those of a group are repeats of one another."""


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """``covariance`` (p, p) and half ``widths`` (p,) of the intervals, both in natural steps of the coordinates.

    ``moved`` (k, p), in the same steps, is what each of k systematic deviations does to the parameters. ``errors`` (p,)
    are the standard errors from all that, infinite where the data do not determine a parameter.
    ``idle`` names parameters the data do not feel. The interval of an idle parameter, of one that others can make up
    for entirely, and of one around which the network cannot be solved, is its whole range.
    """

    covariance: Array
    widths: Array
    intervals: tuple[tuple[float, float], ...]
    at_bound: tuple[str, ...]
    idle: tuple[str, ...]
    moved: Array
    errors: Array

    @property
    def correlation(self) -> Array:
        """The correlation (p, p) of the errors of the parameters; of those that the data do not feel 0."""
        scale = np.sqrt(np.diag(self.covariance))
        known = np.where(np.isfinite(scale) & (scale > 0.0), scale, np.inf)
        found = np.where(np.isfinite(self.covariance), self.covariance, 0.0) / np.outer(known, known)
        np.fill_diagonal(found, 1.0)
        return found


def assess_uncertainty(
    objective: OfRuns,
    coordinates: Coordinates,
    point: Array,
    systematic: Sequence[Array] = (),
    noise: float | None = None,
    priors: Array | None = None,
    error: float = 0.0,
    repeats: Sequence[Sequence[int]] | None = None,
) -> Uncertainty:
    """Sandwich covariance with blocks of half a second or with whole runs, whichever is wider for a parameter.

    Coloured noise shows between blocks; what a model gets wrong in every cycle of a run shows between runs only. The
    ``repeats``, groups of numbers of runs, by default those with the same motion, count as one; three are needed.

    A block holds the same half second of all runs that were moved alike, since the residuals of a model are alike in
    them; a row of a table is in one block. The score of each block is corrected for what the fit has
    taken out of it, and the quantile is that of Student's t with the degrees of freedom that the blocks amount to,
    which are few where a parameter shows in a narrow band of a sweep only.
    ``tests/interval_coverage`` measures how often the intervals hold. Each of the ``systematic`` deviations, steps
    (slots,) in SI by one standard error of something that the runs cannot tell, widens them in addition.
    Where the ``noise`` (N) is known, a model with a larger RMSE has wider intervals: see ``widening``. ``priors``
    (k, p), the changes of their pulls with natural steps, narrow the intervals as in a fit in which a sample counts
    for ``error`` (N).

    Sources: Liang and Zeger, Biometrika 73 (1986) 13, with blocks of time as clusters; Bell and McCaffrey, Survey
    Methodology 28 (2002) 169, for the correction (CR2 under white noise) and the degrees of freedom.
    """
    linear = linearise(objective, coordinates, point, systematic)
    unsolved, scale = linear.unsolved[: point.size], np.sqrt(np.diag(linear.normal))
    loss = np.sqrt(linear.square / objective.total)
    known_before = error * (np.zeros((0, point.size)) if priors is None else priors)
    told = np.any(known_before != 0.0, axis=0)
    idle = ~unsolved & ~told & (scale / np.sqrt(objective.total) < WEAK * max(loss, 1e-300))
    doubt = doubt_of(linear, coordinates, point)
    root, lost = _scaled_root(linear.normal + known_before.T @ known_before, idle | unsolved, doubt)
    covariance, freedom = _sandwich(_blocks(objective, linear), root)
    groups = repeats or objective.repeated()
    within, between = np.sqrt(np.diag(covariance)), _between_runs(groups, linear, root)
    random = np.maximum(within * _quantiles(freedom), between * _quantiles(np.array([len(groups) - 1.0])))
    moved = -linear.beside @ root @ root.T
    # the middle of a prior may be off by its deviation
    pulled = error * known_before @ root @ root.T
    wider = widening(float(loss), noise)
    unknown = idle | lost | unsolved

    def root_of_sum(random: Array, systematic: float) -> Array:
        beside = np.sum(moved**2, axis=0) + np.sum(pulled**2, axis=0)
        squares = (random * wider) ** 2 + systematic**2 * beside
        return np.where(unknown | ~np.isfinite(squares), np.inf, np.sqrt(squares))

    widths = root_of_sum(random, NORMAL)
    near = 1e-6 * (coordinates.high - coordinates.low)
    bound = (point <= coordinates.low + near) | (point >= coordinates.high - near)
    return Uncertainty(
        covariance + pulled.T @ pulled,
        widths,
        tuple(_interval(coordinates, k, point[k], widths[k] * coordinates.unit[k]) for k in range(point.size)),
        tuple(np.array(coordinates.paths)[bound].tolist()),
        tuple(np.array(coordinates.paths)[idle].tolist()),
        moved,
        root_of_sum(np.maximum(within, between), 1.0),
    )


def effective_error(objective: OfRuns, coordinates: Coordinates, point: Array, noise: float | None = None) -> float:
    """What a sample counts for in N, were samples independent: as much as the blocks of the record say at a point (p,).

    The standard deviation of white noise; more where residuals are coloured, as scores of blocks then scatter more than
    their sum of squares says, and where the model is worse than the ``noise`` (N); see ``widening``.
    """
    linear = linearise(objective, coordinates, point)
    loss = float(np.sqrt(linear.square / objective.total))
    root, _ = _scaled_root(linear.normal, linear.unsolved, np.zeros_like(linear.normal))
    if not root.shape[1]:
        return loss
    covariance, _ = _sandwich(_blocks(objective, linear), root)
    # few blocks may scatter less by chance; samples never count for more than they would if they were independent
    return max(float(np.sqrt(np.sum(covariance * linear.normal) / root.shape[1])), loss) * widening(loss, noise)


def widening(loss: float, noise: float | None) -> float:
    """The factor on intervals of a model whose loss is above the noise (N); 1 where it is not, or the noise unknown.

    The parameters of a model of wrong structure absorb most of its error; what remains visible is a share of it that
    the scatter between blocks cannot know. ``ABSORBED`` is how many times more is thought to be
    absorbed than remains, in squares: a rule of thumb; ``tests/unsprung_mass`` shows how often the intervals hold.
    """
    if noise is None or loss <= NOISE_KNOWN * noise:
        return 1.0
    return float(np.sqrt(1.0 + ABSORBED * (1.0 - (NOISE_KNOWN * noise / loss) ** 2)))


def _sandwich(blocks: Iterable[Array], root: Array) -> tuple[Array, Array]:
    """Covariance (p, p) and degrees of freedom (p,) from the products (1 + p, 1 + p) of the rows r and J of each block.

    ``root`` (p, k) is W with W W' the inverse of J J' over all blocks.
    """
    size, kept = root.shape
    middle, freedom, squares = np.zeros((kept, kept)), np.zeros(size), np.zeros(size)
    for block in blocks:
        leverage, axes = np.linalg.eigh(root.T @ block[1:, 1:] @ root)
        gradient = axes.T @ (root.T @ block[1:, 0])
        score = axes @ (gradient / np.sqrt(1.0 - np.clip(leverage, 0.0, MOST_LEVERAGE)))
        middle += np.outer(score, score)
        share = np.sum((root @ axes) ** 2 * np.maximum(leverage, 0.0), axis=1)
        freedom, squares = freedom + share, squares + share**2
    return root @ middle @ root.T, freedom**2 / np.maximum(squares, 1e-300)


def _between_runs(groups: Sequence[Sequence[int]], linear: Linear, root: Array) -> Array:
    """Standard errors (p,) from the scores of groups of whole runs; 0 for fewer than three."""
    if len(groups) < FEWEST_RUNS:
        return np.zeros(len(root))
    group_of = {number: place for place, group in enumerate(groups) for number in group}
    scores = np.zeros((len(groups), len(root)))
    for number, score in linear.each(lambda number, rows: (number, rows[1:] @ rows[0])):
        scores[group_of[number]] += score
    count = len(groups)
    moved = scores @ root @ root.T
    return np.asarray(np.sqrt(count / (count - 1.0) * np.sum(moved**2, axis=0)))


def _quantiles(freedom: Array) -> Array:
    from scipy.special import stdtrit

    return stdtrit(np.maximum(freedom, 1.0), LEVEL)


def _scaled_root(normal: Array, without: NDArray[np.bool_], doubt: Array) -> tuple[Array, NDArray[np.bool_]]:
    """``_inverse_root`` of products (p, p) with parameters scaled alike, some of which are left out."""
    scale = np.sqrt(np.diag(normal))
    safe = np.where(without | (scale == 0.0), 1.0, scale)
    root, lost = _inverse_root(normal / np.outer(safe, safe), doubt / np.outer(safe, safe))
    return root / safe[:, None], lost


def _inverse_root(normal: Array, doubt: Array) -> tuple[Array, NDArray[np.bool_]]:
    """W (p, k) with W W' the inverse where the data decide, and which parameters share in what they do not decide."""
    values, vectors = np.linalg.eigh(normal)
    kept, others = decide(values, vectors, doubt, UNDECIDED)
    return vectors[:, kept] / np.sqrt(values[kept]), (others != 0.0).any(axis=1)


def _blocks(objective: OfRuns, linear: Linear) -> Iterator[Array]:
    """The products (1 + p, 1 + p) of the rows of each block, group by group as soon as its last run was seen."""
    groups = moved_alike(objective.runs)
    group_of = {number: group for group in groups for number in group}
    lengths = {group[0]: _length([objective.runs[number] for number in group]) for group in groups}

    def products(number: int, rows: Array) -> tuple[int, Array]:
        length = lengths[group_of[number][0]]
        pieces = (rows[:, first : first + length] for first in range(0, rows.shape[1], length))
        return number, np.array([piece @ piece.T for piece in pieces])

    begun: dict[int, Array] = {}
    missing = {group[0]: len(group) for group in groups}
    for number, found in linear.each(products):
        first = group_of[number][0]
        begun[first] = _added(begun[first], found) if first in begun else found
        missing[first] -= 1
        if not missing[first]:
            yield from begun.pop(first)


def _length(runs: Sequence[ScoredRun]) -> int:
    """The samples of a block in runs that were moved alike."""
    run = runs[0]
    if run.kind == STEADY:
        return max(each.samples for each in runs)
    return max(1, min(round(BLOCK_SECONDS / run.drive.dt), run.samples // FEWEST_BLOCKS))


def _added(some: Array, more: Array) -> Array:
    shorter, longer = sorted((some, more), key=len)
    longer[: len(shorter)] += shorter
    return longer


def _interval(coordinates: Coordinates, number: int, middle: float, width: float) -> tuple[float, float]:
    low = max(middle - width, coordinates.low[number])
    high = min(middle + width, coordinates.high[number])
    if coordinates.log[number]:
        return float(np.exp(low)), float(np.exp(high))
    return float(low), float(high)

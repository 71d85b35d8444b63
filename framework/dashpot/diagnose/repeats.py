"""What repeats of a run tell of faults of the force channel: their difference needs no model.

A specimen answers the same motion alike but for a scatter from test to test, or changes in one way.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Cause, ChannelFault
from dashpot.diagnose.folds import whole_cycles
from dashpot.diagnose.jackknife import PIECES, half_widths
from dashpot.diagnose.look import RESOLUTION, Doubt, Look
from dashpot.diagnose.odds import Odds
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.whitening import Noise, filtered, independent_share, learn_filter, whiten_effects
from dashpot.fit import alike
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

SAME_MOTION = alike.SAME_MOTION  # of the deviation of the displacement
Key = tuple[str, int]  # run, number of the kind
Pair = tuple[str, str]  # runs of the same motion


@dataclass(frozen=True, eq=False)
class Kind:
    """A kind of fault that a cause names."""

    cause: type[Cause]
    fault: ChannelFault


@dataclass(frozen=True, eq=False)
class Rows:
    """Residual, tangents (p, n) and shapes by kind (k, n) of every run, whitened or as they are.

    ``smallest`` is the deviation in N of each record below which nothing is believed, ``admitted`` (k, n) in N what the
    data sheets of the channel admit, ``pieces`` where each record may be cut into whole cycles.
    """

    residual: Mapping[str, Array]
    tangents: Mapping[str, Array]
    shapes: Mapping[Key, Array]
    smallest: Mapping[str, float]
    admitted: Mapping[str, Array]
    pieces: Mapping[str, Sequence[int]]


def kinds_of(causes: Sequence[type[Cause]], look: Look) -> list[Kind]:
    """All kinds of faults that the causes name."""
    return [Kind(cause, fault) for cause in causes for fault in cause().channel_faults(look.view)]


def rows_of(refitter: Refitter, look: Look, kinds: Sequence[Kind], noise: Noise) -> Rows:
    """What the tests need under a noise."""
    residual, tangents = refitter.linearise(look.model, noise)
    shapes = {}
    for run in refitter.runs:
        for number, kind in enumerate(kinds):
            found = np.atleast_2d(kind.fault.shapes(look.view, run.name))[:, run.first :]
            shapes[run.name, number] = noise.filter(run.name, noise.reduce_shapes(run.name, found))
    smallest = {run.name: RESOLUTION * max(float(np.std(run.force)), 1e-12) for run in refitter.runs}
    pieces = {run.name: _pieces_of(run, residual[run.name].size) for run in refitter.runs}
    return Rows(residual, tangents, shapes, smallest, look.noise.admitted, pieces)


def _pieces_of(run: ScoredRun, kept: int) -> list[int]:
    """Where the reduced record of a run, so many values, may be cut into whole cycles."""
    edges = whole_cycles(run.drive.displacement[run.first :], PIECES)
    return sorted({round(edge * kept / edges[-1]) for edge in edges})


def doubts(refitter: Refitter, look: Look, kinds: Sequence[Kind], groups: Mapping[str, str]) -> list[Doubt]:
    """The faults by which repeats of one run differ, and how much: the difference needs no model."""
    rows, pairs = rows_of(refitter, look, kinds, plain_noise(look)), repeats_of(refitter, groups)
    price = Odds(len(kinds) * max(len(pairs), 1)).price("specimen")
    found = []
    for number, kind in enumerate(kinds):
        if pairs_that_differ(rows, pairs, number, kind.fault, price):
            strengths = np.array([strengths_of(*_difference(rows, *pair, [number])) for pair in pairs])
            found.append(Doubt(kind.fault, np.sqrt(np.mean(strengths**2, axis=0))))
    return found


def repeats_of(refitter: Refitter, groups: Mapping[str, str]) -> list[Pair]:
    """Pairs of training runs with the same motion."""
    found = []
    runs = list(refitter.runs)
    for number, one in enumerate(runs):
        for other in runs[number + 1 :]:
            if groups[one.name] == groups[other.name] and one.end == other.end and one.samples == other.samples:
                difference = one.drive.displacement - other.drive.displacement
                if np.std(difference) < SAME_MOTION * np.std(one.drive.displacement):
                    found.append((one.name, other.name))
    return found


def begun_together(runs: Sequence[ScoredRun], groups: Mapping[str, str]) -> list[ScoredRun]:
    """The runs, of which repeats count from the same sample on: they are compared value by value.

    The warm-up ends with a cycle, which noise tells to a few samples.
    """
    first: dict[tuple[str, str, int], int] = {}
    for run in runs:
        key = groups[run.name], run.end, run.force.size
        first[key] = max(first.get(key, 0), run.first)
    return [replace(run, first=first[groups[run.name], run.end, run.force.size]) for run in runs]


def pairs_that_differ(rows: Rows, pairs: Sequence[Pair], kind: int, fault: ChannelFault, price: float) -> list[Pair]:
    """The pairs of repeats that differ by a ``fault`` of a kind, and not as all the others do from test to test.

    What only goes along with it is no evidence. Where specimens do not differ by such a fault from test to test, it is
    what their numbers do not explain: dry friction that is another one in a single stroke there and back would else
    pass for a drift.
    """
    size = len(rows.shapes[next(iter(rows.residual)), kind])
    differences = {
        pair: _difference(rows, *pair, [kind], None if fault.scatters else _numbers(rows, *pair)) for pair in pairs
    }
    strengths = {pair: strengths_of(*found)[:size] for pair, found in differences.items()}
    found = []
    for pair in pairs:
        others = [strengths[other] for other in pairs if other != pair]
        usual = np.mean(others, axis=0) if others else np.zeros(size)
        if _contrast(*differences[pair], usual, size - fault.free) > price + size - fault.free:
            found.append(pair)
    return found


def outlier(rows: Rows, pair: Pair, pairs: Sequence[Pair], kind: int) -> float:
    """The nats that speak for a difference of a pair of its own, against a draw of the scatter of all pairs.

    A specimen is never twice quite the same. With a normal scatter of unknown size the difference follows Student's t
    of as many degrees of freedom as there are other pairs; a single pair tells nothing of a scatter.
    """
    squares = {}
    for one, other in pairs:
        shapes = (rows.shapes[one, kind] + rows.shapes[other, kind]) / 2.0
        shown = strengths_of(*_difference(rows, one, other, [kind])) @ shapes
        squares[one, other] = float(np.mean(shown**2))
    scatter = sum(square for other, square in squares.items() if other != pair)
    if len(pairs) < 2 or scatter <= 0.0:
        return np.inf
    return 0.5 * len(rows.shapes[pair[0], kind]) * len(pairs) * float(np.log1p(squares[pair] / scatter))


def strengths_by_repeats(
    rows: Rows, run: str, others: Sequence[str], kinds: Sequence[int]
) -> list[tuple[Array, Array]]:
    """The strengths (k,) of faults of a run, together, by which it differs from sound repeats, and half of their 95 %
    intervals (k,).

    No model takes part. Repeats share the run at fault, so that more of them make no interval narrower.
    """
    sizes = [len(rows.shapes[run, kind]) for kind in kinds]
    each = [_difference(rows, run, other, kinds) for other in others]
    strengths = np.sqrt(2.0) * np.mean([strengths_of(*one) for one in each], axis=0)
    widths = np.sqrt(2.0 * np.mean([half_widths(*one, rows.pieces[run]) ** 2 for one in each], axis=0))
    ends = np.cumsum(sizes)[:-1]
    return list(zip(np.split(strengths, ends), np.split(widths, ends), strict=True))


def _difference(
    rows: Rows, one: str, other: str, kinds: Sequence[int], also: Array | None = None
) -> tuple[Array, Array]:
    """The difference (n,) between two repeats over root 2, and the shapes (k, n) of some kinds of faults, others last.

    Whitened by what the shapes leave of the difference: the error of the model cancels in it. What the data sheet
    admits is noise of both.
    """
    found = [(rows.shapes[one, kind] + rows.shapes[other, kind]) / 2.0 for kind in kinds]
    shapes = np.concatenate(found if also is None else [*found, also])
    difference = (rows.residual[one] - rows.residual[other]) / np.sqrt(2.0)
    admitted = rows.admitted.get(one, shapes[:0])
    coefficients = learn_filter(beside(difference, np.concatenate([shapes, admitted])), rows.smallest[one])
    errors = filtered(admitted, coefficients)
    return whiten_effects(filtered(difference, coefficients), errors), whiten_effects(
        filtered(shapes, coefficients), errors
    )


def _numbers(rows: Rows, one: str, other: str) -> Array:
    """What a change of each number of the model does to two repeats (p, n), of the same size."""
    tangents = rows.tangents[one] + rows.tangents[other]
    sizes = np.sqrt(np.mean(tangents**2, axis=1))
    return np.asarray(tangents[sizes > 0.0] / sizes[sizes > 0.0, None])


def _contrast(difference: Array, shapes: Array, usual: Array, size: int) -> float:
    """The nats that the first shapes, so many, explain of a difference beside all others.

    Beyond what nothing and the ``usual`` strengths (k,) of the first ones do.
    """
    rest, others = beside(difference, shapes), shapes[size:]
    lefts = (beside(difference, others), beside(difference - usual @ shapes[: usual.size], others))
    explained = min(float(left @ left) for left in lefts) / max(float(rest @ rest), 1e-300)
    return 0.5 * difference.size * independent_share(rest) * float(np.log(explained))


def plain_noise(look: Look) -> Noise:
    """The same blocks, nothing whitened."""
    return look.noise.with_white(dict.fromkeys(look.noise.filters, 1.0))


def beside(values: Array, shapes: Array) -> Array:
    """What the best strengths of shapes (k, n) leave of values (n,)."""
    return values - strengths_of(values, shapes) @ shapes


def strengths_of(values: Array, shapes: Array) -> Array:
    """The strengths (k,) of shapes (k, n) that explain most of values (n,)."""
    return np.asarray(np.linalg.lstsq(shapes @ shapes.T, shapes @ values, rcond=1e-10)[0], dtype=np.float64)

"""Faults of the force channel of single runs: asserted only with evidence that no law of a specimen can give.

A run may be accused where its repeat disagrees and stands out from the scatter of all repeats; without a repeat, where
two pairs of repeats disagree by the same, or where other, sound runs cover the conditions under which it was made; one
that is the fastest, the largest or the only one at a setting is not. A specimen that changed between two tests, for
good, is the rival of a fault of one run: it shows in all tests before or after, and has the odds of a specimen. Where
no repeat tells, what the same fault would explain in all other runs is the error of the model: nats are divided by this
overdispersion. Samples of what a fault leaves that follow from one another count as fewer.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import ChannelFault
from dashpot.data.correction import Correction
from dashpot.data.run import Run
from dashpot.diagnose.look import Doubt, Look
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.repeats import (
    Key,
    Kind,
    Pair,
    Rows,
    beside,
    outlier,
    pairs_that_differ,
    plain_noise,
    repeats_of,
    rows_of,
)
from dashpot.diagnose.score import RIG_ODDS, Odds
from dashpot.diagnose.whitening import independent_share

Array = NDArray[np.float64]

SLACK = 0.02  # of the range of a condition
NEIGHBOURS = "repeats|other runs under the same conditions do not have it"
Block = tuple[tuple[str, ...], int]  # runs with a fault of the same strengths, number of the kind


@dataclass(frozen=True, eq=False)
class Accused:
    """A fault of one run: its ``strengths``, the nats that it explains, and its evidence.

    ``explained`` is the share by which the square of the residual of all runs grows without it, each run in units of
    what is left of it beside the fault.
    """

    run: str
    kind: Kind
    strengths: Array
    nats: float
    explained: float
    evidence_of: str
    words: str
    probability: float = 1.0

    def judged(self, unexplained: float) -> Accused:
        """The same with its probability, where a share ``unexplained`` of the square of the residual is no noise.

        What the model leaves there may also be all that the fault explains; a repeat needs no model.
        """
        sure = self.words != NEIGHBOURS.partition("|")[2] or not unexplained > 0.0
        return replace(self, probability=1.0 if sure else self.explained / (self.explained + unexplained))

    @property
    def correction(self) -> Correction:
        """What puts the run right."""
        return self.kind.fault.correct(self.strengths.tolist())


def overdispersion(nats: Sequence[float], columns: int) -> float:
    """By how much more than noise faults with so many columns explain of sound data, at least 1.

    The median of ``nats`` over that of noise, of which the doubled nats are distributed as chi-square.
    """
    from scipy.stats import chi2

    return max(1.0, 2.0 * float(np.median(nats)) / float(chi2.median(columns))) if nats else 1.0


def accuse(
    refitter: Refitter,
    look: Look,
    kinds: Sequence[Kind],
    groups: Mapping[str, str],
    measured: Mapping[str, Run],
    doubted: Sequence[Doubt],
    relevance: float,
) -> list[Accused]:
    """The faults of runs that explain most beside the model, one after the other, each with evidence.

    One that is ``doubted`` is expected to be as large as repeats differ.
    """
    rows = rows_of(refitter, look, kinds, look.noise)
    alone = rows_of(refitter, look, kinds, plain_noise(look))
    solver = _Solver(
        rows,
        {
            number: doubt.strengths
            for number, kind in enumerate(kinds)
            for doubt in doubted
            if doubt.fault is kind.fault
        },
    )
    price = Odds(len(rows.shapes)).price("measurement")
    pairs = repeats_of(refitter, groups)
    shares = {key: independent_share(beside(rows.residual[key[0]], shapes)) for key, shapes in rows.shapes.items()}
    chosen: dict[Key, str] = {}
    while True:
        gains = {
            key: shares[key] * solver.gain(key, chosen) - 0.5 * len(shapes) * np.log(shapes.shape[1])
            for key, shapes in rows.shapes.items()
            if key not in chosen
        }
        for key in sorted(gains, key=lambda key: -gains[key]):
            least = max(price, relevance * rows.residual[key[0]].size)
            if gains[key] < least:
                return _accused(solver, chosen, kinds)
            evidence = _evidence(key, chosen, alone, kinds, pairs, groups, measured, price)
            needed = least
            if evidence == NEIGHBOURS:
                needed *= _overdispersion_beside(solver, key, chosen)
            elif kinds[key[1]].fault.alike:
                needed *= _overdispersion_of_alike(refitter, look, kinds[key[1]].fault, rows, key)
            changed = evidence.startswith("repeats") and _changed(solver, key, chosen, shares[key])
            if evidence and gains[key] > needed and not changed:
                chosen[key] = evidence
                break
        else:
            return _accused(solver, chosen, kinds)


def _changed(solver: _Solver, key: Key, chosen: Mapping[Key, str], share: float) -> bool:
    """Whether the fault ``key`` of one run may as well be a specimen that changed between two tests.

    The runs are in the order of the dataset, two of them at least before and after: a change with a single run on one
    side cannot be told from a fault of that run. A kind of fault that other runs have is the channel's. Of the nats a
    ``share`` counts.
    """
    runs, kind = list(solver.rows.residual), key[1]
    if any(other == kind for _, other in chosen):
        return False
    steps = [solver.gain((tuple(runs[place:]), kind), chosen) for place in range(2, len(runs) - 1)]
    lead = solver.gain(key, chosen) - max(steps, default=-np.inf)
    return bool(share * lead < -np.log(RIG_ODDS))


def _overdispersion_beside(solver: _Solver, key: Key, chosen: Mapping[Key, str]) -> float:
    """By how much more than noise the fault ``key`` explains in all other runs, beside it and those chosen."""
    known = {**chosen, key: ""}
    others = [other for other in solver.rows.shapes if other[1] == key[1] and other not in known]
    return overdispersion([solver.gain(other, known) for other in others], len(solver.rows.shapes[key]))


def _overdispersion_of_alike(refitter: Refitter, look: Look, fault: ChannelFault, rows: Rows, key: Key) -> float:
    """By how much more than noise faults like one, that no rig has, explain in the same run."""
    assert fault.alike is not None
    residual = rows.residual[key[0]]
    (first,) = (run.first for run in refitter.runs if run.name == key[0])
    square = float(sum(found @ found for found in rows.residual.values()))
    samples, nats = sum(found.size for found in rows.residual.values()), []
    for shapes in fault.alike(look.view, key[0]):
        seen = look.noise.filter(key[0], look.noise.reduce_shapes(key[0], shapes[:, first:]))
        rest = beside(residual, seen)
        nats.append(-0.5 * samples * float(np.log1p((rest @ rest - residual @ residual) / square)))
    return overdispersion(nats, len(rows.shapes[key]))


def _accused(solver: _Solver, chosen: Mapping[Key, str], kinds: Sequence[Kind]) -> list[Accused]:
    strengths = solver.strengths(list(chosen))
    found = []
    for key, words in chosen.items():
        rest = {other: "" for other in chosen if other != key}
        evidence, _, told = words.partition("|")
        growth = max(solver.square_of(key[0], rest) / solver.square_of(key[0], chosen) - 1.0, 0.0)
        explained = growth * solver.rows.residual[key[0]].size / solver.samples
        nats = solver.gain(key, rest)
        found.append(Accused(key[0], kinds[key[1]], strengths[key], nats, explained, evidence, told))
    return found


def _evidence(
    key: Key,
    chosen: Mapping[Key, str],
    rows: Rows,
    kinds: Sequence[Kind],
    pairs: Sequence[Pair],
    groups: Mapping[str, str],
    measured: Mapping[str, Run],
    price: float,
) -> str:
    """Its kind and its words, parted by a bar; empty where a law of the specimen could do the same."""
    run, kind = key
    if kinds[kind].fault.evidence_of != "repeats":
        return f"{kinds[kind].fault.evidence_of}|{kinds[kind].fault.evidence}"
    demonstrated = pairs_that_differ(rows, pairs, kind, price, kinds[kind].fault.free)
    if kinds[kind].fault.scatters:
        demonstrated = [pair for pair in demonstrated if outlier(rows, pair, pairs, kind) > price]
    differ = [name for pair in demonstrated if run in pair for name in pair if name != run]
    sound = [name for name in differ if all(name != other for other, _ in chosen)]
    if sound:  # a difference is evidence against one of two
        return f"repeats|'{sound[0]}' is the same motion, and its force differs"
    repeated = any(run in pair for pair in pairs)
    if repeated and not differ:
        return ""  # its repeat agrees
    if sum(run not in pair for pair in demonstrated) > 1:
        return "repeats|repeats of other runs differ by the same"
    if repeated:
        return ""  # its repeat is accused
    accused = {groups[name] for name, _ in chosen} | {groups[run]}
    others = [one for name, one in measured.items() if groups.get(name) not in accused and name in groups]
    return NEIGHBOURS if covers(others, measured[run]) else ""


def covers(others: Sequence[Run], run: Run) -> bool:
    """Whether a run lies within what others cover: its deflection, stroke, speed and every number that was set."""
    if len(others) < 2:
        return False
    known = [conditions(other) for other in others]
    for word, value in conditions(run).items():
        values = [one[word] for one in known if word in one]
        if not values:
            return False
        slack = SLACK * max(max(values) - min(values), abs(value) * SLACK)
        if not min(values) - slack <= value <= max(values) + slack:
            return False
    return True


def conditions(run: Run) -> dict[str, float]:
    """Mean deflection, stroke, mean speed and settings of a run, SI."""
    x = run.displacement
    speed = np.sqrt(np.mean(np.square(np.gradient(x, run.sample_time))))
    return {**run.settings, "mean deflection": float(np.mean(x)), "stroke": float(np.ptp(x)), "speed": float(speed)}


class _Solver:
    """Least squares of residuals by tangents of all runs and shapes of single runs, or of several alike.

    Beforehand a fault is thought to be about as large as repeats differ by it, which is ``known`` (k,) by kind, else as
    what is left of its runs: offsets of all runs would else be as good as another curve.
    """

    def __init__(self, rows: Rows, known: Mapping[int, Array]) -> None:
        self.rows, self.known = rows, known
        self.gram: Array = np.sum([tangents @ tangents.T for tangents in rows.tangents.values()], axis=0)
        self.right: Array = np.sum([rows.tangents[run] @ rows.residual[run] for run in rows.residual], axis=0)
        self.square = float(sum(residual @ residual for residual in rows.residual.values()))
        self.samples = sum(residual.size for residual in rows.residual.values())

    def _normal(self, blocks: Sequence[Block]) -> tuple[Array, Array]:
        fixed, shapes = len(self.right), self.rows.shapes
        sizes = [len(shapes[runs[0], kind]) for runs, kind in blocks]
        ends = fixed + np.cumsum([0, *sizes])
        gram, right = np.zeros((ends[-1], ends[-1])), np.zeros(ends[-1])
        gram[:fixed, :fixed], right[:fixed] = self.gram, self.right
        for number, (runs, kind) in enumerate(blocks):
            mine = slice(ends[number], ends[number + 1])
            for run in runs:
                right[mine] += shapes[run, kind] @ self.rows.residual[run]
                gram[mine, :fixed] += shapes[run, kind] @ self.rows.tangents[run].T
            gram[:fixed, mine] = gram[mine, :fixed].T
            for other, (others, other_kind) in enumerate(blocks):
                for run in set(runs) & set(others):
                    gram[mine, ends[other] : ends[other + 1]] += shapes[run, kind] @ shapes[run, other_kind].T
            gram[mine, mine] += np.diag(self._precision(runs, kind))
        return gram, right

    def _precision(self, runs: Sequence[str], kind: int) -> Array:
        """What is known of the strengths (k,) of a fault of some runs beforehand."""
        if kind in self.known:
            return np.asarray(np.maximum(self.known[kind], 1e-300) ** -2.0)
        expected = sum(float(self.rows.residual[run] @ self.rows.residual[run]) for run in runs)
        size = np.sum([np.sum(self.rows.shapes[run, kind] ** 2, axis=1) for run in runs], axis=0)
        return np.asarray(size / max(expected, 1.0))

    def _solved(self, blocks: Sequence[Block]) -> tuple[Array, float]:
        gram, right = self._normal(blocks)
        scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
        inverse = np.linalg.pinv(gram / np.outer(scale, scale), rcond=1e-11, hermitian=True)
        solution = inverse @ (right / scale) / scale
        return solution, self.square - float(solution @ right)

    def gain(self, key: Key | Block, chosen: Iterable[Key]) -> float:
        """The nats that a fault explains beside others that are chosen."""
        known = [_block(one) for one in chosen]
        before, after = self._solved(known)[1], self._solved([*known, _block(key)])[1]
        return 0.5 * self.samples * float(np.log(max(before, 1e-300) / max(after, 1e-300)))

    def square_of(self, run: str, keys: Iterable[Key]) -> float:
        """The square of what the model and faults, found together, leave of the residual of a run."""
        keys = list(keys)
        rest = self.rows.residual[run] - self._solution(keys)[: len(self.right)] @ self.rows.tangents[run]
        for key, strengths in self.strengths(keys).items():
            if key[0] == run:
                rest = rest - strengths @ self.rows.shapes[key]
        return max(float(rest @ rest), 1e-300)

    def strengths(self, keys: Sequence[Key]) -> dict[Key, Array]:
        """The strengths of faults found together."""
        solution, first, found = self._solution(keys), len(self.right), dict[Key, Array]()
        for key in keys:
            count = len(self.rows.shapes[key])
            found[key] = solution[first : first + count]
            first += count
        return found

    def _solution(self, keys: Sequence[Key]) -> Array:
        """How the parameters of the model move, then the strengths of faults found together."""
        return self._solved([_block(key) for key in keys])[0]


def _block(key: Key | Block) -> Block:
    runs, kind = key
    return ((runs,) if isinstance(runs, str) else runs), kind

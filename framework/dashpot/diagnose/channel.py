"""Faults of the force channel of single runs: asserted only with evidence that no law of a specimen can give.

A run may be accused where its repeat disagrees and stands out from the scatter of all repeats; without a repeat, where
two pairs of repeats disagree by the same, or where its conditions lie between those of other, sound runs; one that is
the fastest, the largest, the only one at a setting or at a corner of the conditions is not. A specimen that changed
between two tests, for good, in stiffness or zero, is the rival of such a fault of one run: it shows in all tests before
or after, and has the odds of a specimen. Where no repeat tells, what the same fault would explain in all other runs is
the error of the model: nats are divided by this overdispersion. Samples that follow from one another in what all faults
together leave of a run count as fewer. A fault that acts at rest is one of the channel: what it explains in several
runs is added up.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import ChannelFault
from dashpot.data.correction import Correction
from dashpot.data.run import Run
from dashpot.diagnose.faults_beside import FaultsBeside
from dashpot.diagnose.look import Doubt, Look
from dashpot.diagnose.odds import RIG_ODDS, Odds, share_of_both
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.repeats import (
    SAME_MOTION,
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
    strengths_by_repeats,
)
from dashpot.diagnose.whitening import independent_share

Array = NDArray[np.float64]

Estimate = tuple[Array, Array]  # strengths and half of their 95 % intervals (k,)

NEIGHBOURS = "repeats|other runs under the same conditions do not have it"


@dataclass(frozen=True, eq=False)
class Accused:
    """A fault of one run: its ``strengths``, half of their 95 % intervals (``widths``), the nats, and the evidence.

    ``explained`` is the share by which the square of the residual of all runs grows without it, each run in units of
    what is left of it beside the fault.
    """

    run: str
    kind: Kind
    strengths: Array
    widths: Array
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
        return replace(self, probability=1.0 if sure else share_of_both(self.explained, unexplained))

    @property
    def correction(self) -> Correction:
        """What puts the run right."""
        return self.kind.fault.correct(self.strengths.tolist())

    @property
    def size(self) -> float:
        """The first strength; of hum, told by cosine and sine, the amplitude."""
        return float(np.hypot(*self.strengths[:2])) if self.correction.hum else float(self.strengths[0])

    @property
    def interval(self) -> tuple[float, float]:
        """The 95 % interval of the size; infinite where the run has one piece of whole cycles only."""
        half = float(self.widths[0])
        if self.correction.hum:
            half = float(np.hypot(*(self.strengths[:2] * self.widths[:2]))) / self.size
        return self.size - half, self.size + half


def overdispersion(nats: Sequence[float], columns: int) -> float:
    """By how much more than noise faults with so many columns explain of sound data, at least 1.

    The median of ``nats`` over that of noise, of which the doubled nats are distributed as chi-square.
    """
    from scipy.stats import chi2

    return max(1.0, 2.0 * float(np.median(nats)) / float(chi2.median(columns))) if nats else 1.0


def evidence_in(runs: Sequence[tuple[float, float]]) -> float:
    """The nats of a fault of the channel from its ``nats`` in each run and their overdispersion.

    Noise is another one in every run, so that nats of runs add up where nothing else is left. The error of a model
    comes again: of runs in which it explains more than noise does the best one counts.
    """
    clear = sum(nats for nats, excess in runs if excess <= 1.0)
    return clear + max((nats / excess for nats, excess in runs if excess > 1.0), default=0.0)


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

    One that others make superfluous is dropped again. One that is ``doubted`` is expected to be as large as repeats
    differ.
    """
    rows = rows_of(refitter, look, kinds, look.noise)
    alone = rows_of(refitter, look, kinds, plain_noise(look))
    known = {
        kind: doubt.strengths for kind in range(len(kinds)) for doubt in doubted if doubt.fault is kinds[kind].fault
    }
    solver = FaultsBeside(rows, known, [kind.fault.free for kind in kinds])
    pairs = repeats_of(refitter, groups)
    selection = _Selection(refitter, look, kinds, groups, measured, relevance, alone, pairs, solver)
    chosen: dict[Key, str] = {}
    dropped: set[Key] = set()
    while found := selection.next(chosen, dropped):
        chosen |= found
        while superfluous := selection.superfluous(chosen):
            dropped |= superfluous
            chosen = {key: evidence for key, evidence in chosen.items() if key not in superfluous}
    return _accused(solver, chosen, kinds, _by_repeats(alone, chosen, pairs))


@dataclass(frozen=True, eq=False)
class _Selection:
    """What is asked of faults of runs one after the other; ``alone`` holds the rows as they are, not whitened."""

    refitter: Refitter
    look: Look
    kinds: Sequence[Kind]
    groups: Mapping[str, str]
    measured: Mapping[str, Run]
    relevance: float
    alone: Rows
    pairs: Sequence[Pair]
    solver: FaultsBeside

    def next(self, chosen: Mapping[Key, str], dropped: Set[Key]) -> dict[Key, str]:
        """What explains most beside the faults chosen, with its evidence; empty where nothing is worth it."""
        nats = {key: self.nats(key, chosen) for key in self.solver.rows.shapes.keys() - chosen.keys() - dropped}
        together = [[key for key in keys if nats[key] > 0.0] for keys in self._together(nats)]
        for keys in sorted(together, key=lambda keys: (-sum(nats[key] for key in keys), keys)):
            if sum(nats[key] for key in keys) < self._price:
                break
            proven = {key: evidence for key in keys if (evidence := self._proof(key, chosen))}
            counted = [(nats[key], self._excess(key, evidence, chosen)) for key, evidence in proven.items()]
            if evidence_in(counted) > self._price:
                return proven
        return {}

    def superfluous(self, chosen: Mapping[Key, str]) -> set[Key]:
        """The weakest of the chosen faults, if what they explain beside the others is not worth it."""
        nats = {key: self.nats(key, [other for other in chosen if other != key]) for key in chosen}
        weakest = min(self._together(nats), key=lambda keys: (sum(nats[key] for key in keys), keys), default=[])
        return set(weakest) if sum(nats[key] for key in weakest) < self._price else set()

    def _together(self, keys: Iterable[Key]) -> list[list[Key]]:
        """Faults that are one: what acts at rest is of the channel, in all runs in which it shows."""
        found: dict[Key, list[Key]] = {}
        for key in sorted(keys):
            at_rest = self.kinds[key[1]].fault.evidence_of == "at_rest"
            found.setdefault(("", key[1]) if at_rest else key, []).append(key)
        return list(found.values())

    def nats(self, key: Key, others: Iterable[Key]) -> float:
        """What a fault explains beside others, less what as many numbers explain of noise (Schwarz 1978)."""
        columns, samples = self.solver.rows.shapes[key].shape
        numbers = columns - self.solver.free[key[1]]
        return self._shares[key[0]] * self.solver.gain(key, others) - 0.5 * numbers * float(np.log(samples))

    @cached_property
    def _shares(self) -> dict[str, float]:
        """The share of the samples of each run that are independent in what all faults together leave of its residual.

        One share for all faults of a run, so that they are compared by the same likelihood.
        """
        rows = self.solver.rows
        shapes = {
            run: np.concatenate([each for (name, _), each in rows.shapes.items() if name == run])
            for run in rows.residual
        }
        return {run: independent_share(beside(residual, shapes[run])) for run, residual in rows.residual.items()}

    @cached_property
    def _price(self) -> float:
        return Odds(len(self.solver.rows.shapes)).price("measurement")

    def _proof(self, key: Key, chosen: Mapping[Key, str]) -> str:
        """The evidence of a fault that is large enough; empty where a law of the specimen could do the same."""
        if self.solver.gain(key, chosen) < self.relevance * self.solver.rows.residual[key[0]].size:
            return ""
        if not self.kinds[key[1]].fault.possible(self.solver.strengths([*chosen, key])[key].tolist()):
            return ""
        evidence = _evidence(key, chosen, self.alone, self.kinds, self.pairs, self.groups, self.measured, self._price)
        rival = evidence.startswith("repeats") and self.kinds[key[1]].fault.scatters
        return "" if rival and _changed(self.solver, key, chosen, self._shares[key[0]]) else evidence

    def _excess(self, key: Key, evidence: str, chosen: Mapping[Key, str]) -> float:
        """By how much more than noise such faults explain of sound data, at least 1."""
        fault = self.kinds[key[1]].fault
        if evidence == NEIGHBOURS:
            return _overdispersion_beside(self.solver, key, chosen, self._shares)
        return _overdispersion_of_alike(self.refitter, self.look, fault, self.solver.rows, key) if fault.alike else 1.0


def _changed(solver: FaultsBeside, key: Key, chosen: Mapping[Key, str], share: float) -> bool:
    """Whether the fault ``key`` of one run may as well be a specimen that changed between two tests.

    The runs are in the order of the dataset, two of them at least before and after: a change with a single run on one
    side cannot be told from a fault of that run. A kind of fault that other runs have is the channel's. Of the nats a
    ``share`` counts.
    """
    runs, kind = list(solver.rows.residual), key[1]
    if any(other == kind for _, other in chosen):
        return False
    steps = [solver.gain_of(tuple(runs[place:]), kind, chosen) for place in range(2, len(runs) - 1)]
    lead = solver.gain(key, chosen) - max(steps, default=-np.inf)
    return bool(share * lead < -np.log(RIG_ODDS))


def _overdispersion_beside(
    solver: FaultsBeside, key: Key, chosen: Mapping[Key, str], shares: Mapping[str, float]
) -> float:
    """By how much more than noise the fault ``key`` explains in all other runs, beside it and those chosen.

    Of the nats in each run its share of independent samples counts, as it does of the fault.
    """
    known = {**chosen, key: ""}
    others = [other for other in solver.rows.shapes if other[1] == key[1] and other not in known]
    columns = len(solver.rows.shapes[key]) - solver.free[key[1]]
    return overdispersion([shares[other[0]] * solver.gain(other, known) for other in others], columns)


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


def _by_repeats(rows: Rows, chosen: Mapping[Key, str], pairs: Sequence[Pair]) -> dict[Key, Estimate]:
    """The strengths of faults that sound repeats show: what the model leaves of both runs is no part of them."""
    accused, found = {run for run, _ in chosen}, dict[Key, Estimate]()
    for run in accused:
        keys = [key for key, words in chosen.items() if key[0] == run and words.startswith("repeats")]
        sound = [name for pair in pairs if run in pair for name in pair if name not in accused]
        if keys and sound:
            found |= zip(keys, strengths_by_repeats(rows, run, sound, [kind for _, kind in keys]), strict=True)
    return found


def _accused(
    solver: FaultsBeside, chosen: Mapping[Key, str], kinds: Sequence[Kind], by_repeats: dict[Key, Estimate]
) -> list[Accused]:
    sizes = {key: (size, solver.half_widths(key, chosen)) for key, size in solver.strengths(list(chosen)).items()}
    sizes |= by_repeats
    found = []
    for key, words in chosen.items():
        rest = {other: "" for other in chosen if other != key}
        evidence, _, told = words.partition("|")
        growth = max(solver.square_of(key[0], rest) / solver.square_of(key[0], chosen) - 1.0, 0.0)
        explained = growth * solver.rows.residual[key[0]].size / solver.samples
        nats = solver.gain(key, rest)
        found.append(Accused(key[0], kinds[key[1]], *sizes[key], nats, explained, evidence, told))
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
    demonstrated = pairs_that_differ(rows, pairs, kind, kinds[kind].fault, price)
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
    """Whether a run lies between others: its deflection, stroke, speed and every number that was set.

    All together: the conditions of the run are a mean of those of the others, with weights (linear programming). One
    at a corner, as the largest stroke at the smallest preload, is not; what a law does there no other run tells.
    """
    from scipy.optimize import linprog

    asked = conditions(run)
    words = list(asked)
    known = [found for found in map(conditions, others) if found.keys() >= asked.keys()]
    if len(known) < 2:
        return False
    table = np.array([[one[word] for word in words] for one in known])
    aim = np.array([asked[word] for word in words])
    sizes = np.array([asked["stroke"] if word == "mean deflection" else abs(asked[word]) for word in words])
    slack = SAME_MOTION * np.maximum(np.ptp(table, axis=0), sizes)
    slack[slack == 0.0] = 1.0
    rows = (table / slack).T
    within = np.concatenate([rows, -rows])
    ends = np.concatenate([aim / slack + 1.0, 1.0 - aim / slack])
    weights = np.ones((1, len(known)))
    return bool(linprog(np.zeros(len(known)), within, ends, weights, [1.0], bounds=(0.0, None)).success)


def conditions(run: Run) -> dict[str, float]:
    """Mean deflection, stroke, mean speed and settings of a run, SI."""
    x = run.displacement
    speed = np.sqrt(np.mean(np.square(np.gradient(x, run.sample_time))))
    return {**run.settings, "mean deflection": float(np.mean(x)), "stroke": float(np.ptp(x)), "speed": float(speed)}

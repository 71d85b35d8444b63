"""Evidence against the rig: what a fault of the measurement in all runs does that no law of a specimen would."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.cause import Suspect
from dashpot.diagnose.leftover import SIGNIFICANT
from dashpot.diagnose.look import Look
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.score import Scores, Structure
from dashpot.diagnose.table_rows import is_row
from dashpot.diagnose.term import Given, Model, Term
from dashpot.diagnose.view import ModelView
from dashpot.fit.alike import repeated
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

AGREE = 1.0 / 3.0  # of a strength: how far those of single runs may scatter about the one that all share
FADED = 0.1  # of a record at each end, of which its Hilbert transform knows one side only
FLAT = 0.5  # of the rise of the force: beyond its range a channel rises by less
DECADES, INTERVAL = 2.0, 1.96  # of a number that nothing tells; of a normal distribution, 95 %
FEWEST_PEAKS = 2  # excursions that end at the same value: it comes again


def has_evidence(refitter: Refitter, scores: Scores, number: int) -> bool:
    """Whether a term of a refitted model is a law of the specimen, or a fault of the measurement that shows as one."""
    term = scores.look.model.terms[number]
    if isinstance(term, Given) or term.kind != "measurement":
        return True
    ordinary = term.cause.evidence_of != "data_sheet" and is_ordinary(refitter, scores.look.model, number)
    return not ordinary and TESTS[term.cause.evidence_of](refitter, scores, number)


def is_ordinary(refitter: Refitter, model: Model, number: int) -> bool:
    """Whether a fault is no larger than the data sheet of the force channel admits, so that it is no finding."""
    stated = {word: size for word, size in model.numbers_of(number).items() if word in refitter.sheet}
    return bool(stated) and all(abs(size) <= refitter.sheet[word] for word, size in stated.items())


def is_determined(scores: Scores, number: int) -> bool:
    """Whether no number of a fault of the measurement is at an end of its range or has an interval of ``DECADES``.

    The parameters of the other terms are free.
    """
    look = scores.look
    model, paths = look.model, look.model.coordinates.paths
    if model.terms[number].kind != "measurement":
        return True
    if any(at and path in model.owned[number] for at, path in zip(model.at_bound, paths, strict=True)):
        return False
    columns = scores.columns(Structure())
    gram = scores.gram().block(columns, columns)
    errors = np.sqrt(np.diag(np.linalg.pinv(gram, rcond=1e-12, hermitian=True)))
    for column, error in zip(columns, errors, strict=True):
        k = look.own[column - 1]
        if paths[k] in model.owned[number] and model.coordinates.log[k]:
            deviation = error / scores.scale[column] * model.coordinates.unit[k]
            if 2.0 * INTERVAL * deviation > DECADES * np.log(10.0):
                return False
    return True


def same_in_all_runs(refitter: Refitter, scores: Scores, number: int) -> bool:
    """Whether every number of the term is the same in each group of runs: at every amplitude, preload and speed.

    Most of what tells it has to come from runs whose force is in phase with the deflection: where losses prevail, a
    shift of the phase is that of friction, relaxation or a spring in series as well. What delays the force has to be
    tried at more than one frequency: at a single one every loss does the same.
    """
    look = scores.look
    in_phase = _in_phase(refitter, look)
    for one in _by_group(look, number):
        if one.scatter > AGREE or one.weights @ in_phase < 0.5 * one.weights.sum():
            return False
        if _suspect(look.model, number).measured and not _shows_frequency(refitter, look, one.weights):
            return False
    return True


def follows_the_order(refitter: Refitter, scores: Scores, number: int) -> bool:
    """Whether the force of each group of runs is off by the same for each run before it, whatever motion and load are.

    What a specimen loses from run to run, as by relaxation, is in proportion to its load: that has to be excluded.
    Where runs were repeated later, the repeats have to show it.
    """
    look = scores.look
    again = _missed_by_repeats(refitter, look.model, look.view)
    [moved] = [_numbers(look.model)[path] for path in look.model.owned[number] if path in look.model.coordinates.paths]
    loads = _by_fold(refitter, look, lambda run: float(np.mean(run.force[run.first :])))
    each = _by_group(look, number)
    return abs(again) <= AGREE * abs(moved) and all(one.scatter <= AGREE and not one.may_go_with(loads) for one in each)


def _missed_by_repeats(refitter: Refitter, model: Model, view: ModelView) -> float:
    """By how much the mean residual, N, of repeats grows from a run to the next; 0 where none was made later."""
    forces, above, below = refitter.forces(model.fitted), 0.0, 0.0
    for group in repeated(refitter.runs):
        runs = [refitter.runs[k] for k in group]
        rest = np.array([np.mean((run.force - forces[run.name])[run.first :]) for run in runs])
        places = np.array([view.settings(run.name)["order"] for run in runs])
        away = places - places.mean()
        above, below = above + float(away @ rest), below + float(away @ away)
    return above / below if below > 0.0 else 0.0


@dataclass(frozen=True, eq=False)
class _InGroups:
    """How much each group (groups,) tells of a number, how far it pulls it, and the scatter in parts of the number.

    The number itself has a ``size`` in steps.
    """

    weights: Array
    pulls: Array
    size: float
    scatter: float

    def may_go_with(self, loads: Array) -> bool:
        """Whether the number may be in proportion to ``loads`` (groups,): it is not where these differ by more than a
        third (``AGREE``), and a 95 % interval excludes it.
        """
        told = self.weights > 0.0
        weights, single, loads = self.weights[told], self.pulls[told] / self.weights[told] / self.size, loads[told]
        if told.sum() < 3 or np.ptp(loads) <= AGREE * np.max(np.abs(loads)):
            return True
        away = loads / np.average(loads, weights=weights) - 1.0
        spread = float(weights @ away**2)
        slope = float(weights @ (away * single)) / spread
        rest = single - np.average(single, weights=weights) - slope * away
        error = np.sqrt(float(weights @ rest**2) / (told.sum() - 2) / spread)
        return abs(slope - 1.0) < INTERVAL * error


def _by_group(look: Look, number: int) -> Iterator[_InGroups]:
    """For each number of a term what each group tells of it.

    One step of each group from what all share, less what noise makes of it; the laws are taken as they are.
    """
    total = look.exact.sum(axis=0)
    scale = np.sqrt(np.maximum(np.diag(total), 1e-300))
    grams, gram = look.exact / np.outer(scale, scale), total / np.outer(scale, scale)
    alive = 1 + np.flatnonzero(np.diag(total)[1:] > 0.0)
    rest = _beside(gram, 0, alive)
    squares = np.einsum("i,gij,j->g", rest, grams, rest) / look.samples
    for column in alive:
        path = look.model.coordinates.paths[look.own[column - 1]]
        if path not in look.model.owned[number]:
            continue
        along = _beside(gram, int(column), alive[alive != column])
        weights = np.einsum("i,gij,j->g", along, grams, along)
        pulls = np.einsum("i,gij,j->g", along, grams, rest)
        excess = float(np.sum(pulls**2 / np.maximum(weights, 1e-300) - squares)) / max(float(weights.sum()), 1e-300)
        size = _size_in_steps(look.model, path) * scale[column] / scale[0]
        yield _InGroups(weights, pulls, size, float(np.sqrt(max(excess, 0.0)) / max(abs(size), 1e-300)))


def _shows_frequency(refitter: Refitter, look: Look, weights: Array) -> bool:
    """Whether folds that weigh so much (folds,) tell a delay from a loss angle that does not change with frequency.

    A delay moves the force along the velocity, such an angle along the deflection, each frequency shifted by a quarter
    of its period (Hilbert transform). They have to differ by more than a delay may scatter between runs.
    """
    from scipy.signal import hilbert
    from scipy.signal.windows import tukey

    squares = np.zeros((2, 2))
    for run in refitter.runs:
        first = 0 if is_row(run) else run.first  # a row is one period beside the warm-up
        path, velocity = run.drive.displacement[first:], run.drive.velocity[first:]
        pair = np.array([velocity - velocity.mean(), hilbert(path - path.mean()).imag]) * tukey(path.size, 2.0 * FADED)
        gram = pair @ pair.T
        at = list(look.folds.parts[run.name][1])
        squares += float(weights[at].mean()) * gram / max(float(gram[0, 0]), 1e-300)
    along = float(squares[0, 1]) ** 2
    return float(squares[0, 0] * squares[1, 1]) - along > AGREE**2 * along


def _in_phase(refitter: Refitter, look: Look) -> Array:
    """For each fold (folds,) the share of its runs whose loss angle is below 45 degrees."""
    return _by_fold(refitter, look, lambda run: float(_is_in_phase(run)))


def _is_in_phase(run: ScoredRun) -> bool:
    """Whether the loss angle of a run is below 45 degrees.

    Of a sweep or a random motion it is that of the least squares of the force over deflection, velocity and
    acceleration: what follows the velocity is lost, what follows the other two is stored.
    """
    drive = run.drive
    motion = np.array([drive.velocity, drive.displacement, drive.acceleration])[:, run.first :]
    motion = motion - motion.mean(axis=1, keepdims=True)
    motion /= np.maximum(motion.std(axis=1, keepdims=True), 1e-300)
    parts = motion * np.linalg.lstsq(motion.T, run.force[run.first :], rcond=None)[0][:, None]
    return bool(np.std(parts[0]) < np.std(parts[1] + parts[2]))


def _by_fold(refitter: Refitter, look: Look, of: Callable[[ScoredRun], float]) -> Array:
    """The mean of something of runs over those of each fold (folds,)."""
    found = np.zeros((2, len(look.folds.names)))
    for run in refitter.runs:
        found[:, list(look.folds.parts[run.name][1])] += np.array([[of(run)], [1.0]])
    means: Array = found[0] / np.maximum(found[1], 1.0)
    return means


def _beside(gram: Array, column: int, others: NDArray[np.intp]) -> Array:
    """A column as combination (c,) of all of them, with what others can make of it taken out."""
    found = np.eye(len(gram))[column]
    found[others] -= np.linalg.lstsq(gram[np.ix_(others, others)], gram[others, column], rcond=1e-9)[0]
    return found


def _size_in_steps(model: Model, path: str) -> float:
    """A number of a model in natural steps of its coordinate, with its sign."""
    k = model.coordinates.paths.index(path)
    size = 1.0 if model.coordinates.log[k] else model.point[k]
    return float(size / model.coordinates.unit[k])


def ends_at_one_value(refitter: Refitter, scores: Scores, number: int) -> bool:
    """Whether the measured force stays at its extreme, excursion after excursion, while the specimen's goes on.

    It stays there on the way out and on the way back: dry friction, which also ends at one value, leaves it when the
    motion turns. Beyond the end of its range a channel shows nothing but noise. A force that stays at zero is none
    either: a specimen that has lost contact does the same.
    """
    model = scores.look.model
    limits = {path.rpartition(".")[2]: slot for path, slot in _numbers(model).items() if path in model.owned[number]}
    term = model.terms[number]
    rest = [other for other in model.terms if other is not term]
    free = refitter.forces(refitter.without(model, rest))
    noise = np.sqrt(np.mean([np.mean((run.force - free[run.name]) ** 2) for run in refitter.runs]))
    if any(abs(level) < INTERVAL * noise for level in limits.values()):
        return False
    found, peaks = [], 0
    for word, level in limits.items():
        side = 1.0 if word == "largest" else -1.0
        for run in refitter.runs:
            if np.max(side * (run.force - level)) > SIGNIFICANT * refitter.noise:
                return False
            beyond = side * (free[run.name] - level) > 0.0
            beyond[: run.first] = False
            peaks += int(np.sum(beyond[1:] & ~beyond[:-1]))
            found.append(np.array([free[run.name], run.force, side * run.drive.velocity])[:, beyond])
    seen, shown, outward = np.concatenate(found, axis=1)
    ways = outward > 0.0, outward < 0.0
    return peaks >= FEWEST_PEAKS and all(_slope(seen[way], shown[way], np.abs(outward[way])) < FLAT for way in ways)


def _slope(x: Array, y: Array, weights: Array) -> float:
    """The slope of y over x; 1 where it is not determined."""
    if not x.size or not weights.any():
        return 1.0
    away = x - np.average(x, weights=weights)
    spread = float(weights @ away**2)
    return float(weights @ (away * y)) / spread if spread > 0.0 else 1.0


def _numbers(model: Model) -> Mapping[str, float]:
    return {slot.path: slot.value.number for slot in model.fitted.slots()}


def is_within_the_data_sheet(refitter: Refitter, scores: Scores, number: int) -> bool:
    """Whether the data sheet of the force channel admits what was found."""
    model = scores.look.model
    quantity = _suspect(model, number).quantity
    return model.numbers_of(number)[quantity] <= refitter.sheet.get(quantity, 0.0)


def _suspect(model: Model, number: int) -> Suspect:
    term = model.terms[number]
    assert isinstance(term, Term)
    return term.suspect


def told(term: Term) -> str:
    """The evidence of an accepted fault in words."""
    return WORDS.get(term.cause.evidence_of, "")


Test = Callable[[Refitter, Scores, int], bool]
TESTS: Mapping[str, Test] = {
    "phase": same_in_all_runs,
    "order": follows_the_order,
    "range": ends_at_one_value,
    "data_sheet": is_within_the_data_sheet,
}
WORDS = {
    "phase": "it is the same in every run, at every amplitude, preload and speed",
    "order": "each run is off by the same from the one before, whatever its motion is",
    "range": "the force ends at one value, excursion after excursion",
    "data_sheet": "it is within the data sheet of the channel",
}

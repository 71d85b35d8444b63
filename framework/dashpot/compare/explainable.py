"""The explainable error: how much of the error any model of the past motion could explain.

A reference of the field, trained on the training runs and judged on the held-out ones: ridge regression on stop
operators, relaxing states, powers of velocity, polynomials and the conditions of the runs; where scikit-learn is
installed also boosted trees on what it leaves. Strength and kind are chosen by cross-validation inside the training
runs, repeats together. Source: Hastie, Tibshirani, Friedman, The Elements of Statistical Learning, 3.4, 7.10 and 10.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dashpot.compare.boosting import Boosted, boost
from dashpot.compare.features import columns_of
from dashpot.compare.motion import Grid, Memory, grid_of, remember
from dashpot.compare.ridge import Ridge, fit_ridge
from dashpot.data.steady import STEADY
from dashpot.fit.algebra import single_threaded_algebra
from dashpot.fit.api import Setting
from dashpot.fit.scored import ScoredRun

Array = NDArray[np.float64]

HANDFUL = 5  # groups of training runs; with fewer it is said how few there are
FEWEST_FOLDED = 4  # groups that are left out in turn; with fewer, pieces of the runs are
PIECES = 4
MOST_FOLDS = 8
TRAINED = 40_000  # samples in all
JUDGED = 400_000
# settings that say how the specimen was moved, which a model reads from the motion itself
OF_THE_MOTION = ("warm_up", "amplitude", "preload", "start", "stop", "frequency", "speed", "velocity", "duration")
OF_THE_RIG = ("displacement", "velocity", "acceleration", "force")


@dataclass(frozen=True)
class Explainable:
    """The error in N that a general model leaves on the training runs and on the held-out runs.

    ``by`` is "ridge" or "boosting"; all are None where there is no such model, ``reason`` says why.
    ``cross_validated`` is its error on training runs left out in turn, ``left_out`` the same where what the others
    hardly tell is not put to the test; ``remarks`` tell how far the numbers can be trusted. ``per_run`` holds the error
    on every run.
    """

    train: float | None = None
    held_out: float | None = None
    cross_validated: float | None = None
    left_out: float | None = None
    by: str | None = None
    per_run: Mapping[str, float] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    reason: str = ""

    @property
    def unseen(self) -> float | None:
        """The error on runs it did not see: held-out runs, or training runs left out in turn where there are none."""
        return self.cross_validated if self.held_out is None else self.held_out

    def as_dict(self) -> dict[str, Any]:
        """The entry of result files, in N."""
        numbers = {
            "held_out": self.held_out,
            "train": self.train,
            "cross_validated": self.cross_validated,
            "left_out": self.left_out,
        }
        return {
            **numbers,
            "by": self.by,
            "per_run": dict(self.per_run),
            "remarks": list(self.remarks),
            "reason": self.reason or None,
        }


@dataclass(frozen=True, eq=False)
class Record:
    """A run for a general model: its group of repeats, and its settings and channels (numbers or (n,) each)."""

    run: ScoredRun
    group: str
    conditions: Mapping[str, float | Array]


@dataclass(frozen=True, eq=False)
class _Sampled:
    """Some samples of a run: its memories, conditions (n, k) and force (n,), and where in the run they are (0 to 1)."""

    memory: Memory
    conditions: Array
    force: Array
    place: Array

    @property
    def columns(self) -> Array:
        return columns_of(self.memory, self.conditions).values

    @property
    def leaves(self) -> Array:
        """What a tree may ask for."""
        return np.hstack([self.memory.together(), self.conditions])


def explainable_error(setting: Setting, seed: int = 0, trees: bool = True) -> Explainable:
    """The explainable error of a dataset made ready; without numbers where a run moves several nodes.

    Without ``trees`` only the ridge regression is asked.
    """
    runs = {run.name: run for run in setting.dataset.runs}
    several = [name for name, run in setting.scored.items() if len(run.motions) > 1 or (run.whole and run.whole.loads)]
    if several:
        return Explainable(
            reason=f"'{several[0]}' moves or loads several nodes; the general model knows one "
            "displacement and one force"
        )
    if any(run.kind == STEADY for run in setting.scored.values()):
        return Explainable(reason="rows of a table hold the fundamental alone, to which no general model can be fitted")
    records = {
        name: Record(run, runs[name].cluster, _conditions(runs[name].settings, runs[name].channels))
        for name, run in setting.scored.items()
    }
    split = setting.split
    return explain([records[name] for name in split.train], [records[name] for name in split.held_out], seed, trees)


@single_threaded_algebra
def explain(train: Sequence[Record], held_out: Sequence[Record], seed: int = 0, trees: bool = True) -> Explainable:
    """Train a general model on some runs and judge it on all; nothing is learned from the held-out ones."""
    if not any(np.ptp(each.run.drive.displacement) > 0.0 for each in train):
        return Explainable(reason="nothing moves in the training runs")
    view = _view(train)
    rng = np.random.default_rng(seed)
    taught = [view.sampled(each, TRAINED // len(train), rng) for each in train]
    folds, remark = _folds([each.group for each in train], taught, rng)
    weights = np.concatenate([np.full(each.force.size, 1.0 / each.force.size) for each in taught]) / len(taught)
    force = np.concatenate([each.force for each in taught])
    families = columns_of(taught[0].memory, taught[0].conditions).families
    ridge = fit_ridge((each.columns for each in taught), force, weights, folds, families)
    left = force - ridge.unseen
    boosted = boost([each.leaves for each in taught], left, weights, folds, seed) if trees else None
    model = _Model(view, ridge, boosted)
    judged = JUDGED // (len(train) + len(held_out))
    errors = {each.run.name: model.error(each, judged, rng) for each in (*train, *held_out)}
    remarks = [remark, *_thinned((*train, *held_out), judged)]
    return Explainable(
        train=_pooled(errors[each.run.name] for each in train),
        held_out=_pooled(errors[each.run.name] for each in held_out) if held_out else None,
        cross_validated=ridge.error * (1.0 if boosted is None else boosted.left),
        left_out=ridge.left_out * (1.0 if boosted is None else boosted.left),
        by="ridge" if boosted is None else "boosting",
        per_run=errors,
        remarks=tuple(filter(None, remarks)),
    )


@dataclass(frozen=True, eq=False)
class _View:
    """How a run is seen: the grid of memories, and mean, deviation and range of each condition in training."""

    grid: Grid
    conditions: Mapping[str, tuple[float, float, float, float]]

    def sampled(self, record: Record, most: int, rng: np.random.Generator) -> _Sampled:
        """At most so many samples after the warm-up, one at random from each of equal stretches."""
        run = record.run
        edges = np.linspace(run.first, run.force.size, min(run.samples, most) + 1)
        rows = np.floor(edges[:-1] + rng.random(edges.size - 1) * np.diff(edges)).astype(np.intp)
        if run.samples <= most:
            rows = np.arange(run.first, run.force.size)
        memory = remember(run.drive, self.grid).at(rows)
        place = (rows - run.first) / run.samples
        return _Sampled(memory, self._standardised(record)[rows], run.force[rows], place)

    def _standardised(self, record: Record) -> Array:
        # what goes beyond the training runs is taken as their nearest value
        values = np.zeros((record.run.force.size, len(self.conditions)))
        for k, (name, (mean, deviation, low, high)) in enumerate(self.conditions.items()):
            values[:, k] = (np.clip(record.conditions.get(name, mean), low, high) - mean) / deviation
        return values


@dataclass(frozen=True, eq=False)
class _Model:
    view: _View
    ridge: Ridge
    boosted: Boosted | None

    def error(self, record: Record, most: int, rng: np.random.Generator) -> float:
        seen = self.view.sampled(record, most, rng)
        force = self.ridge.predict(seen.columns)
        if self.boosted is not None:
            force = force + self.boosted.predict(seen.leaves)
        return float(np.sqrt(np.mean((seen.force - force) ** 2)))


def _view(train: Sequence[Record]) -> _View:
    common = set.intersection(*(set(each.conditions) for each in train))
    told = {}
    for name in sorted(common):
        values = [np.atleast_1d(np.asarray(each.conditions[name], dtype=float)) for each in train]
        mean = float(np.mean([np.mean(each) for each in values]))
        deviation = float(np.sqrt(np.mean([np.mean((each - mean) ** 2) for each in values])))
        low, high = min(float(each.min()) for each in values), max(float(each.max()) for each in values)
        if np.isfinite(deviation) and high - low > 1e-9 * max(abs(low), abs(high)):
            told[name] = (mean, deviation, low, high)
    return _View(grid_of([each.run.drive for each in train]), told)


def _conditions(settings: Mapping[str, float], channels: Mapping[str, Array]) -> dict[str, float | Array]:
    chosen = {name: value for name, value in settings.items() if name not in OF_THE_MOTION}
    own = {name: values for name, values in channels.items() if name.split("@")[0] not in OF_THE_RIG}
    return {**chosen, **{name: _known(name, values) for name, values in own.items()}}


def _known(name: str, values: Array) -> float | Array:
    """Of a further force or motion, such as a normal force, the mean alone, as a network knows it.

    As a signal it may be an answer of the specimen.
    """
    return float(np.mean(values)) if name.split("@")[0].endswith(OF_THE_RIG) else values


def _folds(groups: Sequence[str], taught: Sequence[_Sampled], rng: np.random.Generator) -> tuple[NDArray[np.intp], str]:
    """The fold of every training sample, and what is to be said about it."""
    names = [str(name) for name in rng.permutation(sorted(set(groups)))]
    if len(names) < FEWEST_FOLDED:
        folds = np.concatenate([np.minimum((each.place * PIECES).astype(np.intp), PIECES - 1) for each in taught])
        return folds, (
            f"Only {len(names)} independent training run{'s' * (len(names) > 1)}: the general model was "
            f"chosen on quarters of runs left out in turn, which says little about other runs."
        )
    fold_of = {name: number % min(len(names), MOST_FOLDS) for number, name in enumerate(names)}
    folds = np.concatenate(
        [np.full(each.force.size, fold_of[group]) for group, each in zip(groups, taught, strict=True)]
    )
    few = f"Only {len(names)} independent training runs are behind the general model." if len(names) < HANDFUL else ""
    return folds, few


def _thinned(records: Sequence[Record], most: int) -> list[str]:
    longest = max(each.run.samples for each in records)
    if longest <= most:
        return []
    return [f"Its RMSE is that of {most} of up to {longest} samples of each run, spread evenly."]


def _pooled(errors: Iterable[float]) -> float:
    return float(np.sqrt(np.mean(np.square(list(errors)))))

"""Fitting a structure to whitened misfits, and what its terms do to the force."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.table_rows import shown
from dashpot.diagnose.term import (
    Given,
    Model,
    Part,
    Term,
    extended,
    given_branches,
    inherited,
    numbers_of,
    reduced,
)
from dashpot.diagnose.view import ModelView
from dashpot.diagnose.whitening import Noise
from dashpot.fit.coordinates import search_coordinates, with_point
from dashpot.fit.linear import Held, linearise
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import Sizes, natural_sizes, with_ranges
from dashpot.fit.refine import Outcome, refine
from dashpot.fit.scored import ScoredRun
from dashpot.fit.shelf import Shelf
from dashpot.kernel.columns import Rows
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element
from dashpot.model.network import NetworkSpec
from dashpot.text.problem import InputError

Array = NDArray[np.float64]

STEPS, TOLERANCE = 60, 1e-5
KEPT_BYTES = 50e6  # of columns
TEXTS = 64  # of structures that are known: those of a model and of what is tried beside it
TRIAL_TOLERANCE = 1e-3  # a trial is only compared
FIRST_STEPS = 4  # from each of two starts, before the one that misses less goes on alone
SHARES = (1.0, 0.3)  # of what the linear step foresees: starts on the way to it
Written = tuple[NetworkSpec, Mapping[Part, tuple[str, ...]]]  # a network, and what each term brought


@dataclass(eq=False)
class Kept:
    """Columns that depend on the motion alone, by what they are of, as long as there is room."""

    columns: dict[tuple[object, ...], NDArray[np.float32]] = field(default_factory=dict)
    nbytes: int = 0

    def keep(self, key: tuple[object, ...], rows: Array) -> None:
        """Keep rows in single precision; those of an earlier key stay."""
        if self.nbytes < KEPT_BYTES and key not in self.columns:
            self.columns[key] = rows.astype(np.float32)
            self.nbytes += self.columns[key].nbytes


@dataclass(frozen=True, eq=False)
class Refitter:
    """What every refit needs: the training runs, the elements, and the data sheets of the force channel by run.

    ``noise`` is the noise floor of the records in N, infinite where nothing tells it.
    ``written`` keeps the last texts of structures, ``reduced`` columns that depend on the motion alone, ``able`` the
    forms of causes that could be tried, ``shelf`` what is prepared of the runs. ``missing`` says whether it is certain
    that something is missing in the diagnosed network.
    """

    runs: Sequence[ScoredRun]
    elements: Mapping[str, type[Element]]
    sensors: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    jobs: int = 1
    watch: Callable[[float], None] = lambda done: None
    written: dict[tuple[frozenset[str], tuple[Term, ...]], Written] = field(default_factory=dict)
    reduced: Kept = field(default_factory=Kept)
    able: set[object] = field(default_factory=set)
    shelf: Shelf[Rows] = field(default_factory=Shelf)
    missing: bool = False
    noise: float = np.inf

    @cached_property
    def sizes(self) -> Sizes:
        """Natural sizes in the runs, from which numbers without bounds get theirs."""
        return natural_sizes(self.runs)

    @cached_property
    def sheet(self) -> dict[str, float]:
        """What the data sheets of the force channel admit at most in any run, in SI, by quantity."""
        found: dict[str, float] = {}
        for quantity, most in (entry for sheet in self.sensors.values() for entry in sheet.items()):
            found[quantity] = max(most, found.get(quantity, most))
        return found

    def refit(self, model: Model, terms: Sequence[Part], noise: Noise, change: Array | None = None) -> Model:
        """A model with other terms, all numbers fitted.

        It starts from the present numbers, those of new terms, and, with the natural steps ``change`` (p,) that the
        linear step foresees, from places on the way there, whichever misses least; where numbers are at an end of
        their range, once more from those of the file. Raises InputError for a term that cannot be written into the
        network.
        """
        starts = [self._start(model, terms, model.fitted)]
        fresh = [term for term in terms if term not in model.terms]
        if change is not None and fresh:
            for share in SHARES:
                part = [term if term in model.terms else term.scaled(share) for term in terms]
                with suppress(InputError):  # a cause may have no text for a small share
                    starts.append(self._start(model, part, model.moved(share * change)))
        declared, owned, start = starts[0]
        objective = self._objective(start, noise.counted)
        points = [search_coordinates(one) for _, _, one in starts]
        places = np.array([each.to_values(each.start)[0] for each in points])
        losses = objective.losses(places)
        best = int(np.argmin(np.where(np.isfinite(losses), losses, np.inf)))
        chosen = [starts[best]]
        if fresh and model.at_bound.any():
            chosen.append(self._start(model, terms, self._freed(model)))
        if len(chosen) == 1:
            return self._fitted(model.base, tuple(terms), *chosen[0], noise, STEPS, TRIAL_TOLERANCE)
        trials = [self._fitted(model.base, tuple(terms), *one, noise, FIRST_STEPS, TRIAL_TOLERANCE) for one in chosen]
        ends = objective.losses(np.array([trial.values for trial in trials]))
        ahead = trials[int(np.argmin(np.where(np.isfinite(ends), ends, np.inf)))]
        if ahead.outcome is not Outcome.STEPS_SPENT:
            return ahead
        rest = STEPS - FIRST_STEPS
        return self._fitted(
            model.base, ahead.terms, ahead.declared, ahead.owned, ahead.fitted, noise, rest, TRIAL_TOLERANCE
        )

    def fit(self, model: Model, noise: Noise) -> Model:
        """The same structure, its numbers fitted under another noise."""
        return self._fitted(model.base, model.terms, model.declared, model.owned, model.fitted, noise)

    def linearise(self, model: Model, noise: Noise) -> tuple[dict[str, Array], dict[str, Array]]:
        """Whitened residual (kept,) and tangents (p, kept) by run; a number at its bound can absorb nothing."""
        linear = linearise(Held(self._objective(model.fitted, noise)), model.coordinates, model.point)

        def kept(number: int, rows: Array) -> tuple[str, Array]:
            rows[1:][model.at_bound] = 0.0
            return self.runs[number].name, rows

        found = dict(linear.each(kept))
        return {name: -rows[0] for name, rows in found.items()}, {name: rows[1:] for name, rows in found.items()}

    def forces(self, network: NetworkSpec) -> dict[str, Array]:
        """The force (n,) in N that a network with its numbers shows, by run."""
        objective = Objective(compile_network(network), self.runs, self.jobs, shelf=self.shelf)
        found = objective.forces(objective.network.start)
        return {run.name: force[0] for run, force in zip(self.runs, found, strict=True)}

    def columns(self, candidate: Candidate, view: ModelView, run: ScoredRun, noise: Noise) -> NDArray[np.floating]:
        """The columns (places, kept) of a candidate on a run, reduced; those of the motion alone are kept in memory."""
        if (known := self.reduced.columns.get(_key(candidate, run))) is not None:
            return known
        found = noise.reduce(run.name, shown(run, np.atleast_2d(candidate.suspect.columns(view, run.name))))
        if candidate.suspect.of_motion:
            self.reduced.keep(_key(candidate, run), found)
        return found

    def without(self, model: Model, terms: Sequence[Part]) -> NetworkSpec:
        """The network of a model with some of its terms only, all numbers as they are."""
        return self._start(model, self.writable(model, terms), model.fitted)[2]

    def refusal(self, model: Model, terms: Sequence[Part]) -> str:
        """Why some terms cannot be written one after the other; nothing where they can."""
        try:
            self._written(model.base, terms)
        except InputError as error:
            return str(error)
        return ""

    def writable(self, model: Model, terms: Sequence[Part]) -> tuple[Part, ...]:
        """Those of some terms that can be written without the others: one that changes another goes with it."""
        found: tuple[Part, ...] = tuple(term for term in terms if isinstance(term, Given))
        for term in (term for term in terms if isinstance(term, Term)):
            with suppress(InputError):
                self._written(model.base, (*found, term))
                found = (*found, term)
        return found

    def _freed(self, model: Model) -> NetworkSpec:
        """The fitted network of a model; numbers at an end of their range, where little moves them, as in its file."""
        stuck = {path for path, at in zip(model.coordinates.paths, model.at_bound, strict=True) if at}
        declared = {slot.path: slot.value.number for slot in with_ranges(model.declared, self.sizes).slots()}
        freed = stuck & set(declared)
        return model.fitted.with_values(
            {
                slot.path: replace(slot.value, number=declared[slot.path])
                for slot in model.fitted.slots()
                if slot.path in freed
            }
        )

    def _start(
        self, model: Model, terms: Sequence[Part], numbers: NetworkSpec
    ) -> tuple[NetworkSpec, tuple[tuple[str, ...], ...], NetworkSpec]:
        declared, brought = self._written(model.base, terms)
        owned = tuple(brought[term] for term in terms)
        return declared, owned, inherited(declared, owned, terms, replace(model, fitted=numbers), self.sizes)

    def _written(self, base: NetworkSpec, terms: Sequence[Part]) -> Written:
        """The network with some terms, and the paths of the numbers that each of them brought."""
        given = tuple(term for term in terms if isinstance(term, Given))
        causes = tuple(term for term in terms if isinstance(term, Term))
        key = frozenset(one.branch for one in given), causes
        found = self.written.pop(key, None) or self._extended(base, given, causes)
        self.written[key] = found
        while len(self.written) > TEXTS:
            del self.written[next(iter(self.written))]
        return found

    def _extended(self, base: NetworkSpec, given: tuple[Given, ...], causes: tuple[Term, ...]) -> Written:
        if causes:
            before, brought = self._written(base, (*given, *causes[:-1]))
            declared, mine = extended(before, causes[-1], self.elements)
            return declared, {**brought, causes[-1]: mine}
        gone = [one.branch for one in given_branches(base) if one not in given]
        return reduced(base, gone, self.elements), {one: numbers_of(base, one) for one in given}

    def _objective(self, network: NetworkSpec, noise: Noise) -> Objective:
        return Objective(compile_network(network), self.runs, self.jobs, noise, shelf=self.shelf)

    def _fitted(
        self,
        base: NetworkSpec,
        terms: tuple[Part, ...],
        declared: NetworkSpec,
        owned: tuple[tuple[str, ...], ...],
        start: NetworkSpec,
        noise: Noise,
        steps: int = STEPS,
        tolerance: float = TOLERANCE,
    ) -> Model:
        coordinates = search_coordinates(start)
        objective = self._objective(start, noise.counted)
        found = refine(objective, coordinates, coordinates.start, steps, tolerance, thorough=False)
        fitted = with_point(start, coordinates, found.point)
        return Model(base, terms, declared, owned, fitted, coordinates, found.point, found.outcome)


def _key(candidate: Candidate, run: ScoredRun) -> tuple[object, ...]:
    return candidate.cause, candidate.suspect.form, candidate.suspect.grid, candidate.twin, run.name

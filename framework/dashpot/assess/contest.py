"""Refitting extended networks: the finalists of the screen become real models and are judged as such."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.erring import beside_sensors
from dashpot.assess.mend import Mend, corrected, make_mend, mended, relocated, reshaped, shape_rows
from dashpot.assess.noise import NoiseModel, flat_noise
from dashpot.assess.projection import SparseRows, normal_equations, project_out, stack
from dashpot.assess.screen import Finding, judge
from dashpot.assess.view import ModelView, view_of
from dashpot.fit.coordinates import Coordinates, search_coordinates, with_point
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.refine import Outcome, linearise, refine
from dashpot.fit.scored import ScoredRun
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element
from dashpot.model.network import Branch, NetworkSpec, Value
from dashpot.model.reading import parse_network
from dashpot.text.problem import InputError

Array = NDArray[np.float64]

STEPS = 60
MOST_ROUNDS = 8  # of mends
TOLERANCE = 1e-5
NEARLY = 1e-3  # of the loss in a step: near enough for a place to start from
SHARES = (1.0, 0.3, 0.1)  # of what the screen foresees
AT_END = 1e-3  # of a range
DWINDLED = 0.03  # of the number in the file, where what is searched is a logarithm: zero is infinitely far
ASTRAY = 3.0  # times the number in the file, or a third of it
REACH = 10.0  # so many times as much as in its last step a refit may still gain


@dataclass(frozen=True, eq=False)
class Model:
    """A fitted network: its declaration without and with fitted numbers, and what it costs.

    ``chi_square`` is the sum of squared whitened misfits on the training runs; ``mends`` are faults taken out of these.
    """

    declared: NetworkSpec
    fitted: NetworkSpec
    coordinates: Coordinates
    point: Array
    chi_square: float
    outcome: Outcome
    mends: tuple[Mend, ...] = ()

    @property
    def numbers(self) -> int:
        """How many numbers were found from the data."""
        return self.point.size + sum(mend.strengths.size for mend in self.mends)

    @property
    def at_end(self) -> NDArray[np.bool_]:
        """Which coordinates (p,) are at an end of their range, or dwindled on the way to zero."""
        margin = AT_END * (self.coordinates.high - self.coordinates.low)
        file = {slot.path: slot.value.number for slot in self.declared.slots()}
        numbers = zip(self.coordinates.paths, self.coordinates.log, self.coordinates.numbers(self.point), strict=True)
        dwindled = [log and number < DWINDLED * file.get(path, 0.0) for path, log, number in numbers]
        ended = (self.point <= self.coordinates.low + margin) | (self.point >= self.coordinates.high - margin)
        return ended | np.array(dwindled, dtype=bool)

    @property
    def revived(self) -> dict[str, Value]:
        """The numbers that are at an end of their range by path, as they stand in the file."""
        return self._as_in_file(self.at_end)

    @property
    def astray(self) -> dict[str, Value]:
        """The numbers far from those of the file by path, as they stand there: what is missing may have driven them."""
        file = {slot.path: slot.value.number for slot in self.declared.slots()}
        numbers = zip(self.coordinates.paths, self.coordinates.log, self.coordinates.numbers(self.point), strict=True)
        far = [
            log and path in file and not 1.0 / ASTRAY < number / file[path] < ASTRAY for path, log, number in numbers
        ]
        return self._as_in_file(self.at_end | np.array(far, dtype=bool))

    def _as_in_file(self, chosen: NDArray[np.bool_]) -> dict[str, Value]:
        file = {slot.path: slot.value.number for slot in self.declared.slots()}
        slots = {slot.path: slot.value for slot in self.fitted.slots()}
        paths = [path for path, wanted in zip(self.coordinates.paths, chosen, strict=True) if wanted and path in file]
        return {path: replace(slots[path], number=file[path]) for path in paths}

    @property
    def values(self) -> Array:
        """All slots (slots,) in SI."""
        return self.coordinates.to_values(self.point)[0]


@dataclass(frozen=True, eq=False)
class Bench:
    """What every refit needs; ``sensors`` is the data sheet of the force channel by run.

    ``unseen`` are runs that no refit sees, but on which a fault that it finds in all runs has to be known, too.
    ``watch`` hears how much of a long computation is done. ``given`` are the paths of the numbers of the network that
    is diagnosed, None for all that a model has; ``forces`` (n,) N by run those of its fit, where there are sensors.
    """

    runs: Sequence[ScoredRun]
    elements: Mapping[str, type[Element]]
    sensors: Mapping[str, Mapping[str, float]]
    jobs: int = 1
    unseen: Sequence[ScoredRun] = ()
    watch: Callable[[float], None] = lambda done: None
    given: Collection[str] | None = None
    forces: Mapping[str, Array] = field(default_factory=dict)

    def view(self, model: Model) -> ModelView:
        """A model on all runs as causes see it."""
        return view_of(model.fitted, [*self.runs, *self.unseen], self.elements, self.jobs)

    def fit(
        self,
        declared: NetworkSpec,
        start: NetworkSpec,
        noise: NoiseModel | None,
        mends: Sequence[Mend] = (),
        beat: float = np.inf,
        tolerance: float = TOLERANCE,
    ) -> Model:
        """Refit a network from the numbers of ``start``: to whitened misfits, or to the plain error without a noise.

        The strengths of mends and the numbers of the network take turns, each step of the former foreseeing the latter,
        as long as chi square falls; the best turn counts. A network that will not come down to the chi square ``beat``
        is left behind half way, unless its mends may still move to other places. The first turn ends with a step that
        lowers the loss by less than ``tolerance`` of it.
        """
        reach = np.inf if any(mend.roams for mend in mends) else beat
        turns = [self._fit(declared, start, noise, tuple(mends), reach, tolerance)]
        falls = bool(mends) and turns[0].outcome is not Outcome.LEFT_BEHIND
        while falls and len(turns) <= MOST_ROUNDS:
            turns.append(self._fit(declared, turns[-1].fitted, noise, self._strengthened(turns[-1], noise)))
            falls = turns[-1].chi_square < (1.0 - TOLERANCE) * turns[-2].chi_square
        return min(turns, key=lambda model: model.chi_square if np.isfinite(model.chi_square) else np.inf)

    def _fit(
        self,
        declared: NetworkSpec,
        start: NetworkSpec,
        noise: NoiseModel | None,
        mends: tuple[Mend, ...],
        beat: float = np.inf,
        tolerance: float = TOLERANCE,
    ) -> Model:
        objective = self._objective(start, noise, mends)
        coordinates = search_coordinates(start)
        aim = np.sqrt(beat / objective.total)
        found = refine(objective, coordinates, coordinates.start, STEPS, tolerance,
                       hopeless=lambda before, after: after - REACH * (before - after) > aim)  # fmt: skip
        fitted = with_point(start, coordinates, found.point)
        chi_square = found.loss**2 * objective.total
        return Model(declared, fitted, coordinates, found.point, chi_square, found.outcome, mends)

    def _beside_sensors(self, noise: NoiseModel) -> NoiseModel:
        return beside_sensors(noise, self.runs, self.sensors, self.forces)

    def _strengthened(self, model: Model, noise: NoiseModel | None) -> tuple[Mend, ...]:
        view = self.view(model)
        model = replace(model, mends=tuple(mend if mend.local else reshaped(mend, view) for mend in model.mends))
        white = self._beside_sensors(noise) if noise else flat_noise({run.name: 1.0 for run in self.runs})
        for number in [number for number, mend in enumerate(model.mends) if mend.roams]:
            model = self._moved(model, number, view, white)
        residual, tangents = self.linearise(model)
        shapes = shape_rows(model.mends, self.runs)
        normal = normal_equations(residual, stack(SparseRows.of(tangents), SparseRows.dense(shapes)), white, self.jobs)
        return corrected(model.mends, normal, noise is not None)

    def _moved(self, model: Model, number: int, view: ModelView, white: NoiseModel) -> Model:
        """The model with one of its mends at those places of its grid that explain most beside everything else."""
        mend, others = model.mends[number], (*model.mends[:number], *model.mends[number + 1 :])
        residual, tangents = self.linearise(replace(model, mends=others))
        fixed = stack(SparseRows.of(tangents), SparseRows.dense(shape_rows(others, self.runs)))
        suspect = mend.finding.candidate.suspect
        columns = {run.name: np.atleast_2d(suspect.columns(view, run.name))[:, run.first :] for run in self.runs}
        bank = SparseRows.of(columns)
        projected = project_out(normal_equations(residual, (fixed, bank), white, self.jobs), fixed.size)
        alone = replace(mend.finding.candidate, columns=slice(0, bank.size))
        moved = relocated(mend, judge(alone, projected, 0), projected, view)
        return replace(model, mends=(*others[:number], moved, *others[number:]))

    def linearise(self, model: Model) -> tuple[dict[str, Array], dict[str, Array]]:
        """Residual (n,) and tangents (p, n) of a model by run, warm-up cut off."""
        runs = [mended(run, model.mends) for run in self.runs]
        objective = Objective(compile_network(model.fitted), runs, self.jobs, whiten=lambda run, misfits: misfits)
        misfit, jacobian = linearise(objective, model.coordinates, model.point)
        pieces = dict(zip((run.name for run in runs), objective.pieces, strict=True))
        return (
            {name: -misfit[piece] for name, piece in pieces.items()},
            {name: jacobian[:, piece] for name, piece in pieces.items()},
        )

    def extend(self, model: Model, finding: Finding, noise: NoiseModel, beat: float = np.inf) -> Model:
        """The model with the patch of a finding, refitted; see ``fit``.

        It starts where chi square is smallest among the model's own numbers beside the patch and some places on the way
        that the screen foresees, on which patch and numbers move together: to first order it leads downhill.
        """
        starts = [self._extended(model, finding, model.fitted)]
        for share in SHARES:
            part = finding.scaled(share)
            point = model.coordinates.allowed(model.point + model.coordinates.unit * part.moves)[0]
            with suppress(InputError):  # a small share may be less than an element admits
                starts.append(self._extended(model, part, with_point(model.fitted, model.coordinates, point)))
        declared, start = starts[self.nearest([start for _, start in starts], noise, model.mends)]
        return self.fit(declared, start, noise, model.mends, beat)

    def nearest(self, starts: Sequence[NetworkSpec], noise: NoiseModel | None, mends: Sequence[Mend]) -> int:
        """Which of several starts for the same network misses the runs least."""
        places = np.array([compile_network(start).start for start in starts])
        return int(np.argmin(self._objective(starts[0], noise, mends).losses(places)))

    def driven(self, model: Model, base: Model) -> dict[str, Value]:
        """The numbers of an extended model that are at an end of their range, as they stand in the file.

        Not those of a cause that is in the base already and had come to an end there: it was tried when it was named.
        """
        given = model.revived if self.given is None else self.given
        return {path: value for path, value in model.revived.items() if path in given or path not in base.revived}

    def revive(self, model: Model, numbers: Mapping[str, Value], noise: NoiseModel, beat: float = np.inf) -> Model:
        """The model, or a better one: numbers that what was missing had driven away start anew as in the file.

        The others come to them first: they would else be driven away again.
        """
        if not numbers:
            return model
        back = self.put_back(model, numbers, noise)
        other = self.fit(model.declared, back.fitted, noise, back.mends, min(beat, model.chi_square))
        return other if other.chi_square < model.chi_square else model

    def put_back(self, model: Model, numbers: Mapping[str, Value], noise: NoiseModel) -> Model:
        """The model with some numbers of its file, all others nearly fitted to them."""
        held = model.fitted.with_values({path: value.as_role("fixed") for path, value in numbers.items()})
        around = self.fit(model.declared, held, noise, model.mends, tolerance=NEARLY)
        fitted = around.fitted.with_values(numbers)
        coordinates = search_coordinates(fitted)
        return replace(around, fitted=fitted, coordinates=coordinates, point=coordinates.start)

    def as_it_stands(
        self, declared: NetworkSpec, start: NetworkSpec, noise: NoiseModel, mends: Sequence[Mend] = ()
    ) -> Model:
        """A network with its numbers as they are, not refitted."""
        objective = self._objective(start, noise, mends)
        coordinates = search_coordinates(start)
        chi_square = float(objective.losses(coordinates.to_values(coordinates.start))[0]) ** 2 * objective.total
        return Model(declared, start, coordinates, coordinates.start, chi_square, Outcome.CONVERGED, tuple(mends))

    def _objective(self, network: NetworkSpec, noise: NoiseModel | None, mends: Sequence[Mend]) -> Objective:
        whiten = self._beside_sensors(noise).whiten if noise else None
        return Objective(compile_network(network), [mended(run, mends) for run in self.runs], self.jobs, whiten)

    def _extended(self, model: Model, finding: Finding, numbers: NetworkSpec) -> tuple[NetworkSpec, NetworkSpec]:
        text = finding.candidate.suspect.extend(model.declared.text, finding.atoms)
        declared = parse_network(text, self.elements, model.declared.file)
        return declared, self.start_from(declared, numbers)

    def added(self, model: Model, finding: Finding) -> list[Branch]:
        """The branches that the patch of a finding adds to the network of a model. InputError if it cannot be."""
        own = {leaf.name for leaf in model.declared.leaves()}
        extended, _ = self._extended(model, finding, model.fitted)
        return [leaf for leaf in extended.leaves() if leaf.name not in own]

    def start_from(self, declared: NetworkSpec, fitted: NetworkSpec) -> NetworkSpec:
        """A network ready to be fitted: shared numbers inherited, the others given a range."""
        return with_ranges(inherit_numbers(declared, fitted), natural_sizes(self.runs))


@dataclass(frozen=True, eq=False)
class Trial:
    """A finalist after its refit. ``merit`` is the fall of chi square less the price of its new parameters.

    Where its refit was left behind by a better finalist, both are what it had come to.
    """

    finding: Finding
    model: Model
    gain: float
    merit: float
    failure: str = ""


def try_finding(
    bench: Bench, base: Model, finding: Finding, noise: NoiseModel, samples: int, beat: float = np.inf
) -> Trial:
    """Extend the base by a finding, or mend the measurement, and refit, as long as it may come down to ``beat``."""
    suspect = finding.candidate.suspect
    try:
        if suspect.mends:
            mends = (*base.mends, make_mend(bench.view(base), finding))
            model = bench.fit(base.declared, base.fitted, noise, mends, beat)
        else:
            model = bench.extend(base, finding, noise, beat)
    except InputError as error:
        return Trial(finding, base, 0.0, -np.inf, f"its cure cannot be written into the network: {error}")
    if model.outcome is not Outcome.LEFT_BEHIND:
        model = bench.revive(model, bench.driven(model, base), noise, beat)
    if suspect.mends and suspect.sign:
        positive = np.flatnonzero(model.mends[-1].strengths > 0.0)
        if 0 < positive.size < len(finding.atoms) and model.mends[-1].chosen == finding.chosen:
            return try_finding(bench, base, finding.keeping(positive), noise, samples, beat)
    gain = base.chi_square - model.chi_square
    price = (model.numbers - base.numbers) * np.log(samples)
    failure = "the refit did not come to a finite end" if not np.isfinite(model.chi_square) else ""
    if suspect.mends and suspect.sign and np.any(model.mends[-1].strengths <= 0.0):
        failure = "the refit turned its sign, which makes no sense for this cause"
    if not suspect.admits(_new_numbers(base, model, model)):
        if len(finding.atoms) > 1 and not suspect.joint:
            return try_finding(bench, base, finding.without_last(), noise, samples, beat)
        failure = "what the refit found is not what the cause says, or its opposite"
    return Trial(finding, model, gain, gain - price if not failure else -np.inf, failure)


def measured_from(model: Model, trial: Trial) -> Trial:
    """A trial whose gain and merit are measured from another model than that from which it was found."""
    gain = model.chi_square - trial.model.chi_square
    return replace(trial, gain=gain, merit=trial.merit - trial.gain + gain)


def admitted(trial: Trial, base: Model | None, model: Model, first: Model | None = None) -> bool:
    """Whether a later model still has numbers by which a trial, an extension of ``base``, is what its cause says.

    Its branches may have other names now, where they are the only ones with such numbers, or all that was added to the
    ``first`` model.
    """
    if base is None:
        return True
    found, now = (_new_numbers(base, trial.model, seen) for seen in (trial.model, model))
    if found.keys() != now.keys():
        now = _of_the_only_branch(found.keys(), model)
    if first and found.keys() != now.keys():
        now = _new_numbers(first, model, model)
    suspect = trial.finding.candidate.suspect
    return found.keys() != now.keys() or (suspect.stays or suspect.admits)(now)


def _of_the_only_branch(words: Collection[str], model: Model) -> dict[str, float]:
    """The numbers of the only branch that has these words, whatever its name; empty where there are none or several."""
    branches: dict[str, dict[str, float]] = {}
    for slot in model.fitted.slots():
        name, _, word = slot.path.rpartition(".")
        branches.setdefault(name, {})[word] = slot.value.number
    alike = [numbers for numbers in branches.values() if numbers.keys() == set(words)]
    return alike[0] if len(alike) == 1 else {}


def _new_numbers(base: Model, extended: Model, model: Model) -> dict[str, float]:
    """The numbers in SI that an extension brought, as they stand in a model, by the last word of their path.

    Those of a second branch end in ``_2``, and so on.
    """
    old = {slot.path for slot in base.fitted.slots()}
    new = {slot.path for slot in extended.fitted.slots()} - old
    found: dict[str, float] = {}
    times: Counter[str] = Counter()
    for slot in (slot for slot in model.fitted.slots() if slot.path in new):
        word = slot.path.rpartition(".")[2]
        times[word] += 1
        found[word if times[word] == 1 else f"{word}_{times[word]}"] = slot.value.number
    return found


def inherit_numbers(declared: NetworkSpec, fitted: NetworkSpec) -> NetworkSpec:
    """A network with the fitted numbers and curves of another one, wherever the two share a path."""
    curves = {
        f"{branch.name}.{key}": curve for branch in fitted.leaves() for key, curve in branch.characteristics().items()
    }
    for path in declared.data_curves():
        declared = declared.with_curve(path, curves[path])
    known = {slot.path: slot.value for slot in fitted.slots()}
    shared = {
        slot.path: replace(known[slot.path], node=slot.value.node) for slot in declared.slots() if slot.path in known
    }
    return declared.with_values(shared)


def with_numbers_of(network: NetworkSpec, fitted: NetworkSpec, names: Mapping[str, str]) -> NetworkSpec:
    """A network with the numbers that its branches have in another one under other ``names``."""
    known = {slot.path: slot.value for slot in fitted.slots()}
    values = {}
    for slot in network.slots():
        branch, _, word = slot.path.rpartition(".")
        path = f"{names.get(branch, branch)}.{word}"
        if path in known:
            values[slot.path] = replace(known[path], node=slot.value.node)
    return network.with_values(values)

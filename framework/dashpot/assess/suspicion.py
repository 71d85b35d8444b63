"""One look at a fitted model: its residual, what a refit could absorb, and every suspect screened."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.contest import Bench, Model
from dashpot.assess.inside import Inside
from dashpot.assess.mend import mended
from dashpot.assess.noise import NoiseModel, flat_noise, learn_noise
from dashpot.assess.nuisance import sensor_nuisance, table_nuisance
from dashpot.assess.projection import SparseRows, side_by_side, stack
from dashpot.assess.screen import Candidate, Columns, Finding, Screen, collect_bank, rich_residual, screen
from dashpot.assess.seat import Seat, seats_of
from dashpot.assess.selected import selected_residual
from dashpot.assess.view import ModelView, view_of
from dashpot.contract.cause import Cause
from dashpot.fit.objective import Objective
from dashpot.kernel.network import compile_network
from dashpot.text.problem import InputError

Array = NDArray[np.float64]

FIRST_ROUNDS, LATER_ROUNDS = 2, 1
INNER_ROUNDS = 2  # times as many inside a network with nodes
RESOLUTION = 1e-5  # of the deviation of the force


@dataclass(frozen=True, eq=False)
class Look:
    """A model refitted under the noise that was found, and what the screen says about it."""

    model: Model
    noise: NoiseModel
    view: ModelView
    columns: Columns
    screen: Screen
    unavailable: tuple[tuple[str, str], ...]

    @property
    def floor(self) -> float:
        """What chi square would be if all suspects at once were taken out, to first order: that of the noise."""
        return self.model.chi_square - self.screen.together


def look_at(bench: Bench, model: Model, causes: Sequence[type[Cause]], noise: NoiseModel | None, seed: int) -> Look:
    """Learn the noise, refit the model under it, screen all suspects."""
    rounds = LATER_ROUNDS if noise else FIRST_ROUNDS
    noise = noise or first_noise(bench, model)
    model = bench.fit(model.declared, model.fitted, noise, model.mends)
    view, residual, tangents = linear_view(bench, model)
    inside = Inside(model.fitted, bench.runs, bench.elements) if model.fitted.joints else None
    candidates, unavailable = gather_candidates(causes, seats_of(view, model.fitted, inside))
    sheet, sizes = sensor_nuisance(bench.runs, view, bench.sensors)
    bends, free = table_nuisance(bench.runs, view, model.fitted)
    nuisance, priors = stack(sheet, bends), np.concatenate([sizes, free])
    bank = collect_bank(view, candidates, bench.jobs)
    if inside:
        bank = side_by_side(bank, inside.bank(candidates, bench.jobs, bench.watch))
    columns = Columns(residual, SparseRows.dense(tangents), nuisance, bank, priors, tuple(candidates), bench.jobs)
    residual_of, times = (selected_residual, INNER_ROUNDS) if inside else (rich_residual, 1)
    for _ in range(times * rounds):
        noise = learn_noise(residual_of(columns, noise), resolution(bench))
    model = bench.fit(model.declared, model.fitted, noise, model.mends)
    view, residual, tangents = linear_view(bench, model)
    columns = replace(columns, residual=residual, tangents=SparseRows.dense(tangents))
    return Look(model, noise, view, columns, screen(columns, noise, seed), unavailable)


def glance_at(bench: Bench, model: Model, look: Look, seed: int) -> Look:
    """A look at a model that differs little from another one: noise and columns of suspects are taken from there."""
    view, residual, tangents = linear_view(bench, model)
    columns = replace(look.columns, residual=residual, tangents=SparseRows.dense(tangents))
    seen = screen(columns, look.noise, seed, look.screen.gram)
    return replace(look, model=model, view=view, columns=columns, screen=seen)


def first_noise(bench: Bench, model: Model) -> NoiseModel:
    """White noise as large as the misfit of each run."""
    network = compile_network(model.fitted)
    runs = [mended(run, model.mends) for run in bench.runs]
    rmse = Objective(network, runs, bench.jobs).rmse(network.start)[:, 0]
    least = resolution(bench)
    return flat_noise({run.name: max(float(r), least[run.name]) for run, r in zip(bench.runs, rmse, strict=True)})


def resolution(bench: Bench) -> dict[str, float]:
    """The deviation of each run in N that counts as no error at all."""
    return {run.name: RESOLUTION * max(float(np.std(run.force)), 1e-12) for run in bench.runs}


def linear_view(bench: Bench, model: Model) -> tuple[ModelView, dict[str, Array], dict[str, Array]]:
    """The model as causes see it, its residual (n,) and its tangents (p, n) by run, warm-up cut off.

    A number at an end of its range can absorb nothing: its tangents are zero.
    """
    residual, tangents = bench.linearise(model)
    free = ~model.at_end[:, None]
    followed = {run: np.where(free, rows, 0.0) for run, rows in tangents.items()}
    return view_of(model.fitted, bench.runs, bench.elements, bench.jobs), residual, followed


def gather_candidates(
    causes: Sequence[type[Cause]], seats: Sequence[Seat]
) -> tuple[list[Candidate], tuple[tuple[str, str], ...]]:
    """All forms of all causes with the places of their columns, and the causes that cannot be tried with the reason."""
    found: list[Candidate] = []
    unavailable, first = [], 0
    for cause, seat in product(causes, seats):
        try:
            suspects = seat.suspects(cause)
        except InputError as error:
            unavailable.append((cause.word, str(error)))
            continue
        for suspect in suspects:
            found.append(Candidate(cause, suspect, slice(first, first + len(suspect.grid)), seat.site))
            first += len(suspect.grid)
    return found, tuple(dict.fromkeys(unavailable))


def expected_gain(columns: Columns, finding: Finding) -> float:
    """The fall of the training error that the screen foresees, 1 - RMSE after / RMSE before, both after a refit."""
    where = np.arange(finding.candidate.columns.start, finding.candidate.columns.stop)[list(finding.chosen)]
    strengths = np.zeros(columns.bank.size)
    strengths[where] = finding.strengths
    left = {run: values - columns.bank.combined(strengths, run) for run, values in columns.residual.items()}
    before, after = (left_by_refit(columns.tangents, signals) for signals in (columns.residual, left))
    return float(1.0 - np.sqrt(after / before)) if before > 0.0 else 0.0


def left_by_refit(tangents: SparseRows, signals: Mapping[str, Array]) -> float:
    """The sum over runs of the mean squares of signals, less what the tangents can follow."""
    weight = {run: 1.0 / values.size for run, values in signals.items()}
    gram = sum(weight[run] * (rows @ rows.T) for run, rows in tangents.values.items())
    right = sum(weight[run] * (rows @ signals[run]) for run, rows in tangents.values.items())
    moves = np.linalg.lstsq(gram, right, rcond=1e-12)[0] if np.size(right) else np.zeros(0)
    return sum(weight[run] * float(np.sum((signals[run] - moves @ tangents.values[run]) ** 2)) for run in signals)

"""Is there structure left that no suspect explains? Tests that name nothing.

Three questions to the whitened residual of the final model: does it correlate with a general set of functions of the
motion and of single runs, do repeated runs agree about it, and is there a line in its spectrum?
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.lines import strongest_line
from dashpot.assess.noise import NoiseModel
from dashpot.assess.projection import SparseRows, normal_equations, project_out, stack
from dashpot.assess.screen import KEPT, Columns
from dashpot.assess.view import ModelView
from dashpot.data.run import Run

Array = NDArray[np.float64]
Signals = Mapping[str, Array]

SIGNIFICANT = 6.0
SMALLEST_SIZE = 0.1
SHARE_LEFT = 0.3  # of the RMS of what is explained: a tenth of its square
LAGS = (0.003, 0.02, 0.15, 1.0)
NO_REPEATS = "is not known to come again"


@dataclass(frozen=True)
class Leftover:
    """``score`` is in standard deviations of pure noise, ``size`` the structured part in units of the noise (RMS).

    ``what`` says how it shows.
    """

    score: float
    size: float
    what: str

    def notable(self, explained: float = 0.0) -> bool:
        """Whether something is left that is both certain and not negligible.

        That is measured by the noise, or by what is ``explained``: the RMS of the effects that have a name, in units
        of the noise.
        """
        negligible = min(SMALLEST_SIZE, SHARE_LEFT * explained) if explained else SMALLEST_SIZE
        return self.score > SIGNIFICANT and self.size > negligible


def look_for_leftover(view: ModelView, columns: Columns, noise: NoiseModel, runs: Sequence[Run]) -> Leftover:
    """The most telling one of the three tests, sensor errors within the data sheet left aside."""
    sound = _without_sensor_errors(columns, noise)
    white = {run: noise.whiten(run, values) for run, values in sound.items()}
    tests = (_correlation(view, columns, noise), _agreement(white, runs), _line(view, white))
    return max(tests, key=lambda leftover: (leftover.score > SIGNIFICANT, leftover.size))


def _correlation(view: ModelView, columns: Columns, noise: NoiseModel) -> Leftover:
    general = {run: general_functions(view, run) for run in columns.residual}
    single = {run: single_functions(view, run) for run in columns.residual}
    names = [*next(iter(general.values())), *(name for functions in single.values() for name in functions)]
    rows = (columns.tangents, columns.nuisance, SparseRows.of(_cut(view, general)), _apart(_cut(view, single)))
    normal = normal_equations(columns.residual, rows, noise, columns.jobs)
    projected = project_out(normal, columns.precision.size, columns.precision)
    scale = np.sqrt(np.maximum(projected.original, 1e-300))
    sizes, vectors = np.linalg.eigh(projected.spread / np.outer(scale, scale))
    kept = sizes > 1e-8 * sizes[-1]
    excess = float(np.sum((vectors[:, kept].T @ (projected.scores / scale)) ** 2 / sizes[kept])) - float(kept.sum())
    score = excess / float(np.sqrt(2.0 * kept.sum()))
    alone = projected.scores**2 / np.maximum(np.diag(projected.spread), KEPT * projected.original + 1e-300)
    what = f"follows {names[int(np.argmax(alone))]}"
    return Leftover(score, float(np.sqrt(max(excess, 0.0) / projected.samples)), what)


def _cut(view: ModelView, functions: Mapping[str, Signals]) -> dict[str, Array]:
    return {run: np.array([*rows.values()])[:, view.scored[run].first :] for run, rows in functions.items()}


def _apart(rows: Mapping[str, Array]) -> SparseRows:
    """Rows (k, n) of every run with strengths of their own."""
    each = len(next(iter(rows.values())))
    places = {run: each * number + np.arange(each) for number, run in enumerate(rows)}
    return SparseRows(rows, places, each * len(rows))


def _without_sensor_errors(columns: Columns, noise: NoiseModel) -> Signals:
    if columns.nuisance.size == 0:
        return columns.residual
    rows = stack(columns.tangents, columns.nuisance)
    normal = normal_equations(columns.residual, rows, noise, columns.jobs)
    scale = np.sqrt(np.maximum(np.diag(normal.gram) + columns.precision, 1e-300))
    gram = (normal.gram + np.diag(columns.precision)) / np.outer(scale, scale)
    strengths = np.linalg.lstsq(gram, normal.right / scale, rcond=1e-11)[0] / scale
    return {run: values - rows.combined(strengths, run) for run, values in columns.residual.items()}


def general_functions(view: ModelView, run: str) -> dict[str, Array]:
    """Products of deflection and velocity, powers, signs, and the same remembered for a while: (n,) by name."""
    x = (view.displacement(run) - np.mean(view.reach)) / (0.5 * np.ptp(view.reach))
    local = view.displacement(run) - np.mean(view.displacement(run))
    local = local / max(float(np.std(local)), 1e-300)
    v = view.velocity(run) / view.speed
    a = np.gradient(v)
    plain = {
        "the deflection": x,
        "the square of the deflection": x**2,
        "the cube of the deflection": x**3,
        "the fourth power of the deflection": x**4,
        "the velocity": v,
        "the velocity times its size": v * np.abs(v),
        "the size of the velocity": np.abs(v),
        "the cube of the velocity": v**3,
        "velocity times deflection": v * x,
        "velocity times the square of the deflection": v * x**2,
        "velocity times the deflection from the middle of the run": v * local,
        "velocity times the square of the deflection from the middle of the run": v * local**2,
        "the direction of motion": np.tanh(20.0 * v),
        "the direction of motion times deflection": np.tanh(20.0 * v) * x,
        "the direction of motion times the deflection from the middle of the run": np.tanh(20.0 * v) * local,
        "the square of the deflection from the middle of the run": local**2,
        "the cube of the deflection from the middle of the run": local**3,
        "a step of the deflection": np.tanh(4.0 * x),
        "the acceleration": a,
        "acceleration times deflection": a * local,
        "force times velocity": view.force(run) * v,
    }
    past = {"deflection": local, "square of the deflection": local**2, "size of the velocity": np.abs(v)}
    remembered = {f"the {name} of the last {lag:g} s": _low_pass(signal, view.step(run) / lag)
                  for lag in LAGS for name, signal in past.items()}  # fmt: skip
    return plain | remembered


def single_functions(view: ModelView, run: str) -> dict[str, Array]:
    """What a run may have by itself, its force, a constant and the time: (n,) by name."""
    force = view.force(run)
    return {
        f"the force of run '{run}' alone": force,
        f"a constant in run '{run}'": np.ones_like(force),
        f"the time in run '{run}'": np.linspace(0.0, 1.0, force.size),
    }


def _low_pass(signal: Array, share: float) -> Array:
    from scipy.signal import lfilter

    keep = np.exp(-share)
    return lfilter([1.0 - keep], [1.0, -keep], signal)


def _agreement(white: Signals, runs: Sequence[Run]) -> Leftover:
    total, samples = 0.0, 0
    for run in runs:
        if run.repeats is not None and run.repeats in white and run.name in white:
            first, second = white[run.repeats], white[run.name]
            count = min(first.size, second.size)
            total += float(first[-count:] @ second[-count:])
            samples += count
    if samples == 0:
        return Leftover(0.0, 0.0, NO_REPEATS)
    return Leftover(total / np.sqrt(samples), float(np.sqrt(max(total, 0.0) / samples)), "comes again in repeated runs")


def _line(view: ModelView, white: Signals) -> Leftover:
    found = strongest_line(white, {run: view.step(run) for run in white})
    return Leftover(found.score, found.size, f"is a line at {found.frequency:.4g} Hz")

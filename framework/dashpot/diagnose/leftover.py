"""Is there structure left that no cause explains? Tests that name nothing.

Questions to the whitened residual of the final model: does it correlate with a general set of functions of the
motion and of single runs, does its size follow the motion, do repeated runs agree about it, and is there a line in its
spectrum?
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.bends import bends_of_tables
from dashpot.diagnose.lines import strongest_line
from dashpot.diagnose.look import Look
from dashpot.diagnose.refit import Refitter
from dashpot.diagnose.rounding import Rounding, rounding_of
from dashpot.diagnose.table_rows import records
from dashpot.diagnose.view import ModelView
from dashpot.diagnose.whitening import Noise

Array = NDArray[np.float64]

SIGNIFICANT = 6.0
SMALLEST_SIZE = 0.1
LAGS = (0.003, 0.02, 0.15, 1.0)
KEPT = 1e-8  # of the largest eigenvalue
UNSEEN = 1e-11  # likewise, of what is left free
AGAIN = "comes again in repeated runs"


@dataclass(frozen=True)
class Leftover:
    """``score`` is in standard deviations of pure noise, ``size`` the structured part in units of the noise (RMS).

    ``what`` says how it shows, ``share`` how much of the square of the residual it is; of the residual in newtons where
    it comes again in repeated runs or is a line, else of the whitened one. ``run`` is the single run in which it is,
    and ``follows`` the function that it follows there, if it does. ``line`` says whether there is a notable line in the
    spectrum. Repeated runs differ by both, so that a noise floor that comes from them holds these, but they are no
    noise.
    """

    score: float
    size: float
    what: str
    share: float = 0.0
    line: bool = False
    run: str = ""
    follows: str = ""

    @property
    def of_most_runs(self) -> Leftover:
        """The same, found to be in one run after another."""
        return replace(self, what=f"follows {self.follows} of its own in most runs", run="", follows="")

    def notable(self) -> bool:
        """Whether something is left that is both certain and not negligible beside the noise."""
        return self.score > SIGNIFICANT and self.size > SMALLEST_SIZE


def look_for_leftover(refitter: Refitter, look: Look, pairs: Sequence[tuple[str, str]]) -> Leftover:
    """The most telling one of the tests; ``pairs`` are repeats of each other."""
    noise = look.measured_noise
    residual, free = _free(refitter, look, noise)
    plain, _ = _free(refitter, look, look.noise)
    line = _line(refitter, look, plain)
    tests = [
        _correlation(refitter, look, residual, free),
        _single_runs(refitter, look, residual),
        _uneven(refitter, look, residual),
        _agreement(residual, pairs),
        line,
    ]
    found = max(tests, key=lambda leftover: (leftover.score > SIGNIFICANT, leftover.size))
    found = replace(found, line=line.notable())
    if found.score <= SIGNIFICANT:
        return found
    if found.what == AGAIN:
        recorded = {run.name: plain[run.name] for run in records(refitter.runs)}
        return replace(found, share=_structured(recorded, pairs))
    if found.what == line.what:
        return replace(found, share=found.size**2 / (1.0 + found.size**2))
    whole = np.concatenate(list(residual.values()))
    return replace(found, share=min(found.size**2 / float(np.mean(whole**2)), 1.0))


def _free(refitter: Refitter, look: Look, noise: Noise) -> tuple[dict[str, Array], dict[str, Array]]:
    """By run what the residual (kept,) is beside all that a search leaves free, and this (p, kept), whitened.

    Free are the numbers of the model, the bends of its fitted tables between two knots, and what a force that was
    recorded in coarse steps was rounded by.
    """
    residual, tangents = refitter.linearise(look.model, noise)
    bends = bends_of_tables(refitter.runs, look.view, look.model.fitted)
    rounded = _roundings(refitter, look)
    beside = {run: np.concatenate([bend, rounded[run].means]) if rounded else bend for run, bend in bends.items()}
    free = {run: np.concatenate([rows, noise.whiten(run, beside[run])]) for run, rows in tangents.items()}
    gram = sum(rows @ rows.T for rows in free.values())
    strengths = _inverse(gram) @ sum(rows @ residual[run] for run, rows in free.items())
    return {run: residual[run] - strengths @ rows for run, rows in free.items()}, free


def _roundings(refitter: Refitter, look: Look) -> dict[str, Rounding]:
    """What the force of each run was rounded by, where any record is coarse; else nothing."""
    found = {run.name: Rounding(np.zeros(run.samples)) for run in refitter.runs}
    for run in records(refitter.runs):
        found[run.name] = rounding_of(run.force[run.first :], look.view.force(run.name)[run.first :])
    return found if any(rounding.coarse for rounding in found.values()) else {}


def _correlation(refitter: Refitter, look: Look, residual: Mapping[str, Array], free: Mapping[str, Array]) -> Leftover:
    width = len(next(iter(free.values()))) + len(general_functions(look.view, look.view.runs[0]))
    gram, right, names = np.zeros((width, width)), np.zeros(width), list[str]()
    for run in refitter.runs:
        functions = general_functions(look.view, run.name)
        names = list(functions)
        rows = look.measured_noise.whiten(run.name, np.array([*functions.values()])[:, run.first :])
        rows = np.concatenate([free[run.name], rows])
        gram, right = gram + rows @ rows.T, right + rows @ residual[run.name]
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    gram, right, first = gram / np.outer(scale, scale), right / scale, len(gram) - len(names)
    inverse = _inverse(gram[:first, :first])
    spread = gram[first:, first:] - gram[first:, :first] @ inverse @ gram[:first, first:]
    scores = right[first:] - gram[first:, :first] @ inverse @ right[:first]
    sizes, vectors = np.linalg.eigh(spread)
    kept = sizes > KEPT * sizes[-1]
    excess = float(np.sum((vectors[:, kept].T @ scores) ** 2 / sizes[kept])) - float(kept.sum())
    score = excess / float(np.sqrt(2.0 * kept.sum()))
    alone = scores**2 / np.maximum(np.diag(spread), 1e-5)
    samples = sum(values.size for values in residual.values())
    return Leftover(score, float(np.sqrt(max(excess, 0.0) / samples)), f"follows {names[int(np.argmax(alone))]}")


def _inverse(gram: Array) -> Array:
    """The inverse of a Gram matrix, of rows of any units; directions that are not seen stay as they are."""
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    unit = np.outer(scale, scale)
    return np.asarray(np.linalg.pinv(gram / unit, rcond=UNSEEN, hermitian=True) / unit)


def _single_runs(refitter: Refitter, look: Look, residual: Mapping[str, Array]) -> Leftover:
    """Whether single runs have a gain, an offset or a drift of their own."""
    alone, whole, count, samples = dict[tuple[str, str], float](), 0.0, 0, 0
    for run in records(refitter.runs):
        functions = single_functions(look.view, run.name)
        rows = look.measured_noise.whiten(run.name, np.array([*functions.values()])[:, run.first :])
        for name, row in zip(functions, rows, strict=True):
            alone[name, run.name] = float((row @ residual[run.name]) ** 2 / max(float(row @ row), 1e-300))
        directions = np.linalg.svd(rows, full_matrices=False)[2]
        whole += float(np.sum((directions @ residual[run.name]) ** 2))
        count, samples = count + len(rows), samples + residual[run.name].size
    if not alone:
        return Leftover(0.0, 0.0, "is of no single run")
    excess, (name, at) = whole - count, max(alone, key=lambda key: alone[key])
    score, size = excess / float(np.sqrt(2.0 * count)), float(np.sqrt(max(excess, 0.0) / samples))
    return Leftover(score, size, f"follows {name} in run '{at}' alone", run=at, follows=name)


def _uneven(refitter: Refitter, look: Look, residual: Mapping[str, Array]) -> Leftover:
    """Whether the size of the residual follows the motion, as that of a law does and that of noise does not.

    The score test of Breusch and Pagan, studentised (Koenker, Journal of Econometrics 17 (1981) 107): squares of the
    residual over the ranks of deflection, velocity and acceleration, beside what coarse steps of the force do to them.
    By their size a few samples, such as the corners of a triangle, would have all the leverage, and their noise would
    decide.
    """
    found, names, rounded = [], list[str](), _roundings(refitter, look)
    for run in records(refitter.runs):
        functions = _ranks(look.view, run.name)
        names = list(functions)
        rows = np.array([*functions.values(), np.ones(run.force.size)])[:, run.first :]
        rows = np.concatenate([rows, rounded[run.name].variances]) if rounded else rows
        sums = look.measured_noise.reduce(run.name, rows)
        found.append(np.concatenate([residual[run.name][None] ** 2, sums / sums[len(names)]]))
    if not found:
        return Leftover(0.0, 0.0, "has no size that could follow the motion")
    whole = np.concatenate(found, axis=1)
    squares, rows, beside, samples = whole[0], whole[1 : len(names) + 1], whole[len(names) + 1 :], whole.shape[1]
    away = squares - _projected(squares, beside)
    rows = rows - _projected(rows, beside)
    fitted = _projected(away, rows)
    variance = max(float(np.var(away)), 1e-300)
    excess = float(fitted @ fitted) / variance - len(names)
    alone = [abs(np.corrcoef(row, away)[0, 1]) for row in rows]
    follows = np.sqrt(max(excess, 0.0) * variance / samples)  # the deviation of what follows the motion
    size = float(np.sqrt(follows / max(float(squares.mean()), 1e-300)))
    return Leftover(excess / float(np.sqrt(2.0 * len(names))), size, f"grows with {names[int(np.argmax(alone))]}")


def _projected(signals: Array, rows: Array) -> Array:
    """Signals (..., n) on the space of rows (k, n)."""
    return np.asarray((np.linalg.lstsq(rows.T, signals.T, rcond=1e-9)[0].T) @ rows)


def _ranks(view: ModelView, run: str) -> dict[str, Array]:
    """The ranks (n,), from 0 to 1, of the size of what moves a run, by name."""
    from scipy.stats import rankdata

    x, v = view.displacement(run), view.velocity(run)
    moved = {
        "the deflection from the middle of the run": x - np.mean(x),
        "the velocity": v,
        "the acceleration": np.gradient(v, view.step(run)),
    }
    return {name: rankdata(np.abs(signal)) / signal.size for name, signal in moved.items()}


def _agreement(white: Mapping[str, Array], pairs: Sequence[tuple[str, str]]) -> Leftover:
    products = [white[one] * white[other] for one, other in pairs]
    if not products:
        return Leftover(0.0, 0.0, "is not known to come again")
    total, samples = sum(float(product.sum()) for product in products), sum(product.size for product in products)
    return Leftover(total / np.sqrt(samples), float(np.sqrt(max(total, 0.0) / samples)), AGAIN)


def _structured(residual: Mapping[str, Array], pairs: Sequence[tuple[str, str]]) -> float:
    """The share of the square of residuals (kept,) by run that is structure, where repeats agree about some.

    Of repeated runs it is what is the same in both, their covariance, of all others together what is more than the
    noise by which repeats differ: one by one the noise of some is larger, and would count as structure.
    """
    both = [(residual[one], residual[other]) for one, other in pairs]
    noise = 0.5 * float(np.mean(np.concatenate([one - other for one, other in both]) ** 2))
    squares = sum(0.5 * float(one @ one + other @ other) for one, other in both)
    again = max(sum(float(one @ other) for one, other in both) / squares, 0.0)
    repeated = {run for pair in pairs for run in pair}
    whole = {run: float(found @ found) for run, found in residual.items()}
    beyond = sum(whole[run] - noise * found.size for run, found in residual.items() if run not in repeated)
    return (again * sum(whole[run] for run in repeated) + max(beyond, 0.0)) / sum(whole.values())


def _line(refitter: Refitter, look: Look, residual: Mapping[str, Array]) -> Leftover:
    """The strongest line in what no function of the motion or the time explains of each run: a specimen scatters so.

    Not whitened, since a filter that makes noise white takes lines for noise. A run of fewer samples than there are
    functions has nothing left but rounding, and shows none.
    """
    noise, rests, steps = look.noise, dict[str, Array](), dict[str, float]()
    for run in records(refitter.runs):
        functions = general_functions(look.view, run.name) | single_functions(look.view, run.name)
        rows = noise.whiten(run.name, np.array([*functions.values()])[:, run.first :])
        directions = np.linalg.svd(rows, full_matrices=False)[2]
        if len(directions) < directions.shape[1]:
            rests[run.name] = residual[run.name] - (directions @ residual[run.name]) @ directions
            steps[run.name] = run.drive.dt * noise.steps[run.name]
    if not steps:
        return Leftover(0.0, 0.0, "is no line")
    found = strongest_line(rests, steps)
    return Leftover(found.score, found.size, f"is a line at {found.frequency:.4g} Hz")


def general_functions(view: ModelView, run: str) -> dict[str, Array]:
    """Products of deflection and velocity, powers, signs, and the same remembered for a while: (n,) by name."""
    x = (view.displacement(run) - np.mean(view.reach)) / (0.5 * np.ptp(view.reach))
    local = view.displacement(run) - np.mean(view.displacement(run))
    local = local / max(float(np.std(local)), 1e-300)
    v = view.velocity(run) / view.speed
    a = np.gradient(v, view.step(run) / view.dt)
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
    remembered = {
        f"the {name} of the last {lag:g} s": _low_pass(signal, view.step(run) / lag)
        for lag in LAGS
        for name, signal in past.items()
    }
    return plain | remembered


def single_functions(view: ModelView, run: str) -> dict[str, Array]:
    """What a run may have by itself, its force, a constant and the time: (n,) by name."""
    force = view.force(run)
    return {
        "the force": force,
        "a constant": np.ones_like(force),
        "the time": np.linspace(0.0, 1.0, force.size),
    }


def _low_pass(signal: Array, share: float) -> Array:
    from scipy.signal import lfilter

    keep = np.exp(-share)
    return lfilter([1.0 - keep], [1.0, -keep], signal)

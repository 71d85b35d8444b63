"""Every suspect against the residual of the fitted model, without a refit.

Each run gives whitened columns [residual | tangents of the fitted parameters | sensor errors | all suspects]. Their
Gram matrix, summed over runs, holds all there is to know: what a refit of the present model could absorb is projected
out (Neyman's C(alpha) test), so a suspect may claim only what the model cannot explain by other numbers.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from dashpot.assess.noise import NoiseModel
from dashpot.assess.projection import Projected, SparseRows, normal_equations, project_out
from dashpot.assess.view import ModelView
from dashpot.contract.cause import Atom, Cause, Suspect
from dashpot.kernel.workers import spread
from dashpot.model.sites import Site

Array = NDArray[np.float64]
Places = NDArray[np.intp]

FALSE_ALARMS = 0.01
DRAWS = 400
KEPT = 1e-5  # of the square of a column must be left after projection: less is a matter of numerical errors
RIDGE = 1e-9
ENOUGH = 20  # samples for each column


@dataclass(frozen=True, eq=False)
class Candidate:
    """A suspect of a cause with its columns' place among all columns; ``site`` is where in a network with nodes."""

    cause: type[Cause]
    suspect: Suspect
    columns: slice
    site: Site | None = None

    @property
    def name(self) -> tuple[str, str]:
        """The word of the cause, and the words of the site."""
        return self.cause.word, self.site.words if self.site else ""

    def told(self) -> dict[str, str | None]:
        """Word, title and place as they stand in result files."""
        place = self.site.words if self.site else None
        return {"cause": self.cause.word, "title": self.cause.about, "place": place}

    @property
    def title(self) -> str:
        """What the cause is, and where."""
        return " ".join([self.cause.about, self.site.words] if self.site else [self.cause.about])


@dataclass(frozen=True, eq=False)
class Columns:
    """Columns of all runs: ``tangents``, ``nuisance`` and the ``bank`` of suspects, warm-up cut off.

    ``priors`` (q,) are the standard deviations of the nuisance strengths. ``jobs`` runs are worked on at once.
    """

    residual: Mapping[str, Array]
    tangents: SparseRows
    nuisance: SparseRows
    bank: SparseRows
    priors: Array
    candidates: tuple[Candidate, ...]
    jobs: int = 1

    @property
    def kinds(self) -> tuple[SparseRows, SparseRows, SparseRows]:
        """Tangents, nuisance and bank."""
        return self.tangents, self.nuisance, self.bank

    @property
    def precision(self) -> Array:
        """What is known of the strengths of tangents and nuisance beforehand, 1/variance."""
        return np.concatenate([np.zeros(self.tangents.size), 1.0 / self.priors**2])

    def less(self, strengths: Array) -> dict[str, Array]:
        """The residual of each run (n,) less tangents, nuisance and bank times their strengths."""
        parts = np.split(strengths, np.cumsum([kind.size for kind in self.kinds])[:-1])
        pairs = list(zip(self.kinds, parts, strict=True))
        return {run: values - sum(kind.combined(part, run) for kind, part in pairs)
                for run, values in self.residual.items()}  # fmt: skip

    def thinned(self) -> Columns:
        """The columns at every few samples, as many as are enough to tell all columns apart in white noise."""
        samples = sum(values.size for values in self.residual.values())
        step = max(1, samples // max(1, ENOUGH * sum(kind.size for kind in self.kinds)))
        kinds = [replace(kind, values={run: rows[:, ::step] for run, rows in kind.values.items()})
                 for kind in self.kinds]  # fmt: skip
        residual = {run: values[::step] for run, values in self.residual.items()}
        return replace(self, residual=residual, tangents=kinds[0], nuisance=kinds[1], bank=kinds[2])

    def samples_of(self, finding: Finding) -> int:
        """How many samples the runs have that a finding touches."""
        chosen = finding.candidate.columns.start + np.array(finding.chosen)
        touched = [run for run, places in self.bank.places.items() if np.isin(chosen, places).any()]
        return sum(self.residual[run].size for run in touched)


@dataclass(frozen=True, eq=False)
class Finding:
    """What the screen says of a candidate: ``gain`` is the fall of chi square, ``merit`` that less its penalty.

    ``deviations`` are those of the strengths, ``absorbed`` (p, k) the changes of the model's numbers that come nearest
    to one of each chosen place.
    """

    candidate: Candidate
    atoms: tuple[Atom, ...]
    gain: float
    merit: float
    strengths: Array
    chosen: tuple[int, ...]
    deviations: Array
    absorbed: Array

    @property
    def moves(self) -> Array:
        """By how many natural steps (p,) the numbers of the model change when the finding joins it, to first order."""
        return -self.absorbed @ self.strengths

    def scaled(self, share: float) -> Finding:
        """The finding with all strengths times ``share``."""
        atoms = tuple((share * strength, place) for strength, place in self.atoms)
        return replace(self, atoms=atoms, strengths=share * self.strengths)

    def without_last(self) -> Finding:
        """The finding without the place that was added last."""
        return self.keeping(range(len(self.atoms) - 1))

    def keeping(self, kept: Iterable[int]) -> Finding:
        """The finding with some of its places, by their number."""
        at = list(kept)
        return replace(self, atoms=tuple(self.atoms[k] for k in at), strengths=self.strengths[at],
                       chosen=tuple(self.chosen[k] for k in at), deviations=self.deviations[at],
                       absorbed=self.absorbed[:, at])  # fmt: skip


@dataclass(frozen=True, eq=False)
class Screen:
    """All findings, best first; a merit above ``threshold`` is significant.

    ``together`` is the fall of chi square of all suspects at once, less what that of pure noise would be, ``gram`` the
    Gram matrix of nuisance and bank, whitened.
    """

    findings: tuple[Finding, ...]
    threshold: float
    projected: Projected
    together: float
    gram: Array

    @property
    def samples(self) -> int:
        """How many samples all runs have."""
        return self.projected.samples

    @property
    def best(self) -> Finding | None:
        """The best significant finding."""
        return self.findings[0] if self.findings and self.findings[0].merit > self.threshold else None


def collect_bank(view: ModelView, candidates: Sequence[Candidate], jobs: int = 1) -> SparseRows:
    """The columns on every run of all candidates but those inside a network with nodes, of ``jobs`` runs at once."""

    def rows_of(run: str) -> tuple[Array, Places]:
        scored = view.scored[run]
        rows, at = [np.empty((0, scored.samples))], [np.empty(0, dtype=np.intp)]
        for candidate in (candidate for candidate in candidates if candidate.site is None):
            found = np.atleast_2d(candidate.suspect.columns(view, run))[:, scored.first :]
            alive = found.any(axis=1)
            rows.append(found if alive.all() else found[alive])
            at.append(np.flatnonzero(alive) + candidate.columns.start)
        return np.concatenate(rows), np.concatenate(at)

    found = dict(zip(view.runs, spread(rows_of, view.runs, jobs=jobs), strict=True))
    values, places = {run: rows for run, (rows, _) in found.items()}, {run: at for run, (_, at) in found.items()}
    return SparseRows(values, places, candidates[-1].columns.stop if candidates else 0)


def rich_residual(columns: Columns, noise: NoiseModel) -> dict[str, Array]:
    """What is left of each run after tangents, nuisance and the bank: the noise, whatever is hidden.

    Under a white noise not every sample is needed for that.
    """
    from scipy.linalg import solve

    seen = columns.thinned() if noise.flat else columns
    normal = normal_equations(seen.residual, seen.kinds, noise, columns.jobs)
    scale = np.sqrt(np.maximum(np.diag(normal.gram), 1e-300))
    matrix = normal.gram / np.outer(scale, scale) + RIDGE * np.eye(scale.size)
    return columns.less(solve(matrix, normal.right / scale, assume_a="pos") / scale)


def screen(columns: Columns, noise: NoiseModel, seed: int = 0, known: Array | None = None) -> Screen:
    """Score every candidate. The threshold is the 99 % quantile of the best merit when nothing is hidden, simulated.

    ``known`` is the Gram matrix of an earlier screen with the same nuisance, bank and noise.
    """
    normal = normal_equations(columns.residual, columns.kinds, noise, columns.jobs, known)
    projected = project_out(normal, columns.precision.size, columns.precision)
    numbers = columns.tangents.size
    findings = [judge(candidate, projected, numbers) for candidate in columns.candidates]
    ordered = sorted((found for found in findings if found is not None), key=lambda finding: -finding.merit)
    threshold = max(0.0, _null_quantile(columns.candidates, projected, seed))
    return Screen(tuple(ordered), threshold, projected, _together(projected), normal.gram[numbers:, numbers:])


def _together(projected: Projected) -> float:
    usable = np.diag(projected.spread) > KEPT * projected.original
    if not usable.any():
        return 0.0
    inverse, rank = independent(projected.spread[np.ix_(usable, usable)])
    return float(projected.scores[usable] @ inverse @ projected.scores[usable]) - rank


def usable_columns(candidate: Candidate, projected: Projected) -> Places:
    """The columns of a candidate of which enough is left, by their number among its own."""
    where = candidate.columns
    return np.flatnonzero(np.diag(projected.spread)[where] > KEPT * projected.original[where])


def judge(candidate: Candidate, projected: Projected, numbers: int) -> Finding | None:
    """What the places of a candidate explain beside the fixed rows, of which ``numbers`` are those of the model."""
    where = candidate.columns
    s, matrix = projected.scores[where], projected.spread[where, where]
    usable = usable_columns(candidate, projected)
    if usable.size == 0:
        return None
    judged = _judge_joint if candidate.suspect.joint else _judge_greedy
    return judged(candidate, s, matrix, usable, projected.samples, projected.absorbed[:numbers, where])


def _judge_joint(
    candidate: Candidate, s: Array, matrix: Array, usable: Places, samples: int, absorbed: Array
) -> Finding | None:
    inverse, rank = independent(matrix[np.ix_(usable, usable)])
    strengths = np.zeros(s.size)
    strengths[usable] = inverse @ s[usable]
    if candidate.suspect.sign and (strengths < 0.0).any():
        strengths[usable] = _positive(s[usable], matrix[np.ix_(usable, usable)])
        rank = int(np.count_nonzero(strengths))
    gain = float(2.0 * s @ strengths - strengths @ matrix @ strengths)
    if candidate.suspect.level and gain - _of_equal(s[usable], matrix[np.ix_(usable, usable)]) < rank * np.log(samples):
        return None
    atoms = tuple(zip(strengths.tolist(), candidate.suspect.grid, strict=True))
    merit = gain - (rank + candidate.suspect.unknowns) * np.log(samples)
    deviations = np.zeros(s.size)
    deviations[usable] = np.sqrt(np.maximum(np.diag(inverse), 0.0))
    return Finding(candidate, atoms, gain, merit, strengths, tuple(range(s.size)), deviations, absorbed)


def _of_equal(s: Array, matrix: Array) -> float:
    """The fall of chi square by columns of equal strengths."""
    return float(s.sum() ** 2 / max(matrix.sum(), 1e-300))


def _positive(s: Array, matrix: Array) -> Array:
    """The strengths (m,) of one sign that explain most."""
    from scipy.optimize import nnls

    scale = np.sqrt(np.diag(matrix))
    root = np.linalg.cholesky(matrix / np.outer(scale, scale) + RIDGE * np.eye(scale.size))
    return nnls(root.T, np.linalg.solve(root, s / scale))[0] / scale


def _judge_greedy(
    candidate: Candidate, s: Array, matrix: Array, usable: Places, samples: int, absorbed: Array
) -> Finding | None:
    """Add places of the grid one after the other, strengths of one sign, as long as the merit grows."""
    suspect = candidate.suspect
    best: Finding | None = None
    chosen: tuple[int, ...] = ()
    while len(chosen) < min(suspect.most, usable.size):
        options = [(*chosen, int(k)) for k in usable if k not in chosen]
        solved = [solve_places(s, matrix, option, suspect.sign) for option in options]
        chosen = options[int(np.argmax([gain for gain, _ in solved]))]
        gain, strengths = solved[options.index(chosen)]
        used = np.flatnonzero(strengths)
        chosen, strengths = tuple(chosen[k] for k in used), strengths[used]
        merit = gain - len(chosen) * (1 + suspect.unknowns) * np.log(samples)
        if not chosen or (best is not None and merit <= best.merit):
            break
        atoms = tuple((float(b), suspect.grid[k]) for b, k in zip(strengths, chosen, strict=True))
        part = matrix[np.ix_(chosen, chosen)]
        deviations = np.sqrt(np.maximum(np.diag(independent(part)[0]), 0.0))
        best = Finding(candidate, atoms, gain, float(merit), strengths, chosen, deviations, absorbed[:, chosen])
    return best


def solve_places(s: Array, matrix: Array, chosen: tuple[int, ...], sign: int) -> tuple[float, Array]:
    """The fall of chi square by some places, and their strengths (k,)."""
    index = np.array(chosen)
    part = matrix[np.ix_(index, index)]
    strengths = np.linalg.lstsq(part, s[index], rcond=1e-10)[0]
    if sign and (strengths < 0.0).any():
        keep = strengths > 0.0
        inner = np.zeros(index.size)
        if keep.any():
            inner[keep] = np.maximum(np.linalg.lstsq(part[np.ix_(keep, keep)], s[index][keep], rcond=1e-10)[0], 0.0)
        strengths = inner
    return float(2.0 * s[index] @ strengths - strengths @ part @ strengths), strengths


def independent(matrix: Array) -> tuple[Array, int]:
    """The inverse of a covariance in the directions that can be told apart, and how many these are."""
    scale = np.sqrt(np.diag(matrix))
    values, vectors = np.linalg.eigh(matrix / np.outer(scale, scale))
    keep = values > 1e-6 * values[-1]
    inverse = (vectors[:, keep] / values[keep]) @ vectors[:, keep].T
    return inverse / np.outer(scale, scale), int(keep.sum())


def _null_quantile(candidates: Sequence[Candidate], projected: Projected, seed: int) -> float:
    # the score vector of pure noise is normal with covariance `spread`; nothing is known of it but the largest merit
    scale = np.sqrt(np.maximum(projected.original, 1e-300))
    values, vectors = np.linalg.eigh(projected.spread / np.outer(scale, scale))
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    draws = (np.random.default_rng(seed).standard_normal((DRAWS, values.size)) @ root.T) * scale
    best = np.full(DRAWS, -np.inf)
    for candidate in candidates:
        where = candidate.columns
        matrix = projected.spread[where, where]
        usable = usable_columns(candidate, projected)
        if usable.size:
            part = matrix[np.ix_(usable, usable)]
            best = np.maximum(
                best, _null_merits(candidate.suspect, draws[:, where][:, usable], part, projected.samples)
            )
    return float(np.quantile(best, 1.0 - FALSE_ALARMS)) if np.isfinite(best).any() else 0.0


def _null_merits(suspect: Suspect, draws: Array, matrix: Array, samples: int) -> Array:
    if suspect.joint:
        inverse, rank = independent(matrix)
        return np.einsum("ij,jk,ik->i", draws, inverse, draws) - (rank + suspect.unknowns) * np.log(samples)
    admitted = np.maximum(draws, 0.0) if suspect.sign else draws
    return np.max(admitted**2 / np.diag(matrix), axis=1) - (1 + suspect.unknowns) * np.log(samples)

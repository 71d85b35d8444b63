"""Least squares of faults of runs beside a linearised model, from one Gram matrix a run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.jackknife import half_widths
from dashpot.diagnose.repeats import Key, Rows

Array = NDArray[np.float64]
Block = tuple[tuple[str, ...], int]  # runs with a fault of the same strengths, number of its kind

KEPT = 1e-11  # of the largest eigenvalue: what is less is not determined
LEFT = 1e-9  # of the square of a shape that has to be left beside the others


class FaultsBeside:
    """Tangents of all runs and shapes of single runs, or of several alike, fitted to the residuals together.

    Beforehand a fault is thought to be about as large as repeats differ by it, which is ``known`` (k,) by kind, else as
    what is left of its runs: offsets of all runs would else be as good as another curve. ``free`` says of each kind how
    many of its last shapes go along with the others.
    """

    def __init__(self, rows: Rows, known: Mapping[int, Array], free: Sequence[int]) -> None:
        self.rows, self.known, self.free = rows, known, free
        self.samples = sum(residual.size for residual in rows.residual.values())
        self._fixed = len(next(iter(rows.tangents.values())))
        first, self._places = self._fixed + 1, list[NDArray[np.intp]]()
        for kind in range(len(free)):
            columns = len(rows.shapes[next(iter(rows.residual)), kind])
            self._places.append(np.arange(first, first + columns))
            first += columns
        self._grams = {run: self._gram(run) for run in rows.residual}
        self._base = lru_cache(self._solved)

    def gain(self, key: Key, chosen: Iterable[Key]) -> float:
        """The nats that a fault explains beside others that are chosen, and beside its own free shapes."""
        return self.gain_of((key[0],), key[1], chosen)

    def gain_of(self, runs: tuple[str, ...], kind: int, chosen: Iterable[Key]) -> float:
        """The same of a fault that some runs have alike."""
        known, shapes = _blocks(chosen), len(self._places[kind])
        square = self._base(known)[2]
        before, after = (
            square - self._explained(known, (runs, kind), first) for first in (shapes - self.free[kind], 0)
        )
        return 0.5 * self.samples * float(np.log(max(before, 1e-300) / max(after, 1e-300)))

    def square_of(self, run: str, keys: Iterable[Key]) -> float:
        """The square of what the model and faults, found together, leave of the residual of a run."""
        rest = self._beside(run, keys)
        for key, strengths in self.strengths(keys).items():
            if key[0] == run:
                rest = rest - strengths @ self.rows.shapes[key]
        return max(float(rest @ rest), 1e-300)

    def half_widths(self, key: Key, keys: Iterable[Key]) -> Array:
        """Half of the 95 % intervals (k,) of the strengths of a fault that was found together with others."""
        mine = [key, *(other for other in keys if other[0] == key[0] and other != key)]
        shapes = np.concatenate([self.rows.shapes[one] for one in mine])
        found = half_widths(self._beside(key[0], keys), shapes, self.rows.pieces[key[0]])
        return found[: len(self.rows.shapes[key])]

    def _beside(self, run: str, keys: Iterable[Key]) -> Array:
        """What the model, found together with faults, leaves of the residual of a run with its faults."""
        return self.rows.residual[run] - self._base(_blocks(keys))[1][: self._fixed] @ self.rows.tangents[run]

    def strengths(self, keys: Iterable[Key]) -> dict[Key, Array]:
        """The strengths of faults found together."""
        known, first, found = _blocks(keys), self._fixed, dict[Key, Array]()
        solution = self._base(known)[1]
        for (run,), kind in known:
            count = len(self._places[kind])
            found[run, kind] = solution[first : first + count]
            first += count
        return found

    def _gram(self, run: str) -> Array:
        shapes = [self.rows.shapes[run, kind] for kind in range(len(self.free))]
        rows = np.concatenate([self.rows.tangents[run], self.rows.residual[run][None], *shapes])
        return np.asarray(rows @ rows.T)

    def _solved(self, blocks: tuple[Block, ...]) -> tuple[Array, Array, float]:
        """The inverse of the normal matrix, the solution, and the square that is left."""
        gram, right = self._normal(blocks)
        scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
        unit = np.outer(scale, scale)
        inverse = np.asarray(np.linalg.pinv(gram / unit, rcond=KEPT, hermitian=True) / unit)
        solution = inverse @ right
        square = sum(float(gram[self._fixed, self._fixed]) for gram in self._grams.values())
        return inverse, solution, square - float(solution @ right)

    def _normal(self, blocks: tuple[Block, ...]) -> tuple[Array, Array]:
        """The normal matrix of tangents and shapes, what is known of strengths added, and its right side."""
        own = {run: np.arange(self._fixed) for run in self._grams}
        ends = np.cumsum([self._fixed, *(len(self._places[kind]) for _, kind in blocks)])
        gram, right = np.zeros((ends[-1], ends[-1])), np.zeros(ends[-1])
        into = {run: np.arange(self._fixed) for run in self._grams}
        for (runs, kind), first, end in zip(blocks, ends, ends[1:], strict=False):
            mine = np.arange(first, end)
            gram[mine, mine] += self._precision(runs, kind)
            for run in runs:
                own[run] = np.append(own[run], self._places[kind])
                into[run] = np.append(into[run], mine)
        for run, whole in self._grams.items():
            gram[np.ix_(into[run], into[run])] += whole[np.ix_(own[run], own[run])]
            right[into[run]] += whole[own[run], self._fixed]
        return gram, right

    def _precision(self, runs: Sequence[str], kind: int) -> Array:
        """What is known of the strengths (k,) of a fault of some runs beforehand."""
        if kind in self.known:
            return np.asarray(np.maximum(self.known[kind], 1e-300) ** -2.0)
        expected = sum(float(self._grams[run][self._fixed, self._fixed]) for run in runs)
        sizes = np.sum([np.diag(self._grams[run])[self._places[kind]] for run in runs], axis=0)
        return np.asarray(sizes / max(expected, 1.0))

    def _explained(self, blocks: tuple[Block, ...], more: Block, first: int) -> float:
        """The square that the shapes of another fault from the ``first`` one on explain beside the ``blocks``."""
        runs, kind = more
        places = self._places[kind][first:]
        if not places.size:
            return 0.0
        inverse, solution, _ = self._base(blocks)
        across = np.zeros((places.size, solution.size))
        own, right = np.diag(self._precision(runs, kind)[first:]), np.zeros(places.size)
        for run in runs:
            whole = self._grams[run]
            own, right = own + whole[np.ix_(places, places)], right + whole[places, self._fixed]
            across[:, : self._fixed] += whole[places, : self._fixed]
            end = self._fixed
            for others, other in blocks:
                mine, end = slice(end, end + len(self._places[other])), end + len(self._places[other])
                if run in others:
                    across[:, mine] += whole[np.ix_(places, self._places[other])]
        scale = np.sqrt(np.maximum(np.diag(own), 1e-300))
        left = (own - across @ inverse @ across.T) / np.outer(scale, scale)
        values, vectors = np.linalg.eigh(left)
        rest = vectors.T @ ((right - across @ solution) / scale)
        kept = values > LEFT
        return float(np.sum(rest[kept] ** 2 / values[kept]))


def _blocks(keys: Iterable[Key]) -> tuple[Block, ...]:
    return tuple(((run,), kind) for run, kind in keys)

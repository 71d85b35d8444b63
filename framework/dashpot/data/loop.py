"""The mean loop of a slow test: force on the way in and on the way out over the same deflections."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .reversals import noise_threshold, stroke_edges

if TYPE_CHECKING:
    from scipy.sparse import csr_array

_SMALLEST_STROKE = 0.05
_FULL_STROKE = 0.8
_PARTIAL_STROKE = 0.2
_FEWEST_BINS, _MOST_BINS = 8, 400
_FEWEST_SAMPLES = 20


@dataclass(frozen=True)
class Loop:
    """Mean force (m,) N of the loading and of the unloading strokes over deflection (m,) m.

    A direction that was not measured is None. `count` is the number of full loops in the record.
    """

    deflection: np.ndarray
    loading: np.ndarray | None
    unloading: np.ndarray | None
    count: int

    @property
    def complete(self) -> bool:
        """Whether both directions were measured."""
        return self.loading is not None and self.unloading is not None

    @property
    def middle(self) -> np.ndarray:
        """Mean of both directions; of a single one that direction itself."""
        return np.mean([branch for branch in (self.loading, self.unloading) if branch is not None], axis=0)

    @property
    def half_width(self) -> np.ndarray:
        """Half the difference of both directions; NaN when there is one only."""
        if self.loading is None or self.unloading is None:
            return np.full_like(self.deflection, np.nan)
        return 0.5 * (self.loading - self.unloading)


def mean_loop(displacement: np.ndarray, force: np.ndarray) -> Loop:
    """Average the strokes of a slow test, displacement (n,) m and force (n,) N, on a common grid.

    Strokes over at least 80 % of the range count; the first one in each direction is left out if there are more, as
    the material beds in. Where a direction has no full stroke, its shorter strokes stand in.
    Raises ValueError when nothing moves.
    """
    loading, unloading, full = _strokes(displacement)
    grid = _grid(displacement, [strokes for strokes in (loading, unloading) if strokes])
    return Loop(
        deflection=0.5 * (grid[1:] + grid[:-1]),
        loading=_branch(displacement, force, loading, grid) if loading else None,
        unloading=_branch(displacement, force, unloading, grid) if unloading else None,
        count=min(full),
    )


def middle_of_loop(displacement: np.ndarray) -> csr_array:
    """The matrix (m, n) that makes the mid line out of a force (n,): the mean of the means of both directions.

    The strokes over the displacement (n,) m are those of `mean_loop`; a deflection that a direction has not seen has no
    row. Raises ValueError when nothing moves.
    """
    loading, unloading, _ = _strokes(displacement)
    chosen = [strokes for strokes in (loading, unloading) if strokes]
    grid = _grid(displacement, chosen)
    means = [_means(displacement, strokes, grid) for strokes in chosen]
    seen = np.all([mean.sum(axis=1) > 0.0 for mean in means], axis=0)
    return sum(means[1:], means[0])[seen] / len(means)


def _means(displacement: np.ndarray, strokes: list[tuple[int, int]], edges: np.ndarray) -> csr_array:
    """The matrix (bins, n) that makes the mean of every bin."""
    from scipy.sparse import csr_array

    samples, bins = _binned(displacement, strokes, edges)
    weights = 1.0 / np.bincount(bins, minlength=len(edges) - 1)[bins]
    return csr_array((weights, (bins, samples)), shape=(len(edges) - 1, len(displacement)))


def _binned(displacement: np.ndarray, strokes: list[tuple[int, int]], edges: np.ndarray) -> tuple[np.ndarray, ...]:
    """The samples of all strokes, and the bin of each."""
    samples = np.concatenate([np.arange(first, last + 1) for first, last in strokes])
    return samples, np.clip(np.searchsorted(edges, displacement[samples]) - 1, 0, len(edges) - 2)


def _strokes(displacement: np.ndarray) -> tuple[list[tuple[int, int]], list[tuple[int, int]], list[int]]:
    """First and last samples of the loading and of the unloading strokes that count, and how many are full ones."""
    edges = stroke_edges(displacement, _threshold(displacement))
    ends = list(zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True))
    ways, stroke = np.diff(displacement[edges]), float(np.ptp(displacement))
    loading, unloading = (_chosen(ends, side * ways, stroke) for side in (1.0, -1.0))
    return loading, unloading, [int(np.sum(side * ways >= _FULL_STROKE * stroke)) for side in (1.0, -1.0)]


def _threshold(displacement: np.ndarray) -> float:
    stroke = float(np.ptp(displacement))
    if stroke <= noise_threshold(displacement) or len(displacement) < _FEWEST_SAMPLES:
        raise ValueError(
            f"expected a slow test of {_FEWEST_SAMPLES} samples or more that moves further than its noise, got "
            f"{len(displacement)} samples over {stroke:.3g} m; give a quasi-static run"
        )
    return max(noise_threshold(displacement), _SMALLEST_STROKE * stroke)


def _chosen(ends: list[tuple[int, int]], ways: np.ndarray, stroke: float) -> list[tuple[int, int]]:
    full = [end for end, way in zip(ends, ways, strict=True) if way >= _FULL_STROKE * stroke]
    if full:
        return full[1:] or full
    return [end for end, way in zip(ends, ways, strict=True) if way >= _PARTIAL_STROKE * stroke]


def _grid(displacement: np.ndarray, chosen: list[list[tuple[int, int]]]) -> np.ndarray:
    """Edges of equal bins over the deflections which every direction has seen."""
    samples = [np.concatenate([displacement[first : last + 1] for first, last in strokes]) for strokes in chosen]
    start, stop = max(np.min(part) for part in samples), min(np.max(part) for part in samples)
    fewest = min(len(part) / len(strokes) for part, strokes in zip(samples, chosen, strict=True))
    return np.linspace(start, stop, int(np.clip(fewest, _FEWEST_BINS, _MOST_BINS)) + 1)


def _branch(
    displacement: np.ndarray, force: np.ndarray, strokes: list[tuple[int, int]], edges: np.ndarray
) -> np.ndarray:
    """Mean force of all strokes at the middle of every bin; empty bins lie between their neighbours."""
    count = len(edges) - 1
    samples, bins = _binned(displacement, strokes, edges)
    hits = np.bincount(bins, minlength=count)
    held = hits > 0
    places = np.bincount(bins, displacement[samples], count)[held] / hits[held]
    values = np.bincount(bins, force[samples], count)[held] / hits[held]
    return np.interp(0.5 * (edges[1:] + edges[:-1]), places, values)

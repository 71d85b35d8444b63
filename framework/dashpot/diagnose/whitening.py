"""The noise of each run: signals reduced to the band that was driven, in units of their noise.

Columns, tangents and residuals are averaged over as many samples as the driven band and its harmonics allow. In the
search all frequencies of a run weigh alike, and samples of its residual that follow from one another count as fewer; an
autoregressive filter that makes the noise white serves the tests of the final residual, the faults of single runs and
the detection limits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from dashpot.data.steady import parts_of

Array = NDArray[np.float64]
Precision = TypeVar("Precision", bound=np.floating[Any])

ORDER = 8
ROW = 0  # in place of a number of samples: of a row of a table the fundamental is kept
NYQUIST = 4.0 / np.pi**2  # of the square of a line at the end of the band is left by averages over blocks
HARMONICS = 5  # of the end of the driven band that the reduced records still hold


@dataclass(frozen=True, eq=False)
class _Effects:
    """Errors beside white noise: the share ``lost`` (k,) of what lies along each of the ``directions`` (k, kept)."""

    lost: Array
    directions: Array

    def whitened(self, white: NDArray[Precision]) -> NDArray[Precision]:
        """Signals (..., kept) without these shares."""
        if not self.lost.size:
            return white
        lost, directions = self.lost.astype(white.dtype), self.directions.astype(white.dtype)
        return np.asarray(white - (white @ directions.T * lost) @ directions, dtype=white.dtype)


@dataclass(frozen=True, eq=False)
class Noise:
    """For every run how many samples are averaged, and the prediction-error filter (order + 1,) of the residual.

    ``ROW`` stands for a row of a table, of which two values are kept. Filtered noise has variance one. ``filters`` in
    1/N; ``independent`` is the share of independent samples. ``admitted`` (k, kept) in N is what errors of the channel
    within its data sheet add to a run, each at one standard deviation.
    """

    steps: Mapping[str, int]
    filters: Mapping[str, Array] = field(default_factory=dict)
    independent: Mapping[str, float] = field(default_factory=dict)
    admitted: Mapping[str, Array] = field(default_factory=dict)
    _effects: dict[tuple[str, bool], _Effects] = field(default_factory=dict, init=False, repr=False)

    def kept(self, run: str, samples: int) -> int:
        """How many values are kept of so many samples."""
        return samples // self.steps[run] if self.steps[run] != ROW else 2

    def reduce(self, run: str, signals: Array) -> Array:
        """Signals (..., n) of a run averaged over blocks (..., kept); white noise keeps its deviation."""
        step = self.steps[run]
        if step == ROW:
            return parts_of(signals)
        kept = signals.shape[-1] // step
        if step == 1:
            return signals
        blocks = signals[..., : kept * step].reshape(*signals.shape[:-1], kept, step)
        return blocks @ np.full(step, step**-0.5)

    def reduce_shapes(self, run: str, shapes: Array) -> Array:
        """Shapes (k, n) of a run averaged over blocks (k, kept); zero for one beyond the band that they show."""
        reduced = self.reduce(run, shapes)
        if self.steps[run] == ROW:
            return np.zeros_like(reduced)  # no fault of a record
        gone = np.sum(reduced**2, axis=-1) < NYQUIST * np.sum(shapes**2, axis=-1)
        return np.where(gone[..., None], 0.0, reduced)

    def filter(self, run: str, reduced: Array) -> Array:
        """Reduced signals (..., kept) in units of the noise; the first values miss their past and are set to zero.

        What the data sheet of the channel admits is noise as well.
        """
        coefficients = self.filters[run]
        white = filtered(reduced, coefficients)
        if run not in self.admitted:
            return white
        return self._of_run(run, True, lambda: filtered(self.admitted[run], coefficients)).whitened(white)

    def beside_admitted(self, run: str, reduced: NDArray[Precision]) -> NDArray[Precision]:
        """Reduced signals (..., kept) in N, smaller along what the data sheet admits by as much as is noise there."""
        if run not in self.admitted:
            return reduced
        return self._of_run(run, False, lambda: np.sqrt(self.weight(run)) * self.admitted[run]).whitened(reduced)

    def _of_run(self, run: str, behind_filter: bool, white: Callable[[], Array]) -> _Effects:
        """The errors that the data sheet admits in a run, in units of white noise; asked for with every column."""
        if (run, behind_filter) not in self._effects:
            self._effects[run, behind_filter] = _effects_of(white())
        return self._effects[run, behind_filter]

    def whiten(self, run: str, signals: Array) -> Array:
        """Signals (..., n) of a run, reduced and in units of their noise."""
        return self.filter(run, self.reduce(run, signals))

    @property
    def counted(self) -> Noise:
        """The same, but a run weighs no more samples than are independent: its likelihood."""
        filters = {run: np.sqrt(self.independent.get(run, 1.0)) * found for run, found in self.filters.items()}
        return replace(self, filters=filters)

    def weight(self, run: str) -> float:
        """How much the square of a sample of a run counts under white noise, 1/N^2."""
        return float(self.independent.get(run, 1.0) * self.filters[run][0] ** 2)

    def with_white(self, deviations: Mapping[str, float]) -> Noise:
        """The same blocks under white noise of the given standard deviations in N."""
        return Noise(self.steps, {run: np.concatenate([[1.0 / s], np.zeros(ORDER)]) for run, s in deviations.items()})


def filtered(reduced: Array, coefficients: Array) -> Array:
    """Signals (..., kept) under a filter (order + 1,) of the past; the first values miss theirs and are set to zero."""
    if reduced.size == 0:
        return reduced.copy()
    if not coefficients[1:].any():
        return coefficients[0] * reduced  # asks for no past
    # all rows in one: what runs over from one into the next is what is set to zero
    white = np.convolve(reduced.ravel(), coefficients)[: reduced.size].reshape(reduced.shape)
    white[..., :ORDER] = 0.0
    return np.asarray(white, dtype=np.float64)


def whiten_effects(white: NDArray[Precision], admitted: Array) -> NDArray[Precision]:
    """Signals (..., kept) in units of white noise, made white where errors of known size act beside it.

    The errors add normal deviates times the rows of ``admitted`` (k, kept); along these the noise is larger.
    """
    return _effects_of(admitted).whitened(white)


def _effects_of(admitted: Array) -> _Effects:
    _, sizes, directions = np.linalg.svd(admitted, full_matrices=False)
    return _Effects(1.0 - (1.0 + sizes**2) ** -0.5, directions)


def independent_share(rest: Array) -> float:
    """The share of the samples (n,) that are independent: 1 of white noise, a few in n of a wave that repeats.

    n over the sum of the squared autocorrelation, here by the powers of its spectrum.
    Source: G. V. Bayley, J. M. Hammersley: The "effective" number of independent observations in an autocorrelated
    time series. J. R. Stat. Soc. Suppl. 8, 1946.
    """
    powers = np.abs(np.fft.rfft(rest)) ** 2
    squares = float(np.sum(powers**2))
    # of white noise the powers are exponentially distributed, and their squares are two squared means
    return min(4.0 * float(powers.sum()) ** 2 / (squares * rest.size), 1.0) if squares > 0.0 else 1.0


def reduction(dt: float, highest_frequency: float) -> int:
    """Over how many samples a run is averaged so that the harmonics of the driven band stay."""
    return max(1, int(1.0 / (2.0 * HARMONICS * highest_frequency * dt)))


def learn_filter(rest: Array, smallest: float) -> Array:
    """The prediction-error filter (order + 1,) of reduced noise ``rest`` (n,) N; see ``filter_of``."""
    return filter_of(covariance_of(rest, np.zeros(ORDER + 1)), rest.size, smallest)


def covariance_of(rest: Array, taken: Array) -> Array:
    """The autocovariance (order + 1,) in N^2 of noise of which a least-squares fit has left ``rest`` (n,).

    A fit with the hat matrix H leaves of white noise the autocovariance -trace(S H) / n times its variance at a lag
    with the shift S. That is ``taken`` (order + 1,), and is given back: the fit has followed what is slow.
    Source: K. J. Worsley et al.: A general statistical analysis for fMRI data. NeuroImage 15, 2002, appendix A.
    """
    lags = range(min(ORDER + 1, max(rest.size, 1)))
    found = np.array([rest[lag:] @ rest[: rest.size - lag] for lag in lags]) / max(rest.size, 1)
    return np.asarray(found + found[0] / (1.0 - taken[0]) * taken[: found.size])


def lagged(basis: Array, known: int = 0) -> Array:
    """The trace of the hat matrix of orthonormal rows (k, n) at each lag (order + 1,).

    Of a block of samples that begins with some ``known`` ones, which belong to the block before it, only the others
    count.
    """
    lags = range(min(ORDER + 1, max(basis.shape[1], 1)))
    pairs = ((basis[:, max(lag, known) :], basis[:, max(known - lag, 0) : -lag or None]) for lag in lags)
    return np.array([np.einsum("ij,ij->", late, early) for late, early in pairs])


def orthonormal(shapes: Array) -> Array:
    """An orthonormal basis (rank, n) of shapes (k, n)."""
    _, values, basis = np.linalg.svd(shapes, full_matrices=False)
    return np.asarray(basis[values > 1e-9 * max(values, default=0.0)])


def filter_of(covariance: Array, samples: int, smallest: float) -> Array:
    """The prediction-error filter (order + 1,) of an autocovariance (order + 1,), of the order with the lowest BIC.

    ``smallest`` is a deviation in N below which nothing is believed: the resolution of the simulation and the record.
    Source: the Yule-Walker equations.
    """
    from scipy.linalg import solve_toeplitz

    covariance = np.array([max(covariance[0] * (1.0 + 1e-9), smallest**2), *covariance[1:]])
    best, lowest, least = np.zeros(0), np.inf, np.inf
    for order in range(covariance.size if samples > 4 * ORDER else 1):
        past = solve_toeplitz(covariance[:order], covariance[1 : order + 1]) if order else np.zeros(0)
        variance = float(covariance[0] - past @ covariance[1 : order + 1])
        if not 0.0 < variance <= least:
            break  # no autocovariance of any noise beyond this lag
        least, variance = variance, max(variance, smallest**2)
        bic = samples * np.log(variance) + order * np.log(max(samples, 1))
        if bic < lowest:
            best, lowest = np.concatenate([[1.0], -past, np.zeros(ORDER - order)]) / np.sqrt(variance), bic
    return best

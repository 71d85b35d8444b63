"""What repeated runs have in common, and what they have not: the noise of the force without a model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .alignment import NotRepeatsError, common_span, lag_between, shifted_by

_PIECES = 16
_LARGEST_DIFFERENCE = 0.1
# The motion ends where its spectrum has fallen this far below its largest line; real differences may be faster.
_SPECTRUM_END = 1e-3
_FASTER = 3.0
_GUARD = 10


# of the deviation: what reading and writing a number may change
LAST_DIGIT = 1e-9


@dataclass(frozen=True)
class Repeats:
    """k repeated runs on one time base: displacement and force (k, n) and their lags (k,) in samples.

    `departure` (k, n) N is the force of each run less the mean of all, after the part that small differences of the
    displacement explain.
    """

    displacement: np.ndarray
    force: np.ndarray
    lags: np.ndarray
    departure: np.ndarray


def is_same_to_the_last_digit(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two signals are one: a test may prescribe it, and a file may be there twice."""
    if one.size != other.size or not np.allclose(one[:64], other[:64], rtol=LAST_DIGIT, atol=0.0):
        return False
    return bool(np.max(np.abs(one - other)) <= LAST_DIGIT * float(np.std(one)))


def compare_repeats(runs: Sequence[tuple[np.ndarray, np.ndarray]], sample_time: float) -> Repeats:
    """Align repeated runs, given as (displacement m, force N), and compensate their small differences of motion.

    The force is corrected by the tangent stiffness and the damping that the mean run itself shows piece by piece,
    times the difference of the displacement; not in a piece where that makes the runs differ more, as where the motion
    rests and shows no tangent. Raises NotRepeatsError when displacements differ by more than a tenth, and
    when there are too few samples.
    """
    if len(runs) < 2:
        raise NotRepeatsError(f"expected at least two repeated runs, got {len(runs)}; name the runs that repeat it")
    lags = np.array([0.0] + [lag_between(runs[0][0], displacement) for displacement, _ in runs[1:]])
    start, stop = common_span(len(runs[0][0]), [(len(run[0]), lag) for run, lag in zip(runs, lags, strict=True)])
    displacement, force = (
        np.stack([shifted_by(run[channel], lag, start, stop) for run, lag in zip(runs, lags, strict=True)])
        for channel in (0, 1)
    )
    _require_likeness(displacement)
    explained = _explained_by_motion(displacement, force, sample_time)
    departure = force - explained
    return Repeats(displacement, force, lags, departure - departure.mean(axis=0))


def _require_likeness(displacement: np.ndarray) -> None:
    around = displacement - displacement.mean(axis=1, keepdims=True)
    difference = np.sqrt(np.mean((around - around.mean(axis=0)) ** 2))
    motion = np.sqrt(np.mean(around.mean(axis=0) ** 2))
    if difference > _LARGEST_DIFFERENCE * motion:
        raise NotRepeatsError(
            f"expected repeated runs to have one motion, got displacements that differ by {difference:.3g} m of "
            f"{motion:.3g} m (RMS); correct `repeats:` in the dataset"
        )


def _explained_by_motion(displacement: np.ndarray, force: np.ndarray, sample_time: float) -> np.ndarray:
    mean = displacement.mean(axis=0)
    difference = _smooth(displacement - mean, _end_of_spectrum(mean))
    velocity = np.gradient(_smooth(mean[None], _end_of_spectrum(mean))[0], sample_time)
    stiffness, damping = _tangents(mean, velocity, force.mean(axis=0))
    explained = stiffness * difference + damping * np.gradient(difference, sample_time, axis=1)
    for piece in _pieces(force.shape[1]):
        if _spread(force[:, piece] - explained[:, piece]) > _spread(force[:, piece]):
            explained[:, piece] = 0.0
    return explained


def _pieces(samples: int) -> list[np.ndarray]:
    return np.array_split(np.arange(samples), _PIECES)


def _spread(forces: np.ndarray) -> float:
    return float(np.sum((forces - forces.mean(axis=0)) ** 2))


def _tangents(displacement: np.ndarray, velocity: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tangent stiffness and damping at every sample, from a fit of force = f0 + k x + k2 x^2 + d v in every piece."""
    stiffness, damping = np.empty_like(force), np.empty_like(force)
    for piece in _pieces(len(force)):
        x, v = displacement[piece] - displacement[piece].mean(), velocity[piece]
        columns = np.stack([np.ones_like(x), x, x**2, v], axis=1)
        scale = np.maximum(np.max(np.abs(columns), axis=0), np.finfo(float).tiny)
        _, linear, square, viscous = np.linalg.lstsq(columns / scale, force[piece], rcond=1e-6)[0] / scale
        stiffness[piece], damping[piece] = linear + 2.0 * square * x, viscous
    return stiffness, damping


def _end_of_spectrum(signal: np.ndarray) -> float:
    """Where the motion ends, in cycles per sample."""
    lines = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(len(signal))))
    return float(np.flatnonzero(lines >= _SPECTRUM_END * lines.max())[-1] / len(signal))


def _smooth(signals: np.ndarray, end: float) -> np.ndarray:
    from scipy.signal import butter, sosfiltfilt

    cutoff = 2.0 * _FASTER * max(end, _GUARD / signals.shape[1])
    if cutoff >= 1.0:
        return signals
    return sosfiltfilt(butter(4, cutoff, output="sos"), signals, axis=1)

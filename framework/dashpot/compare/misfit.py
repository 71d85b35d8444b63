"""What a model gets wrong, in the engineer's words: which part of the stiffness, and where."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.compare.bands import frequency_bands
from dashpot.compare.conditions import STEADY, Conditions, conditions_of
from dashpot.data.order_tracking import Oscillation, harmonics_of
from dashpot.data.run import Run
from dashpot.data.tracking import track
from dashpot.text.quantity import pretty

Array = NDArray[np.float64]

SMALLEST_SHARE = 0.05
NOTABLE = 1.5  # one end of the amplitudes stands out when its error is this much larger than at the other end
OPPOSITE = 0.2  # an error of the other sign is told of from this part of the larger one on
HARMONICS = {
    "even": "second harmonic not reproduced (one-sided effect)",
    "odd": "third and fifth harmonic not reproduced (symmetric nonlinear effect)",
    "mean": "mean force wrong",
}


@dataclass(frozen=True)
class Misfit:
    """One kind of error: ``what`` in words, its ``share`` of the squared misfit, ``where`` it is largest."""

    what: str
    share: float
    where: Mapping[str, str]


@dataclass(frozen=True, eq=False)
class _Parts:
    """One run: squared misfit by kind (windows,) N^2, mean error of both stiffnesses N/m, frequency (windows,) Hz.

    ``weights`` (windows,) is the share of the time for which a window stands, ``total`` the mean square of the residual
    in N^2, and ``share`` the part of it that is of each kind.
    """

    conditions: Conditions
    energy: Mapping[str, Array]
    error: Mapping[str, float]
    frequency: Array
    weights: Array
    total: float
    share: Mapping[str, float]

    def size(self, kind: str) -> Array:
        """How wrong each window is: an error of stiffness counts as stiffness, or long strokes were always worst."""
        energy = self.energy[kind]
        return energy / max(self.conditions.amplitude, 1e-9) ** 2 if kind in self.error else energy

    def mean_size(self, kind: str) -> float:
        """How wrong it is over the time."""
        return float(self.size(kind) @ self.weights)


def describe_misfit(runs: Sequence[Run], residuals: Mapping[str, Array]) -> list[Misfit]:
    """The kinds of error by share, largest first; residuals (n,) are measured minus simulated, N, by run."""
    parts = [part for run in runs if (part := _split(run, residuals[run.name])) is not None]
    if not parts:
        return _by_run(runs, residuals)
    total = sum(part.total for part in parts) or 1.0
    shares = {kind: sum(part.total * part.share[kind] for part in parts) / total for kind in parts[0].energy}
    found = [
        Misfit(_words(kind, parts), share, _where(kind, parts))
        for kind, share in shares.items()
        if share >= SMALLEST_SHARE
    ]
    return sorted(found, key=lambda misfit: -misfit.share)


def _split(run: Run, residual: Array) -> _Parts | None:
    oscillation = track(run)
    if oscillation is None:
        return None
    orders = harmonics_of(residual, oscillation, confident=False)
    half = 0.5 * np.nan_to_num(orders.sine**2 + orders.cosine**2)
    energy = {
        "storage": 0.5 * orders.sine[:, 0] ** 2,
        "loss": 0.5 * orders.cosine[:, 0] ** 2,
        "even": half[:, 1],
        "odd": half[:, 2] + half[:, 4],
        "mean": orders.offset**2,
    }
    weights, covered = _times(oscillation)
    error = {"storage": float(orders.storage @ weights), "loss": float(orders.loss @ weights)}
    total = float(np.mean(residual**2))
    inside = float(np.mean(np.where(covered, residual**2, 0.0))) / (total or 1.0)
    whole = float((orders.offset**2 + half.sum(axis=1) + orders.noise**2) @ weights) or 1.0
    share = {kind: inside * float(values @ weights) / whole for kind, values in energy.items()}
    return _Parts(conditions_of(run, oscillation), energy, error, orders.frequency, weights, total, share)


def _times(oscillation: Oscillation) -> tuple[Array, NDArray[np.bool_]]:
    """The share (windows,) of samples for which each window stands, the nearest one, and for which (n,) any does.

    These are the ones in which the motion oscillates in windows, or beside them by half of their length: windows end
    before a record does.
    """
    windows, count = oscillation.orders.windows, len(oscillation.angle)
    turns, beside = np.zeros(count + 1), (windows.stop - windows.start) // 2
    np.add.at(turns, np.maximum(windows.start - beside, 0), 1.0)
    np.add.at(turns, np.minimum(windows.stop + beside, count), -1.0)
    covered = (np.cumsum(turns[:-1]) > 0.0) & np.isfinite(oscillation.angle)
    middles = oscillation.time / oscillation.sample_time
    nearest = np.searchsorted(0.5 * (middles[1:] + middles[:-1]), np.flatnonzero(covered))
    return np.bincount(nearest, minlength=middles.size) / nearest.size, covered


def _words(kind: str, parts: Sequence[_Parts]) -> str:
    if kind in HARMONICS:
        return HARMONICS[kind]
    levels = _by_level(parts, lambda part: part.conditions.amplitude)
    errors = {level: float(np.mean([part.error[kind] for part in group])) for level, group in levels.items()}
    sizes = {level: _size(kind, group) for level, group in levels.items()}
    return f"{kind} stiffness of the model {_too(errors, sizes)}"


def _too(errors: Mapping[float, float], sizes: Mapping[float, float]) -> str:
    """ "too small at small amplitude and too large at large amplitude", or less of it."""
    low, high = min(errors), max(errors)
    ends = {"small": errors[low], "large": errors[high]}
    worst = "small" if abs(ends["small"]) >= abs(ends["large"]) else "large"
    other = "large" if worst == "small" else "small"
    if ends[worst] * ends[other] < -OPPOSITE * ends[worst] ** 2:
        return f"{_side(ends[worst])} at {worst} amplitude and {_side(ends[other])} at {other} amplitude"
    if sizes[low] > NOTABLE * sizes[high]:
        return f"{_side(ends['small'])} at small amplitude"
    if sizes[high] > NOTABLE * sizes[low]:
        return f"{_side(ends['large'])} at large amplitude"
    return _side(errors[max(sizes, key=sizes.__getitem__)])


def _side(error: float) -> str:
    # measured minus simulated
    return "too small" if error > 0.0 else "too large"


def _size(kind: str, parts: Sequence[_Parts]) -> float:
    return float(np.sqrt(np.mean([part.mean_size(kind) for part in parts])))


def _by_level(parts: Sequence[_Parts], level: Callable[[_Parts], float]) -> dict[float, list[_Parts]]:
    found: dict[float, list[_Parts]] = {}
    for part in parts:
        found.setdefault(level(part), []).append(part)
    return found


def _where(kind: str, parts: Sequence[_Parts]) -> dict[str, str]:
    """The amplitude, the preload and the band with the largest error; a condition that all runs share is left out."""
    amplitudes = _by_level(parts, lambda part: part.conditions.amplitude)
    preloads = _by_level(parts, lambda part: part.conditions.preload)
    found = {"amplitude": pretty(_heaviest(kind, amplitudes), "m", 2)}
    if len(preloads) > 1:
        found["preload"] = pretty(_heaviest(kind, preloads), "m", 2)
    band = _band(kind, parts)
    return found | ({"band": band} if band else {})


def _heaviest(kind: str, levels: Mapping[float, Sequence[_Parts]]) -> float:
    return max(levels, key=lambda level: _size(kind, levels[level]))


def _band(kind: str, parts: Sequence[_Parts]) -> str:
    if any(part.conditions.frequency is None for part in parts):
        return _worst_band(kind, parts)
    steady = _by_level(parts, lambda part: part.conditions.frequency or 0.0)
    return f"{_heaviest(kind, steady):.3g} Hz" if max(steady) > STEADY * min(steady) else ""


def _worst_band(kind: str, parts: Sequence[_Parts]) -> str:
    frequency = np.concatenate([part.frequency for part in parts])
    size = np.concatenate([part.size(kind) for part in parts])
    bands = frequency_bands(float(frequency.min()), float(frequency.max()))
    means = [_mean_inside(size, frequency, *band) for band in bands]
    low, high = bands[int(np.argmax(means))]
    return f"{low:.3g} to {high:.3g} Hz"


def _mean_inside(size: Array, frequency: Array, low: float, high: float) -> float:
    inside = (frequency >= low) & (frequency <= high)
    return float(size[inside].mean()) if inside.any() else 0.0


def _by_run(runs: Sequence[Run], residuals: Mapping[str, Array]) -> list[Misfit]:
    squares = {run.name: float(np.mean(residuals[run.name] ** 2)) for run in runs}
    total = sum(squares.values()) or 1.0
    worst = max(squares, key=lambda name: squares[name])
    return [
        Misfit(
            f"force wrong, most of all in run '{worst}'",
            1.0,
            {"run": worst, "share of this run": f"{squares[worst] / total:.0%}"},
        )
    ]

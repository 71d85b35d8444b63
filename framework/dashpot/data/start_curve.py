"""A rough spring curve from dynamic runs alone, to start an identification where no slow test was made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .monotone import RisingBasis, solve_rising

_SPANS = 6
_MOST_SAMPLES, _MOST_IN_ALL = 5000, 100_000
_SMOOTHNESS = 0.05
_SLOW = 0.05


@dataclass(frozen=True)
class StartCurve:
    """Rough rising table of force (m,) N over deflection (m,) m, with damping N s/m, friction N and stiffening N/m.

    stiffening is what motion around the mean of a run adds to the slope; 0 when runs have no different preloads.
    """

    deflection: np.ndarray
    force: np.ndarray
    damping: float
    friction: float
    stiffening: float


def curve_from_sweeps(runs: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray]], knots: int = 12) -> StartCurve:
    """Fit all runs, given as (displacement m, velocity m/s, force N), by one rising curve, a damper and friction.

    The range covered by any run is covered; gaps are bridged smoothly. Good for start values only: relaxation and
    frequency are not looked at. Raises ValueError when there is no run or nothing moves.
    """
    displacement, velocity, force, around = _gather(runs)
    stroke = float(np.ptp(displacement)) if len(displacement) else 0.0
    if not stroke > 0.0:
        raise ValueError("expected runs that move, got none; give a sweep, harmonic or random run")
    basis = RisingBasis(float(np.min(displacement)), float(np.max(displacement)), _SPANS)
    speed = float(np.sqrt(np.mean(velocity**2))) or 1.0
    sliding = velocity / np.hypot(velocity, _SLOW * speed)
    extra = np.stack([velocity / speed, sliding, around / stroke], axis=1)
    height = float(np.ptp(force)) or 1.0
    columns = np.hstack([basis.columns(displacement), extra])
    penalty = np.hstack([_SMOOTHNESS * basis.slope_changes(), np.zeros((basis.size - 1, extra.shape[1]))])
    constant, weights = solve_rising(columns, force / height, penalty)
    damping, friction, stiffening = height * weights[basis.size :]
    places = np.linspace(basis.start, basis.stop, knots)
    curve = height * (constant + basis.columns(places) @ weights[: basis.size])
    return StartCurve(places, curve, float(damping / speed), float(friction), float(stiffening / stroke))


def curve_from_stiffness(preloads: np.ndarray, stiffness: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Force (m,) N at growing places (m,) m whose slope is the mean stiffness (k,) N/m at each preload (k,) m.

    It is zero where the deflection is; between two preloads the slope goes along a straight line, beyond them it stays.
    """
    known = np.unique(preloads)
    means = np.array([np.mean(stiffness[preloads == place]) for place in known])
    slopes = np.interp(places, known, means)
    force = np.append(0.0, np.cumsum(0.5 * (slopes[1:] + slopes[:-1]) * np.diff(places)))
    return force - np.interp(0.0, places, force)


def _gather(runs: Sequence[tuple[np.ndarray, np.ndarray, np.ndarray]]) -> tuple[np.ndarray, ...]:
    """Samples of all runs one after the other, thinned, and the distance from the mean where means differ."""
    most = min(_MOST_SAMPLES, max(_MOST_IN_ALL // max(len(runs), 1), 1))
    thinned = [tuple(channel[:: max(1, len(channel) // most)] for channel in run) for run in runs]
    if not thinned:
        return (np.zeros(0),) * 4
    displacement, velocity, force = (np.concatenate(channel) for channel in zip(*thinned, strict=True))
    around = np.concatenate([run[0] - np.mean(run[0]) for run in thinned])
    preloads = [np.mean(run[0]) for run in thinned]
    distinct = np.ptp(preloads) > np.sqrt(2.0) * np.max([np.std(run[0]) for run in thinned])
    return displacement, velocity, force, around if distinct else np.zeros_like(around)

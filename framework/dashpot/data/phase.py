"""The phase of an oscillation whose frequency may change: sweeps, steady harmonic motion, blocks of both."""

from __future__ import annotations

import numpy as np

from .orders import TURN
from .reversals import noise_threshold, turning_points, typical_swing

# Half-cycles belong together while neighbours differ by less than this in length and in stroke.
_LIKENESS = 2.5
_FEWEST_HALF_CYCLES = 4
_SMALLEST_SWING = 0.1
_HALF_CYCLES_PER_KNOT = 8
_PERIODS_PER_KNOT = 3.0
_PASSES = 2
_RIDGE = 1e-10


class NotOscillatingError(ValueError):
    """The motion is not a sweep nor a harmonic one, so that it has no phase to follow."""


def track_phase(displacement: np.ndarray) -> np.ndarray:
    """Phase (n,) rad of the oscillation in a measured displacement (n,), NaN where it does not oscillate.

    The turning points give a first phase; it is then corrected by the phase of the first order, whose amplitude and
    phase are smooth splines with two periods between knots: a band-pass that follows the frequency.
    x is X sin(phase) around its mean; every oscillating stretch starts anew. Holds and ramps are left out.

    Raises NotOscillatingError when fewer than four half-cycles of like length and stroke follow each other anywhere.
    """
    swing = typical_swing(displacement)
    points = turning_points(displacement, max(noise_threshold(displacement), _SMALLEST_SWING * swing))
    angle = np.full(len(displacement), np.nan)
    for stretch in _like_half_cycles(points, displacement):
        _lay_phase(angle, stretch, displacement)
    if not np.isfinite(angle).any():
        raise NotOscillatingError(
            "expected an oscillation (a sweep or a harmonic run), got a displacement that never turns round "
            "regularly; use a sweep or harmonic run, or give the frequency law if the run is one"
        )
    return angle


def phase_of_frequency(frequency: np.ndarray, sample_time: float) -> np.ndarray:
    """Phase (n,) rad of a known frequency law (n,) Hz: its integral over time, by the trapezoidal rule."""
    steps = 0.5 * (frequency[1:] + frequency[:-1]) * sample_time
    if np.any(steps <= 0.0):
        raise ValueError("expected a frequency law in Hz above zero everywhere, got one that is not; correct the law")
    return TURN * np.concatenate([[0.0], np.cumsum(steps)])


def _like_half_cycles(points: np.ndarray, displacement: np.ndarray) -> list[np.ndarray]:
    length = np.log(np.diff(points))
    stroke = np.log(np.abs(np.diff(displacement[points])))
    change = np.maximum(np.abs(np.diff(length)), np.abs(np.diff(stroke)))
    breaks = np.flatnonzero(change > np.log(_LIKENESS)) + 1
    groups = np.split(np.arange(len(length)), breaks)
    return [points[group[0] : group[-1] + 2] for group in groups if len(group) >= _FEWEST_HALF_CYCLES]


def _lay_phase(angle: np.ndarray, points: np.ndarray, displacement: np.ndarray) -> None:
    """Phase pi more at every half-way crossing, a smooth curve between them, straightened by the motion itself."""
    from scipy.interpolate import make_lsq_spline

    times = _crossings(displacement, points)
    counted = np.pi * np.arange(len(times))
    inner = times[_HALF_CYCLES_PER_KNOT:-_HALF_CYCLES_PER_KNOT:_HALF_CYCLES_PER_KNOT]
    knots = np.concatenate([[times[0]] * 4, inner, [times[-1]] * 4])
    # A half-cycle more on each side: a sine begins and ends at its mean.
    first, last = 2.0 * times[0] - times[1], 2.0 * times[-1] - times[-2]
    inside = np.arange(max(0, int(np.ceil(first))), min(len(angle), int(last) + 1))
    phase = make_lsq_spline(times, counted, knots)(inside)
    for _ in range(_PASSES):
        phase = _straighten(phase, displacement[inside])
    angle[inside] = np.maximum.accumulate(phase)


def _crossings(signal: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Where the signal crosses the middle between two turning points; noise moves these less than the points."""
    times = []
    for first, last in zip(points[:-1], points[1:], strict=True):
        stroke = signal[first : last + 1] - 0.5 * (signal[first] + signal[last])
        before = int(np.sum(stroke * stroke[0] > 0.0))
        step = stroke[before] - stroke[before - 1]
        times.append(first + before - float(np.clip(stroke[before] / step if step else 0.0, 0.0, 1.0)))
    return np.array(times)


def _straighten(phase: np.ndarray, displacement: np.ndarray) -> np.ndarray:
    """Add what the phase lacks: x = m + a cos theta + b sin theta with smooth m, a, b (knots every two periods)."""
    from scipy.interpolate import BSpline
    from scipy.sparse import diags_array, eye_array, hstack
    from scipy.sparse.linalg import spsolve

    phase = np.maximum.accumulate(phase)
    spans = max(1, int((phase[-1] - phase[0]) / (TURN * _PERIODS_PER_KNOT)))
    inner = np.linspace(phase[0], phase[-1], spans + 1)
    knots = np.concatenate([[phase[0]] * 3, inner, [phase[-1]] * 3])
    smooth = BSpline.design_matrix(phase, knots, 3)
    columns = hstack([smooth, diags_array(np.cos(phase)) @ smooth, diags_array(np.sin(phase)) @ smooth]).tocsc()
    # A motion that is not harmonic may leave a part undetermined: it then stays zero.
    ridge = _RIDGE * len(phase) * eye_array(columns.shape[1])
    _, cosine, sine = np.split(spsolve((columns.T @ columns + ridge).tocsc(), columns.T @ displacement), 3)
    # x - m = X sin(theta + lead)
    return phase + np.unwrap(np.arctan2(smooth @ cosine, smooth @ sine))

"""What kind of run a motion is, and its settings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from dashpot.data.reversals import turning_points
from dashpot.data.triangles import TURNS, is_triangle

_FEW_CYCLES, _SLOW_CYCLE = 4.0, 4.0
_EVEN, _SMOOTH, _SWEPT = 0.05, 0.25, 1.5
_TWICE = 1.9  # periods of a record that may show that a motion comes again
_SAME_COURSE, _ENDS = 0.1, 3  # of frequencies over time, as a share; half periods at either end


@dataclass(frozen=True)
class Motion:
    """The kind of a run, and numbers of its test in SI: those that its kind has."""

    kind: str
    settings: Mapping[str, float]


def find_motion(displacement: np.ndarray, step: float) -> Motion:
    """The kind and settings of a displacement (n,) m sampled every `step` s."""
    span = float(np.ptp(displacement))
    if span == 0 or _rests(displacement, span):
        return Motion("hold", {"preload": float(np.median(displacement))})
    large = turning_points(displacement, 0.25 * span)
    slow = _period(large, len(displacement)) * step >= _SLOW_CYCLE
    places = turning_points(displacement, TURNS * span)
    if is_triangle(displacement):
        return Motion("quasi_static" if slow else "transient", _of_triangle(displacement[places]))
    few = len(large) / 2 <= _FEW_CYCLES
    if few and slow:
        return Motion("quasi_static", {})
    if few:
        again = _comes_again(displacement, places, _EVEN * span) or _is_sine(displacement, places, _EVEN * span)
        kind = "harmonic" if again else "transient"
    else:
        # from turn to the next but one: up and down need not take the same time
        kind = _kind_of(_without_ends(step * (places[2:] - places[:-2])))
    return Motion(kind, _settings(kind, displacement, step * places, step))


def _rests(displacement: np.ndarray, span: float) -> bool:
    """Whether nearly nothing moves after the first fifth: a step, then rest."""
    return bool(np.ptp(displacement[len(displacement) // 5 :]) < 0.05 * span)


def _period(turns: np.ndarray, samples: int) -> float:
    """The samples of a cycle after its turns; all of them where these tell no half of one."""
    return 2.0 * float(turns[-1] - turns[0]) / (len(turns) - 1) if len(turns) > 1 else float(samples)


def _comes_again(displacement: np.ndarray, turns: np.ndarray, most: float) -> bool:
    """Whether a motion of about two cycles or more is the same a period later, to ``most`` as a root mean square."""
    if len(turns) < 2:
        return False
    period = round(_period(turns, len(displacement)))
    later = displacement[period:] - displacement[:-period]
    return bool(len(displacement) >= _TWICE * period and np.sqrt(np.mean(later**2)) < most)


def _is_sine(displacement: np.ndarray, turns: np.ndarray, most: float) -> bool:
    """Whether a sine departs from a motion of a cycle or more between its turns by less than ``most``, as above."""
    if len(turns) < 3:
        return False
    phase = 2.0 * np.pi / _period(turns, len(displacement)) * np.arange(len(displacement))
    basis = np.stack([np.ones_like(phase), np.sin(phase), np.cos(phase)], axis=1)
    rest = displacement - basis @ np.linalg.lstsq(basis, displacement, rcond=None)[0]
    return bool(np.sqrt(np.mean(rest**2)) < most)


def _without_ends(periods: np.ndarray) -> np.ndarray:
    """The periods without the first and last ones, where a test is ramped in and out."""
    margin = min(2, (len(periods) - 3) // 2)
    return periods[margin : len(periods) - margin] if margin > 0 else periods


def _kind_of(periods: np.ndarray) -> str:
    if periods.size < 3:
        return "transient"
    middle = np.median(periods)
    low, high = np.quantile(periods, (0.1, 0.9))
    if np.mean(np.abs(periods / middle - 1)) < _EVEN or high - low < _EVEN * middle:
        return "harmonic"
    changes = np.abs(np.diff(np.log(periods)))
    return "sweep" if np.median(changes) < _SMOOTH and high > _SWEPT * low and _trends(periods) else "random"


def _trends(periods: np.ndarray) -> bool:
    """Whether a smooth course explains nearly all of how the periods change, in one direction or up and down."""
    logs = np.log(periods)
    place = np.linspace(-1.0, 1.0, len(logs))
    course = np.polynomial.Polynomial.fit(place, logs, min(6, len(logs) - 1))(place)
    return bool(np.var(logs - course) < 0.2 * np.var(logs))


def _settings(kind: str, displacement: np.ndarray, turns: np.ndarray, step: float) -> dict[str, float]:
    low, high = np.quantile(displacement, (0.02, 0.98))
    settings = {"amplitude": float(high - low) / 2, "preload": float(high + low) / 2}
    if kind == "harmonic":
        inner = _without_ends(turns)
        return {**settings, "frequency": float(0.5 * (len(inner) - 1) / (inner[-1] - inner[0]))}
    if kind == "sweep":
        start, stop = _swept(turns, step * len(displacement))
        return {**settings, "start": start, "stop": stop}
    return {"preload": settings["preload"]} if kind == "random" else {}


def _of_triangle(turns: np.ndarray) -> dict[str, float]:
    """Amplitude and preload of a triangle that turns at these places (n,) m; none where its strokes differ."""
    strokes, middles = np.abs(np.diff(turns)), 0.5 * (turns[1:] + turns[:-1])
    low, high = np.quantile(strokes, (0.1, 0.9))
    if high - low > _EVEN * np.median(strokes):
        return {}
    return {"amplitude": 0.5 * float(np.median(strokes)), "preload": float(np.median(middles))}


def _swept(turns: np.ndarray, duration: float) -> tuple[float, float]:
    """The frequencies at both ends of a sweep, from the line or the exponential through those between the turns.

    Where neither describes them, as with sines one after the other, they are those of the first and last periods.
    """
    when, frequency = 0.5 * (turns[1:] + turns[:-1]), 0.5 / np.diff(turns)
    ends = np.array([0.0, duration])
    best, found = _SAME_COURSE, (float(np.median(frequency[:_ENDS])), float(np.median(frequency[-_ENDS:])))
    for bend, back in ((np.asarray, np.asarray), (np.log, np.exp)):
        course = np.polynomial.Polynomial.fit(when, bend(frequency), 1)
        miss = float(np.mean(np.abs(back(course(when)) / frequency - 1)))
        at_ends = back(course(ends))
        if miss < best and np.all(at_ends > 0):
            best, found = miss, (float(at_ends[0]), float(at_ends[1]))
    return found

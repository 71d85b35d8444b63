"""The clock of a run: is it even, may it be taken as even, or must the run be laid on an even grid?"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from dashpot.data.trouble import Trouble, Unusable

JITTER = 0.01
LONGEST_GAP = 20.0


@dataclass(frozen=True)
class Clock:
    """`step` in s between samples; `remark` says why the samples are not evenly spaced, None when they are.

    `longest` is the longest step in s of a clock that is uneven, 0 where it is even.
    """

    step: float
    remark: str | None = None
    longest: float = 0.0


def read_clock(time: np.ndarray, where: Callable[[int], str]) -> Clock:
    """The clock of the sample times (n,) in s.

    Even is a clock with less than 1 % (RMS) jitter and no gap, or one that differs from a straight line by no more than
    the rounding of its digits. Raises Unusable when the time runs backwards, stands still, or has a gap of more than 20
    samples; `where` puts a sample into words.
    """
    steps = np.diff(time)
    _refuse_backwards(time, steps, where)
    step = _mean_step(time)
    if step > 0 and (_jitters_little(steps, step) or _is_rounded(time, step)):
        # ten digits: what the summation leaves behind them is not measured
        return Clock(float(f"{step:.10g}"))
    _refuse_standstill(time, steps, where)
    typical = float(np.median(steps))
    _refuse_gap(time, steps, typical, where)
    longest = int(np.argmax(steps))
    remark = (
        f"its sample time varies from {1e3 * steps.min():.4g} to {1e3 * steps.max():.4g} ms (longest at "
        f"{time[longest]:.6g} s); it was laid on an even grid of {1e3 * typical:.4g} ms"
    )
    return Clock(typical, remark, float(steps[longest]))


def lay_on_grid(time: np.ndarray, values: np.ndarray, step: float) -> np.ndarray:
    """Values on the even grid from the first sample on, by monotone cubics (no overshoot).

    Raises Unusable where they rise more steeply than numbers can tell.
    Source: Fritsch, Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300.
    """
    from scipy.interpolate import PchipInterpolator

    with np.errstate(over="ignore"):
        steep = ~np.isfinite(np.diff(values) / np.diff(time))
    if steep.any():
        at = int(np.argmax(steep))
        message = f"it jumps from {values[at]:.3g} to {values[at + 1]:.3g} within {time[at + 1] - time[at]:.3g} s"
        raise Unusable([Trouble(message, "check the units, and whether the file is damaged")])
    count = int((time[-1] - time[0]) / step * (1 + 1e-12)) + 1
    return PchipInterpolator(time, values)(np.minimum(time[0] + step * np.arange(count), time[-1]))


def _mean_step(time: np.ndarray) -> float:
    """The slope of the straight line through the sample times."""
    number = np.arange(time.size) - (time.size - 1) / 2
    return float(number @ (time - time.mean()) / (number @ number))


def _jitters_little(steps: np.ndarray, step: float) -> bool:
    deviation = np.abs(steps / step - 1)
    return bool(np.sqrt(np.mean(deviation**2)) < JITTER and deviation.max() < 0.5)


def _is_rounded(time: np.ndarray, step: float) -> bool:
    """Whether the digits explain all deviations from a straight line. One or two slips alone are lost samples."""
    digit = _last_digit(time)
    line = time.mean() + step * (np.arange(time.size) - (time.size - 1) / 2)
    if np.abs(time - line).max() > 0.51 * digit:
        return False
    _, counts = np.unique(np.round(np.diff(time) / digit), return_counts=True)
    return bool(counts.sum() - counts.max() > 2)


def _last_digit(time: np.ndarray) -> float:
    """The power of ten that all times are multiples of; 0 when they have more than nine digits behind the point."""
    for digits in range(10):
        scaled = time * 10.0**digits
        if np.abs(scaled - np.round(scaled)).max() < 1e-4:
            return 10.0**-digits
    return 0.0


def _refuse_backwards(time: np.ndarray, steps: np.ndarray, where: Callable[[int], str]) -> None:
    back = np.flatnonzero(steps < 0)
    if back.size:
        at = int(back[0])
        message = f"its time runs backwards at {where(at + 1)}: from {time[at]:.6g} s to {time[at + 1]:.6g} s"
        raise Unusable([Trouble(message, "cut one piece out of the file with 'rows: [first, last]'")])


def _refuse_standstill(time: np.ndarray, steps: np.ndarray, where: Callable[[int], str]) -> None:
    still = np.flatnonzero(steps == 0)
    if still.size:
        at = int(still[0])
        message = f"its time does not advance at {where(at + 1)}: {time[at]:.6g} s comes twice"
        raise Unusable([Trouble(message, "say 'sampling: ... Hz' in place of the time channel if the rate is known")])


def _refuse_gap(time: np.ndarray, steps: np.ndarray, typical: float, where: Callable[[int], str]) -> None:
    gaps = np.flatnonzero(steps > LONGEST_GAP * typical)
    if gaps.size:
        at = int(gaps[0])
        more = f", and {gaps.size - 1} more" if gaps.size > 1 else ""
        message = f"it has a gap from {time[at]:.6g} s to {time[at + 1]:.6g} s, at {where(at + 1)}{more}"
        start, stop = _longest_piece(time, gaps)
        raise Unusable(
            [Trouble(message, f"the longest piece without gaps is 'start: {start:.6g} s, stop: {stop:.6g} s'")]
        )


def _longest_piece(time: np.ndarray, gaps: np.ndarray) -> tuple[float, float]:
    starts, stops = np.concatenate([[0], gaps + 1]), np.concatenate([gaps, [time.size - 1]])
    longest = int(np.argmax(time[stops] - time[starts]))
    return float(time[starts[longest]]), float(time[stops[longest]])

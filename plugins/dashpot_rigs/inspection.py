"""A platform under a wheel that rests, then shakes it slower and slower: the motion of inspection tests."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dashpot.contract.rig import PORT, PlannedRun, PrescribedPath
from dashpot_rigs.smooth_step import smooth_step


def inspection_runs(
    name: str,
    amplitude: float,
    start: float,
    stop: float,
    duration: float,
    rest: float,
    steady: float,
    added_masses: Sequence[float],
    node: str,
    sampling: float,
) -> list[PlannedRun]:
    """A run for each mass added to the wheel: ``rest`` s still, ``steady`` s at ``start`` Hz, then down to ``stop``.

    ValueError for a test that cannot be driven or sampled.
    """
    if min(amplitude, stop, duration) <= 0.0 or start <= stop or min(rest, steady) < 0.0:
        raise ValueError(
            "expected amplitude, stop and duration of more than 0, a start above the stop, and neither "
            "rest nor steady below 0"
        )
    if sampling < 20.0 * start:
        raise ValueError(f"sampling: expected at least 20 samples a cycle of {start:g} Hz, got {sampling:g} Hz")
    time = np.arange(round((rest + steady + duration) * sampling) + 1) / sampling
    path = falling_sine(time - rest, amplitude, start, stop, steady, duration)
    settings = {"amplitude": amplitude, "start": start, "stop": stop}
    return [
        PlannedRun(
            f"{name}_m{mass:.6g}".replace(".", "p"),
            "sweep",
            1.0 / sampling,
            {node or PORT: path},
            {**settings, "added_mass": mass},
        )
        for mass in added_masses
    ]


def falling_sine(
    time: np.ndarray, amplitude: float, start: float, stop: float, steady: float, duration: float
) -> PrescribedPath:
    """A sine in m from time 0 on whose frequency falls evenly after ``steady`` s; its amplitude fades in meanwhile."""
    climb = (stop - start) / duration
    falling = np.clip(time - steady, 0.0, duration)
    turn = 2.0 * np.pi * (start + climb * falling)
    turn_rate = np.where((time > steady) & (time <= steady + duration), 2.0 * np.pi * climb, 0.0)
    phase = 2.0 * np.pi * (start * np.maximum(time, 0.0) + 0.5 * climb * falling**2)
    level, level_rate, level_second = smooth_step(np.maximum(time, 0.0), 0.5 * steady)
    sine, cosine = np.sin(phase), np.cos(phase)
    return PrescribedPath(
        amplitude * level * sine,
        amplitude * (level_rate * sine + level * turn * cosine),
        amplitude
        * (level_second * sine + 2.0 * level_rate * turn * cosine + level * (turn_rate * cosine - turn**2 * sine)),
    )

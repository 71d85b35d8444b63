"""What a rig makes of its plan: its servo follows late, and what goes beyond stroke, speed or force is made smaller."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from dashpot.contract.bench import Bench
from dashpot.contract.limits import Limits
from dashpot.contract.rig import PlannedRun, PrescribedPath, Rig
from dashpot.kernel.lowpass import smoothed
from dashpot.text.problem import InputError, Place

if TYPE_CHECKING:
    from collections.abc import Callable

NOTE = "limited"
"""The note of a run that says what the rig made of it."""

LENGTHS = ("amplitude", "depth", "rms")  # settings that shrink with the motion
SPEEDS = ("speed", "velocity")
FULL = 0.995  # of the speed, from which on nobody needs to be told
CLOSE, ROUNDS = 0.99, 20  # of the largest force, within so many trials


@dataclass(frozen=True)
class Planned(Rig):
    """Runs that are planned already."""

    word = "planned"
    plan: Sequence[PlannedRun]

    def runs(self) -> Sequence[PlannedRun]:
        """As they are."""
        return self.plan


def as_driven(bench: Bench, largest_force: Callable[[PlannedRun], float]) -> Bench:
    """The bench with its runs as the rig can drive them; each that is not as planned has a note that says so.

    ``largest_force`` is what a motion costs, in N. It is asked only where the force has a limit. InputError for a
    specimen that presses with more than that while the rig rests at its first place.
    """
    within = [_within(run, bench.limits, largest_force) for run in bench.runs()]
    return replace(bench, rigs=(Planned(within),), limits=Limits())


def _within(run: PlannedRun, limits: Limits, largest_force: Callable[[PlannedRun], float]) -> PlannedRun:
    followed, words = run, []
    if math.isfinite(limits.bandwidth):
        followed = _followed(run, limits.bandwidth)
        share = _rms_speed(followed) / (_rms_speed(run) or 1.0)
        words += [f"the servo of {limits.bandwidth:g} Hz reaches {share:.3g} of the speed"] * (share < FULL)
    for what, unit, bound, found in (
        ("stroke", "mm", 1e3 * limits.stroke, 1e3 * _stroke(followed)),
        ("speed", "m/s", limits.speed, _speed(followed)),
    ):
        if found > bound:
            followed = _smaller(followed, bound / found)
            words.append(f"{what} {found:.4g} {unit}, at most {bound:.4g} {unit}: {_made(bound / found)}")
    if math.isfinite(limits.force) and (found := largest_force(followed)) > limits.force:
        factor = _bearable(followed, limits.force, largest_force)
        followed = _smaller(followed, factor)
        words.append(f"force {found:.4g} N, at most {limits.force:.4g} N: {_made(factor)}")
    return replace(followed, notes={**run.notes, NOTE: "; ".join(words)}) if words else followed


def _followed(run: PlannedRun, bandwidth: float) -> PlannedRun:
    """The run behind a low-pass of first order, T dy/dt + y = x."""
    lag = 1.0 / (2.0 * np.pi * bandwidth)

    def late(path: PrescribedPath) -> PrescribedPath:
        place = smoothed(path.displacement[None], np.array([lag]), run.sample_time)[0]
        speed = (path.displacement - place) / lag
        return PrescribedPath(place, speed, (path.velocity - speed) / lag)

    return replace(run, motion={node: late(path) for node, path in run.motion.items()})


def _smaller(run: PlannedRun, factor: float) -> PlannedRun:
    """The run with every motion shrunk towards its first place, and the settings that tell its size."""

    def shrunk(path: PrescribedPath) -> PrescribedPath:
        first = path.displacement[0]
        return PrescribedPath(
            first + factor * (path.displacement - first), factor * path.velocity, factor * path.acceleration
        )

    motion = {node: shrunk(path) for node, path in run.motion.items()}
    return replace(run, motion=motion, settings=_resized(run.settings, factor))


def _made(factor: float) -> str:
    return f"made {factor:.3g} times as large"


def _resized(settings: Mapping[str, float], factor: float) -> dict[str, float]:
    return {key: value * factor if key in (*LENGTHS, *SPEEDS) else value for key, value in settings.items()}


def _bearable(run: PlannedRun, limit: float, largest_force: Callable[[PlannedRun], float]) -> float:
    """The factor on the motion at which its largest force is between 99 and 100 % of the limit, by halving."""
    rest = largest_force(_smaller(run, 0.0))
    if rest >= limit:
        raise InputError.at(
            Place(run.name),
            f"the specimen presses with {rest:.4g} N at the first place of the run, the rig bears {limit:.4g} N",
            "begin elsewhere, or raise the limit",
        )
    low, high = 0.0, 1.0
    for _ in range(ROUNDS):
        middle = 0.5 * (low + high)
        found = largest_force(_smaller(run, middle))
        low, high = (middle, high) if found <= limit else (low, middle)
        if CLOSE * limit <= found <= limit:
            break
    return low


def _stroke(run: PlannedRun) -> float:
    return max(float(np.ptp(path.displacement)) for path in run.motion.values())


def _speed(run: PlannedRun) -> float:
    return max(float(np.max(np.abs(path.velocity))) for path in run.motion.values())


def _rms_speed(run: PlannedRun) -> float:
    """The root mean square of the speeds of all nodes."""
    return float(np.sqrt(np.mean([np.mean(path.velocity**2) for path in run.motion.values()])))

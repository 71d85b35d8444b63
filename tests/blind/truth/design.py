"""Which runs are driven: the full test design and poorer ones."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from .motion import Motion, along, sweep, triangle

START, STOP = 1.0, 25.0
SWEEP_DURATION, LOOP_DURATION = 5.0, 12.0
LOOP_DEPTH = 36e-3


@dataclass(frozen=True)
class Plan:
    """One run to be driven; `repeats` names the run whose path it repeats; `asked` is a motion of its own. SI units."""

    name: str
    amplitude: float = 0.0
    preload: float = 0.0
    repeats: str | None = None
    asked: Motion | None = field(default=None, compare=False, repr=False)

    @property
    def dynamic(self) -> bool:
        """Whether the run is a sweep, and not a quasi-static loop."""
        return self.amplitude > 0.0

    @property
    def path(self) -> tuple[float, float] | tuple[str]:
        """What identifies the driven path."""
        return (self.name,) if self.asked else (self.amplitude, self.preload)

    @property
    def motion(self) -> Motion:
        """The driven path itself."""
        return self.asked or drive(self.path)


@lru_cache(maxsize=32)
def drive(path: tuple[float, float]) -> Motion:
    """The motion of a path (amplitude, preload)."""
    amplitude, preload = path
    if amplitude == 0.0:
        return triangle(LOOP_DEPTH, LOOP_DURATION)
    return sweep(amplitude, preload, START, STOP, SWEEP_DURATION)


def further(displacement: np.ndarray, dt: float, number: int = 1) -> Plan:
    """A run that somebody asked for, along a displacement (n,) given every `dt`; it counts in no strength."""
    return Plan(f"asked_{number}", asked=along(displacement, dt))


def _sweeps(amplitudes: tuple[float, ...], preloads: tuple[float, ...]) -> tuple[Plan, ...]:
    return tuple(
        Plan(f"a{amplitude:g}_p{preload:g}".replace(".", ""), amplitude * 1e-3, preload * 1e-3)
        for amplitude in amplitudes
        for preload in preloads
    )


def _again(plan: Plan) -> Plan:
    return Plan(f"{plan.name}_b", plan.amplitude, plan.preload, repeats=plan.name)


_LOOP = Plan("qs")
_GRID = _sweeps((0.5, 1.0, 2.0, 5.0), (10.0, 20.0, 30.0))
_MIDDLE = Plan("a2_p20", 2e-3, 20e-3)

# 12 sweeps, 3 of them again, two quasi-static loops: 17 runs, 99 000 samples.
DESIGNS: dict[str, tuple[Plan, ...]] = {
    "full": (_LOOP, *_GRID, *(_again(_GRID[i]) for i in (1, 6, 11)), _again(_LOOP)),
    "no_quasi_static": (*_GRID, *(_again(_GRID[i]) for i in (1, 6, 11))),
    "no_repeats": (_LOOP, *_GRID),
    "amplitudes": (_LOOP, *_sweeps((0.5, 1.0, 2.0, 5.0), (20.0,)), _again(_MIDDLE)),
    "preloads": (_LOOP, *_sweeps((2.0,), (10.0, 20.0, 30.0)), _again(_MIDDLE)),
    "one_sweep": (_LOOP, _MIDDLE, _again(_MIDDLE)),
}

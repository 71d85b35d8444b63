"""Which runs are driven: the full test design and poorer ones."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache
from math import pi

import numpy as np

from .motion import Motion, along, random_waves, sum_of_sines, sweep, triangle

START, STOP = 1.0, 25.0
SWEEP_DURATION, LOOP_DURATION = 5.0, 12.0
LOOP_DEPTH = 36e-3
SINE_DURATION, FEWEST_CYCLES, RANDOM_DURATION = 2.0, 4.0, 10.0
SECOND_SHARE, SECOND_PHASE = 0.05, 1.0


@dataclass(frozen=True)
class Plan:
    """One run to be driven; `repeats` names the run whose path it repeats; `asked` is a motion of its own. SI units."""

    name: str
    amplitude: float = 0.0
    preload: float = 0.0
    repeats: str | None = None
    asked: Motion | None = field(default=None, compare=False, repr=False)

    @property
    def kind(self) -> str:
        """The word of the dataset for such a run."""
        return "transient" if self.asked else "sweep" if self.dynamic else "quasi_static"

    @property
    def dynamic(self) -> bool:
        """Whether the run is more than a quasi-static loop."""
        return self.amplitude > 0.0

    @property
    def path(self) -> tuple:
        """What identifies the driven path."""
        return (self.name,) if self.asked else (self.amplitude, self.preload)

    @property
    def motion(self) -> Motion:
        """The driven path itself."""
        return self.asked or drive(self.path)

    @property
    def settings(self) -> dict[str, str]:
        """What the dataset says of the run, by quantity."""
        if not self.dynamic:
            return {}
        return {**self._lengths, "start": f"{START:g} Hz", "stop": f"{STOP:g} Hz"}

    @property
    def _lengths(self) -> dict[str, str]:
        return {"amplitude": f"{self.amplitude * 1e3:g} mm", "preload": f"{self.preload * 1e3:g} mm"}


@dataclass(frozen=True)
class SinePlan(Plan):
    """A sine of one frequency [Hz]; `second` is the share of the second harmonic that the actuator adds."""

    frequency: float = 1.0
    second: float = 0.0

    @property
    def kind(self) -> str:
        return "harmonic"

    @property
    def path(self) -> tuple:
        return (self.amplitude, self.preload, self.frequency, self.second)

    @property
    def motion(self) -> Motion:
        waves = [(self.amplitude, self.frequency, 0.0)]
        waves += [(self.second * self.amplitude, 2.0 * self.frequency, SECOND_PHASE)] if self.second else []
        return sum_of_sines(self.preload, waves, max(SINE_DURATION, FEWEST_CYCLES / self.frequency))

    @property
    def settings(self) -> dict[str, str]:
        return {**self._lengths, "frequency": f"{self.frequency:g} Hz"}


@dataclass(frozen=True)
class RandomPlan(Plan):
    """Random motion of the root mean square `amplitude`; the phases come from the number `draw`."""

    draw: int = 0

    @property
    def kind(self) -> str:
        return "random"

    @property
    def path(self) -> tuple:
        return ("random", self.amplitude, self.preload, self.draw)

    @property
    def motion(self) -> Motion:
        return sum_of_sines(self.preload, random_waves(self.amplitude, START, STOP, self.draw), RANDOM_DURATION)

    @property
    def settings(self) -> dict[str, str]:
        return self._lengths


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


def _speeds(amplitude: float, preload: float, speeds: tuple[float, ...]) -> tuple[Plan, ...]:
    """One stroke [m] at several peak velocities [m/s], as dampers are tested."""
    return tuple(
        SinePlan(f"v{number}", amplitude, preload, frequency=round(speed / (2.0 * pi * amplitude), 3))
        for number, speed in enumerate(speeds, 1)
    )


def _sines(amplitudes: tuple[float, ...], preload: float, frequencies: tuple[float, ...]) -> tuple[SinePlan, ...]:
    """Every amplitude [m] at every frequency [Hz], as bushings are tested."""
    return tuple(
        SinePlan(f"a{number}_f{frequency:g}", amplitude, preload, frequency=frequency)
        for number, amplitude in enumerate(amplitudes, 1)
        for frequency in frequencies
    )


def _again(plan: Plan) -> Plan:
    return Plan(f"{plan.name}_b", plan.amplitude, plan.preload, repeats=plan.name)


_LOOP = Plan("qs")
_GRID = _sweeps((0.5, 1.0, 2.0, 5.0), (10.0, 20.0, 30.0))
_MIDDLE = Plan("a2_p20", 2e-3, 20e-3)
_SINES = _sines((0.5e-3, 2e-3, 5e-3), 20e-3, (1.0, 4.0, 10.0, 25.0))

# 12 sweeps, 3 of them again, two quasi-static loops: 17 runs, 99 000 samples.
DESIGNS: dict[str, tuple[Plan, ...]] = {
    "full": (_LOOP, *_GRID, *(_again(_GRID[i]) for i in (1, 6, 11)), _again(_LOOP)),
    "no_quasi_static": (*_GRID, *(_again(_GRID[i]) for i in (1, 6, 11))),
    "no_repeats": (_LOOP, *_GRID),
    "amplitudes": (_LOOP, *_sweeps((0.5, 1.0, 2.0, 5.0), (20.0,)), _again(_MIDDLE)),
    "preloads": (_LOOP, *_sweeps((2.0,), (10.0, 20.0, 30.0)), _again(_MIDDLE)),
    "one_sweep": (_LOOP, _MIDDLE, _again(_MIDDLE)),
    "few": (Plan("a1_p10", 1e-3, 10e-3), _MIDDLE, Plan("a2_p30", 2e-3, 30e-3), Plan("a5_p20", 5e-3, 20e-3)),
    "speeds": _speeds(10e-3, 20e-3, (0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8)),
    "sines": _SINES,
    "second_harmonic": tuple(replace(plan, second=SECOND_SHARE) for plan in _SINES),
    "random": tuple(
        RandomPlan(f"random_{number}", amplitude, preload, draw=number)
        for number, (amplitude, preload) in enumerate(((0.5e-3, 10e-3), (1e-3, 20e-3), (1.5e-3, 20e-3), (1e-3, 30e-3)))
    ),
}

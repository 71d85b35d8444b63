"""Two wheels on two platforms below a body that is held: equations of motion, with something hidden between two ends.

The wheels stand on linear tires with damping, hang on linear springs and shock absorbers, and share an anti-roll bar.
What is hidden acts between the ends of the tires, of the suspensions, or of the bar. Classical Runge-Kutta method; the
sliders' displacement is taken from the beginning of each step on.
"""

from __future__ import annotations

from dataclasses import astuple, dataclass, replace

import numpy as np
from numba import njit

from .form import log_uniform
from .motion import STEP, Motion

GRAVITY = 9.81
PLACES = ("tire", "suspension", "bar")
SLIDERS = 5


@dataclass(frozen=True)
class Numbers:
    """Of each side: wheel [kg], tire [N/m], loss [N s/m], spring [N/m], damping [N s/m]; and the bar [N/m]."""

    wheel: float
    tire: float
    loss: float
    spring: float
    damping: float
    bar: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Numbers:
        return cls(
            rng.uniform(35.0, 60.0),
            rng.uniform(180e3, 260e3),
            rng.uniform(80.0, 250.0),
            rng.uniform(20e3, 35e3),
            rng.uniform(1000.0, 2000.0),
            rng.uniform(6e3, 20e3),
        )

    def changed(self) -> list[Numbers]:
        """As many as there are numbers, in each of which another one is larger by a thousandth."""
        return [replace(self, **{name: 1.001 * value}) for name, value in vars(self).items()]


@dataclass(frozen=True)
class Inner:
    """A law between two ends: sliders (stiffness, limit), a power of velocity, Maxwell parts (stiffness, time)."""

    kind: str
    form: str
    place: str
    sliders: tuple[tuple[float, float], ...] = ()
    power: tuple[float, float] = (0.0, 1.0)
    maxwell: tuple[tuple[float, float], ...] = ()

    def sized(self, size: float) -> Inner:
        """The law with all its forces in proportion to ``size``."""
        return replace(
            self,
            sliders=tuple((size * stiffness, size * limit) for stiffness, limit in self.sliders),
            power=(size * self.power[0], self.power[1]),
            maxwell=tuple((size * stiffness, time) for stiffness, time in self.maxwell),
        )


def draw_inner(kind: str, rng: np.random.Generator) -> Inner:
    """A law of a kind at a random place, as large as one newton or so."""
    if kind == "friction":
        travels = log_uniform(rng, 0.05e-3, 0.3e-3) * np.geomspace(0.3, 3.0, int(rng.integers(2, SLIDERS + 1)))
        limits = rng.uniform(0.5, 1.5, travels.size)
        sliders = tuple((float(limit / travel), float(limit)) for limit, travel in zip(limits, travels, strict=True))
        return Inner(kind, "Sliders", str(rng.choice(PLACES)), sliders=sliders)
    if kind == "quadratic_damping":
        return Inner(kind, "NearlyQuadratic", str(rng.choice(PLACES[:2])), power=(1.0, rng.uniform(1.8, 2.2)))
    first = log_uniform(rng, 8e-3, 40e-3)
    maxwell = tuple((float(rng.uniform(0.5, 1.5)), first * spread) for spread in (1.0, rng.uniform(1.0, 4.0)))
    return Inner(kind, "TwoTimes", "tire", maxwell=maxwell)


def platform_forces(numbers: Numbers, motion: Motion, sides: tuple[float, float], inner: Inner | None) -> np.ndarray:
    """Forces on both platforms (2, steps), whose motions are ``sides`` times ``motion``."""
    law = inner or Inner("", "", PLACES[0])
    none = np.zeros((0, 2))
    return _integrate(
        np.array(astuple(numbers)),
        np.outer(sides, motion.displacement),
        np.outer(sides, motion.velocity),
        PLACES.index(law.place),
        np.array(law.sliders) if law.sliders else none,
        np.array(law.power),
        np.array(law.maxwell) if law.maxwell else none,
        STEP,
    )


@njit(cache=True)
def _hidden(place, ends, speeds, start, forces, sliders, power, memory):
    """Forces (2,) at both sites of a place; the bar has one."""
    found = np.zeros(2)
    for side in range(1 if place == 2 else 2):
        travel, speed = ends[side] - start[side], speeds[side]
        for k in range(sliders.shape[0]):
            trial = forces[side, k] + sliders[k, 0] * travel
            found[side] += min(max(trial, -sliders[k, 1]), sliders[k, 1])
        found[side] += power[0] * np.sign(speed) * abs(speed) ** power[1]
        found[side] += memory[side].sum()
    return found


@njit(cache=True)
def _ends(place, x, y, at):
    """The two numbers ``at`` 0 (place) or 2 (speed) between the ends of both sites."""
    if place == 0:
        return x - y[at : at + 2]
    if place == 1:
        return y[at : at + 2].copy()
    return np.array([y[at] - y[at + 1], 0.0])


@njit(cache=True)
def _rate(numbers, x, speed, y, memory, place, start, forces, sliders, power, maxwell):
    wheel, tire, loss, spring, damping, bar = numbers
    ends, speeds = _ends(place, x, y, 0), _ends(place, speed, y, 2)
    hidden = _hidden(place, ends, speeds, start, forces, sliders, power, memory)
    contact = tire * (x - y[:2]) + loss * (speed - y[2:])
    hung = spring * y[:2] + damping * y[2:]
    roll = bar * (y[0] - y[1])
    if place == 0:
        contact = contact + hidden
    elif place == 1:
        hung = hung + hidden
    else:
        roll += hidden[0]
    rates = np.empty(4)
    rates[:2] = y[2:]
    rates[2] = (contact[0] - hung[0] - roll) / wheel - GRAVITY
    rates[3] = (contact[1] - hung[1] + roll) / wheel - GRAVITY
    fades = np.zeros_like(memory)
    for k in range(maxwell.shape[0]):
        fades[:, k] = maxwell[k, 0] * speeds - memory[:, k] / maxwell[k, 1]
    return rates, fades, contact


@njit(cache=True)
def _integrate(numbers, path, speed, place, sliders, power, maxwell, step):
    count = path.shape[1]
    found = np.empty((2, count))
    y = np.zeros(4)
    y[:2] = -numbers[0] * GRAVITY / (numbers[1] + numbers[3]) + path[:, 0] * numbers[1] / (numbers[1] + numbers[3])
    memory, forces = np.zeros((2, maxwell.shape[0])), np.zeros((2, sliders.shape[0]))
    for n in range(count):
        x, v = path[:, n].copy(), speed[:, n].copy()
        start = _ends(place, x, y, 0)
        law = (place, start, forces, sliders, power, maxwell)
        one, fade_one, contact = _rate(numbers, x, v, y, memory, *law)
        found[:, n] = contact
        if n + 1 == count:
            break
        end, end_speed = path[:, n + 1].copy(), speed[:, n + 1].copy()
        half = 0.5 * step
        mid, mid_speed = 0.5 * (x + end) + step / 8.0 * (v - end_speed), 1.5 * (end - x) / step - 0.25 * (v + end_speed)
        two, fade_two, _ = _rate(numbers, mid, mid_speed, y + half * one, memory + half * fade_one, *law)
        three, fade_three, _ = _rate(numbers, mid, mid_speed, y + half * two, memory + half * fade_two, *law)
        four, fade_four, _ = _rate(numbers, end, end_speed, y + step * three, memory + step * fade_three, *law)
        y = y + step / 6.0 * (one + 2.0 * two + 2.0 * three + four)
        memory = memory + step / 6.0 * (fade_one + 2.0 * fade_two + 2.0 * fade_three + fade_four)
        travel = _ends(place, end, y, 0) - start
        for side in range(2):
            for k in range(sliders.shape[0]):
                trial = forces[side, k] + sliders[k, 0] * travel[side]
                forces[side, k] = min(max(trial, -sliders[k, 1]), sliders[k, 1])
    return found

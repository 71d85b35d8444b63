"""Axle on two platforms and quarter car as ordinary differential equations, from the physics, for solve_ivp.

z points up. A tire is squeezed by z_P - z_w + offset, a suspension by z_w - z_b + offset; the force presses its ends
apart. Friction begins without force, Maxwell elements are relaxed, the wheels rest in equilibrium.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import cos, sin

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq, fsolve
from verification.truth.motion import Cosines

GRAVITY = 9.81
SHARPNESS = 10.0
Numbers = Mapping[str, float]


class Curve:
    """The monotone cubic through a table for single numbers, continued by its end slopes, or held beyond its ends."""

    def __init__(self, at: Sequence[float], values: Sequence[float], held: bool = False) -> None:
        cubic = PchipInterpolator(at, values)
        self.at, self.pieces = list(map(float, at)), cubic.c.T.tolist()
        slope = cubic.derivative()
        first, last = (0.0, 0.0) if held else (float(slope(at[0])), float(slope(at[-1])))
        self.below, self.above = (float(values[0]), first), (float(values[-1]), last)

    def __call__(self, x: float) -> float:
        return self.both(x)[0]

    def both(self, x: float) -> tuple[float, float]:
        """Value and slope."""
        if x <= self.at[0]:
            return self.below[0] + self.below[1] * (x - self.at[0]), self.below[1]
        if x >= self.at[-1]:
            return self.above[0] + self.above[1] * (x - self.at[-1]), self.above[1]
        number = bisect_right(self.at, x) - 1
        third, second, first, none = self.pieces[number]
        u = x - self.at[number]
        return none + u * (first + u * (second + u * third)), first + u * (2.0 * second + 3.0 * u * third)


def dahl_rate(force: float, v: float, stiffness: float, limit: float) -> float:
    """dF/dt of a Dahl slider."""
    return stiffness * (v - abs(v) * force / limit)


def prandtl_rate(force: float, v: float, stiffness: float, limit: float) -> float:
    """dF/dt of a spring in series with a Dahl slider ten times as stiff."""
    left = max(1.0 - (force if v > 0.0 else -force) / limit, 0.0)
    return v * stiffness * SHARPNESS * left / (1.0 + SHARPNESS * left)


@dataclass
class Tire:
    """A parallel connection; its memories are those of the Maxwell elements, then the Prandtl ones, then Dahl's."""

    spring: Curve
    damping: float
    factor: Curve
    maxwells: list[tuple[float, float]]
    prandtls: list[tuple[float, float]]
    dahls: list[tuple[float, float]]

    @property
    def count(self) -> int:
        return len(self.maxwells) + len(self.prandtls) + len(self.dahls)

    def force(self, x: float, v: float, memory: Sequence[float]) -> float:
        return self.spring(x) + self.factor(x) * self.damping * v + sum(memory)

    def rates(self, v: float, memory: Sequence[float]) -> list[float]:
        first, second = len(self.maxwells), len(self.maxwells) + len(self.prandtls)
        relaxed = [k * v - f / time for f, (k, time) in zip(memory[:first], self.maxwells, strict=True)]
        slid = [prandtl_rate(f, v, *p) for f, p in zip(memory[first:second], self.prandtls, strict=True)]
        return relaxed + slid + [dahl_rate(f, v, *p) for f, p in zip(memory[second:], self.dahls, strict=True)]


@dataclass
class Strut:
    """A shock absorber, and behind it a mount of a spring and a damper, whose deflection is a memory; or no mount.

    Between the two is a ``rod`` that may have a mass; then its speed is a memory as well.
    """

    absorber: Curve
    mount: tuple[float, float] | None
    rod: float = 0.0

    def __post_init__(self) -> None:
        self.speed = 0.0

    def force(self, v: float, deflection: float, speed: float) -> tuple[float, float, float]:
        """The force on the wheel, and the rates of the mount's deflection and of the speed of the rod."""
        if self.mount is None:
            return self.absorber(v), 0.0, 0.0
        stiffness, damping = self.mount
        if self.rod > 0.0:
            force = self.absorber(v - speed)
            return force, speed, (force - stiffness * deflection - damping * speed) / self.rod - GRAVITY
        return *self._without_mass(v, deflection), 0.0

    @property
    def rest(self) -> float:
        """Where the weight of the rod rests on the mount."""
        return -self.rod * GRAVITY / self.mount[0] if self.mount else 0.0

    def _without_mass(self, v: float, deflection: float) -> tuple[float, float]:
        """Force and rate w of the mount's deflection: absorber(v - w) = k x + c w, which falls with w."""
        stiffness, damping = self.mount
        w, low, high = self.speed, -1e3, 1e3
        for number in range(200):
            value, slope = self.absorber.both(v - w)
            missing = value - stiffness * deflection - damping * w
            low, high = (w, high) if missing > 0.0 else (low, w)
            step = missing / (slope + damping)
            if abs(step) < 1e-14 + 1e-13 * abs(w):
                break
            newton = low < w + step < high and (number < 8 or number % 2)
            w = w + step if newton else 0.5 * (low + high)
        else:
            raise AssertionError("the mount did not find its rate")
        self.speed = w
        return stiffness * deflection + damping * w, w


@dataclass
class Axle:
    """Two wheels between platforms and a body that is held; see ``axle_of``."""

    mass: float
    tire: Tire
    offset: float
    spring: Curve
    friction: tuple[float, float]
    strut: Strut
    bar: float
    bar_friction: tuple[float, float]

    def side(self, y: Sequence[float], platform: float, speed: float) -> tuple[float, list[float], float]:
        """What pushes a wheel up besides bar and weight, the rates of the memories, and the force on the platform."""
        z, v, friction, deflection, rod, *memory = y
        tire = self.tire.force(platform - z + self.offset, speed - v, memory)
        strut, *of_rod = self.strut.force(v, deflection, rod)
        push = tire - self.spring(z) - friction - strut
        rates = [dahl_rate(friction, v, *self.friction), *of_rod, *self.tire.rates(speed - v, memory)]
        return push, rates, tire

    def equilibrium(self, platforms: Sequence[float]) -> np.ndarray:
        """Both places at rest."""

        def missing(z):
            bar = self.bar * (z[0] - z[1])
            return [
                self.tire.spring(p - place + self.offset) - self.spring(place) - side - self.mass * GRAVITY
                for p, place, side in zip(platforms, z, (bar, -bar), strict=True)
            ]

        found, _, status, message = fsolve(missing, [0.0, 0.0], xtol=1e-15, full_output=True)
        assert np.max(np.abs(missing(found))) < 1e-8, message
        return found

    def forces(self, left: Cosines, right: Cosines, times: np.ndarray) -> np.ndarray:
        """Forces on the platforms (2, n)."""
        count = 5 + self.tire.count
        moves = [scalar(left), scalar(right)]

        def sides(t, y):
            return [self.side(y[k * count : (k + 1) * count], *moves[k](t)) for k in (0, 1)]

        def rate(t, y):
            y = y.tolist()
            (push_left, rates_left, _), (push_right, rates_right, _) = sides(t, y)
            between = y[1] - y[count + 1]
            bar = self.bar * (y[0] - y[count]) + y[-1]
            return [
                y[1],
                (push_left - bar) / self.mass - GRAVITY,
                *rates_left,
                y[count + 1],
                (push_right + bar) / self.mass - GRAVITY,
                *rates_right,
                dahl_rate(y[-1], between, *self.bar_friction),
            ]

        rest = self.equilibrium([float(left.place(0.0)), float(right.place(0.0))])
        start = np.zeros(2 * count + 1)
        start[[0, count]] = rest
        start[[3, count + 3]] = self.strut.rest
        small = [1e-13, 1e-11, 1e-8, 1e-13, 1e-11, *[1e-8] * self.tire.count]
        states = integrate(rate, start, times, [*small, *small, 1e-8])
        return np.array([[side[2] for side in sides(t, y.tolist())] for t, y in zip(times, states.T, strict=True)]).T


@dataclass
class QuarterCar:
    """A wheel on a platform below a body that is free to move; see ``quarter_car_of``."""

    mass: float
    body: float
    tire: Tire
    offset: float
    stiffness: float
    suspension_offset: float
    damping: float
    friction: tuple[float, float]

    def force(self, motion: Cosines, times: np.ndarray) -> np.ndarray:
        """The force on the platform (n,)."""
        move = scalar(motion)

        def tire(t, y):
            place, speed = move(t)
            return self.tire.force(place - y[0] + self.offset, speed - y[1], ())

        def rate(t, y):
            y = y.tolist()
            v = y[1] - y[3]
            strut = self.stiffness * (y[0] - y[2] + self.suspension_offset) + self.damping * v + y[4]
            return [
                y[1],
                (tire(t, y) - strut) / self.mass - GRAVITY,
                y[3],
                strut / self.body - GRAVITY,
                dahl_rate(y[4], v, *self.friction),
            ]

        states = integrate(rate, self.equilibrium(float(motion.place(0.0))), times, [1e-13, 1e-11, 1e-13, 1e-11, 1e-8])
        return np.array([tire(t, y.tolist()) for t, y in zip(times, states.T, strict=True)])

    def equilibrium(self, platform: float) -> np.ndarray:
        """The suspension carries the body, the tire both."""
        carried = brentq(lambda x: self.tire.spring(x) - (self.mass + self.body) * GRAVITY, -1.0, 1.0, xtol=1e-16)
        wheel = platform + self.offset - carried
        return np.array([wheel, 0.0, wheel + self.suspension_offset - self.body * GRAVITY / self.stiffness, 0.0, 0.0])


def scalar(motion: Cosines):
    """Place and speed at a time, for single numbers."""
    terms = list(zip(motion.amplitudes.tolist(), motion.omegas.tolist(), strict=True))

    def move(t):
        return motion.mean + sum(a * cos(w * t) for a, w in terms), -sum(a * w * sin(w * t) for a, w in terms)

    return move


def integrate(rate, start, times, small) -> np.ndarray:
    """States (count, n) to ten digits. All rates are continuous; where a way turns they have a kink, which is why the
    steps are short."""
    found = solve_ivp(
        rate, (times[0], times[-1]), start, method="DOP853", rtol=1e-10, atol=small, t_eval=times, max_step=1e-3
    )
    assert found.success
    return found.y


def curve(numbers: Numbers, path: str, at: Sequence[float], held: bool = False) -> Curve:
    return Curve(at, [numbers[f"{path}[{k}]"] for k in range(len(at))], held)


def pairs(numbers: Numbers, names: Sequence[str], second: str) -> list[tuple[float, float]]:
    return [(numbers[f"{name}.stiffness"], numbers[f"{name}.{second}"]) for name in names]


def tire_of(numbers: Numbers, knots: Mapping[str, Sequence[float]], kind: str) -> Tire:
    """The tire of an axle: ``kelvin_voigt``, ``ftire`` or ``model_5``."""
    scale = "tire.damping.scale"
    several = [(), ("",), ("_1", "_2", "_3")][["kelvin_voigt", "ftire", "model_5"].index(kind)]
    damping = "tire.damping.damping"
    return Tire(
        curve(numbers, "tire.stiffness.stiffness", knots["tire.stiffness.stiffness"]),
        numbers[damping],
        curve(numbers, scale, knots[scale], held=True) if kind == "model_5" else Curve((0.0, 1.0), (1.0, 1.0), True),
        pairs(numbers, [f"tire.maxwell{end}" for end in several], "relaxation_time"),
        pairs(numbers, [f"tire.prandtl{end}" for end in several], "limit"),
        pairs(numbers, ["tire.friction"] if kind == "model_5" else [], "limit"),
    )


def axle_of(numbers: Numbers, knots: Mapping[str, Sequence[float]], kind: str, mount: bool, added: float) -> Axle:
    """The axle with the numbers at the paths of its file."""
    ahead = "strut." if "strut.shock_absorber.damping[0]" in numbers else ""
    absorber, rubber = f"{ahead}shock_absorber.damping", f"{ahead}top_mount"
    behind = (numbers[f"{rubber}.rubber.stiffness"], numbers[f"{rubber}.loss.damping"]) if mount else None
    (friction,) = pairs(numbers, ["friction"], "limit")
    (bar_friction,) = pairs(numbers, ["anti_roll_bar.friction"], "limit")
    return Axle(
        numbers["wheel_left.mass"] + added,
        tire_of(numbers, knots, kind),
        numbers["tire.offset"],
        curve(numbers, "suspension.stiffness", knots["suspension.stiffness"]),
        friction,
        Strut(curve(numbers, absorber, knots[absorber]), behind, numbers.get("rod_left.mass", 0.0)),
        numbers["anti_roll_bar.bar.stiffness"],
        bar_friction,
    )


def quarter_car_of(numbers: Numbers, knots: Mapping[str, Sequence[float]], added: float) -> QuarterCar:
    """The quarter car with the numbers at the paths of its file."""
    (friction,) = pairs(numbers, ["friction"], "limit")
    return QuarterCar(
        numbers["wheel.mass"] + added,
        numbers["body.mass"],
        tire_of(numbers, knots, "kelvin_voigt"),
        numbers["tire.offset"],
        numbers["suspension.stiffness"],
        numbers["suspension.offset"],
        numbers["shock_absorber.damping"],
        friction,
    )

"""The fixed work W2: axle_model_3 with Tire Model 5 on both wheels, swept from 5 to 20 Hz; its equations by hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from laws import Equations, Tongue, table_of
from numpy.typing import NDArray
from scipy.optimize import fsolve

from dashpot.contract.registry import load_registry
from dashpot.data.drive import drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.kernel.network import compile_network
from dashpot.kernel.system import CompiledSystem
from dashpot.model.reading import read_network

Array = NDArray[np.float64]

AXLE, DT = "axle_model_3", 1e-3
AMPLITUDE, SLOWEST, FASTEST, FADE = 3e-3, 5.0, 20.0, 0.5
ANGLES = (0.0, 0.5 * np.pi)  # of the platforms: between in phase and in anti-phase, so that the bar works
GRAVITY, MEMORIES = 9.81, 7
SIDE = 3 + MEMORIES  # place, velocity and friction of a wheel, then the memories of its tire
HELD = "tire.damping.scale"
TABLES = ("tire.stiffness.stiffness", HELD, "suspension.stiffness", "shock_absorber.damping")


def platform_in(smaller: Callable[..., Any]) -> Callable[..., Any]:
    """A function of time, length of the sweep and angle: place, velocity and acceleration of a platform."""

    def platform(t, seconds, angle):  # noqa: ANN001, ANN202
        u = smaller(t / FADE, 1.0)
        rise = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
        faster = 30.0 * u * u * (1.0 - u) ** 2 / FADE
        bend = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / FADE**2
        rate = 2.0 * np.pi * (FASTEST - SLOWEST) / seconds
        turning = 2.0 * np.pi * SLOWEST + rate * t
        phase = angle + 2.0 * np.pi * SLOWEST * t + 0.5 * rate * t * t
        sin, cos = AMPLITUDE * np.sin(phase), AMPLITUDE * np.cos(phase)
        return (
            rise * sin,
            faster * sin + rise * turning * cos,
            bend * sin + 2.0 * faster * turning * cos + rise * (rate * cos - turning * turning * sin),
        )

    return platform


@cache
def axle() -> CompiledSystem:
    """The network with the numbers of its file."""
    found = compile_network(read_network(AXLE, load_registry().elements))
    assert isinstance(found, CompiledSystem)
    return found


def excitation(seconds: float) -> Excitation:
    """Both platforms, with their exact rates."""
    times = DT * np.arange(round(seconds / DT))
    platform = platform_in(min)
    paths = [np.array([platform(t, seconds, angle) for t in times.tolist()]).T for angle in ANGLES]
    drives = {
        node: drive_from_path(DT, *map(np.ascontiguousarray, path))
        for node, path in zip(axle().outputs, paths, strict=True)
    }
    return Excitation(drives, {}, {}, DT, times.size, "W2")


def axle_lanes(count: int, seed: int = 1) -> Array:
    """Parameter vectors within a tenth of the file's, the first one as it is."""
    values = np.repeat(axle().start[None], count, axis=0)
    values[1:] *= np.exp(np.random.default_rng(seed).uniform(-0.1, 0.1, (count, 1)))[1:]
    return values


@dataclass(frozen=True, eq=False)
class AxleTask:
    """The axle on the sweep: ``score()`` scores all lanes, ``units`` is lanes times samples."""

    runs: tuple
    values: Array
    jobs: int = 1

    @classmethod
    def of(cls, seconds: float, count: int, jobs: int = 1) -> AxleTask:
        """The task of ``count`` lanes, the sweep once for every job."""
        return cls((axle().prepare(excitation(seconds)),) * jobs, axle_lanes(count), jobs)

    @property
    def units(self) -> int:
        """Lanes times samples."""
        return self.values.shape[0] * sum(run.excitation.samples for run in self.runs)

    def score(self) -> Array:
        """The scores (runs, nodes, lanes) against zero."""
        zeros = np.zeros((2, self.runs[0].excitation.samples))
        runs = len(self.runs)
        return axle().score(self.runs, [zeros] * runs, [zeros + 1.0] * runs, self.values, self.jobs)


def equations(seconds: float, tongue: Tongue) -> Equations:
    """The axle of the file as somebody would write it for an integrator, by hand."""
    read, dahl, prandtl = tongue.read, tongue.dahl, tongue.prandtl
    platform = tongue.compiled(platform_in(tongue.smaller))
    spec = axle().spec
    numbers = {slot.path: slot.value.number for slot in spec.slots()}
    tire, held, spring, absorber = (table_of(spec.curves()[path], path == HELD) for path in TABLES)
    laws = np.array(
        [
            *(
                (numbers[f"tire.maxwell_{k}.stiffness"], numbers[f"tire.maxwell_{k}.relaxation_time"])
                for k in (1, 2, 3)
            ),
            *((numbers[f"tire.prandtl_{k}.stiffness"], numbers[f"tire.prandtl_{k}.limit"]) for k in (1, 2, 3)),
            *(
                (numbers[f"{name}.stiffness"], numbers[f"{name}.limit"])
                for name in ("tire.friction", "friction", "anti_roll_bar.friction")
            ),
        ]
    )
    mass, offset, damping = numbers["wheel_left.mass"], numbers["tire.offset"], numbers["tire.damping.damping"]
    bar = numbers["anti_roll_bar.bar.stiffness"]

    @tongue.compiled
    def pressed(x, v, y, first):  # noqa: ANN001, ANN202
        total = read(tire, x) + damping * read(held, x) * v
        for k in range(MEMORIES):
            total += y[first + k]
        return total

    @tongue.compiled
    def rate(t, y, dy):  # noqa: ANN001, ANN202
        between = bar * (y[0] - y[SIDE]) + y[2 * SIDE]
        dy[2 * SIDE] = dahl(y[2 * SIDE], y[1] - y[SIDE + 1], laws[8])
        for side in range(2):
            b, place, speed = side * SIDE, 0.0, 0.0
            place, speed, _ = platform(t, seconds, ANGLES[side])
            x, v = place - y[b] + offset, speed - y[b + 1]
            push = pressed(x, v, y, b + 3) - read(spring, y[b]) - read(absorber, y[b + 1]) - y[b + 2]
            dy[b] = y[b + 1]
            dy[b + 1] = (push - (between if side == 0 else -between)) / mass - GRAVITY
            dy[b + 2] = dahl(y[b + 2], y[b + 1], laws[7])
            for k in range(3):
                dy[b + 3 + k] = laws[k, 0] * v - y[b + 3 + k] / laws[k, 1]
                dy[b + 6 + k] = prandtl(y[b + 6 + k], v, laws[3 + k])
            dy[b + 9] = dahl(y[b + 9], v, laws[6])

    @tongue.compiled
    def force(t, y):  # noqa: ANN001, ANN202
        left, right = platform(t, seconds, ANGLES[0]), platform(t, seconds, ANGLES[1])
        one = pressed(left[0] - y[0] + offset, left[1] - y[1], y, 3)
        return one, pressed(right[0] - y[SIDE] + offset, right[1] - y[SIDE + 1], y, SIDE + 3)

    side = [1e-6, 1e-3, *[1.0] * (SIDE - 2)]
    start = np.zeros(2 * SIDE + 1) if tongue.symbolic else rest(rate)
    return Equations(rate, force, start, np.array([*side, *side, 1.0]))


def rest(rate: Callable[..., None]) -> Array:
    """The state before anything moves."""
    start, dy = np.zeros(2 * SIDE + 1), np.zeros(2 * SIDE + 1)

    def pull(places: Array) -> list[float]:
        start[[0, SIDE]] = places
        rate(0.0, start, dy)
        return [dy[1], dy[SIDE + 1]]

    start[[0, SIDE]] = fsolve(pull, [0.0, 0.0], xtol=1e-12)
    return start

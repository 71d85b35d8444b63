"""A front axle on its platforms, the body held. None of its laws is an element of dashpot.

Per side: a tire (hardening carcass, many sliders, a spectrum of relaxation times), a wheel, a suspension spring with a
bump stop, a shock absorber with its rod in a rubber mount, friction of the links and seals that is higher at rest than
in motion; between the sides an anti-roll bar with friction in its bushings. The steps are leapfrog ones of 50 us.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numba import njit

STEP = 50e-6
GRAVITY = 9.81


@dataclass(frozen=True)
class CarTire:
    """Lengths in m, forces in N. Tangent ``stiffness`` at first contact, rising by ``hardening`` per m.

    The sliders' stiffness is spread evenly over the logarithm of their travels, that of the relaxation over its times,
    both from the first to the last.
    """

    stiffness: float = 185e3
    hardening: float = 2.2e6
    sliding_stiffness: float = 45e3
    travels: tuple[float, float] = (0.05e-3, 8e-3)
    relaxing_stiffness: float = 30e3
    times: tuple[float, float] = (2e-3, 0.5)
    damping: float = 35.0


@dataclass(frozen=True)
class Car:
    """What an axle is made of, in SI; the parameters hold at the wheel, for one side.

    ``rebound`` and ``compression`` are the slope at rest and the velocity at which the shock absorber has half of it.
    A ``mount_stiffness`` of infinity is a rod that is bolted to the body.
    """

    wheel_mass: float = 47.5
    tire: CarTire = field(default_factory=CarTire)
    spring: float = 24e3
    spring_hardening: float = 60e3
    spring_force: float = 3500.0
    bump_at: float = 0.045
    bump_stiffness: float = 4e6
    rebound: tuple[float, float] = (4200.0, 0.32)
    compression: tuple[float, float] = (2100.0, 0.28)
    mount_stiffness: float = 600e3
    mount_damping: float = 250.0
    rod_mass: float = 1.4
    friction: float = 42.0
    breakaway: float = 1.15
    friction_travel: float = 0.35e-3
    bar: float = 11e3
    bar_friction: float = 18.0

    @property
    def rigid(self) -> Car:
        """The same car with the rod bolted to the body."""
        return replace(self, mount_stiffness=np.inf)


def drive_car(car: Car, platforms: np.ndarray, added_mass: float, settle: float = 2.0) -> dict[str, np.ndarray]:
    """Platform forces and wheel positions (2, steps) for platform positions (2, steps) in m at every 50 us.

    The axle comes to rest for ``settle`` seconds at the first positions before the record begins. The wheels stand at
    zero where the car without added masses stands on its wheels with the platforms at zero.
    """
    sag = _static_sag(car)
    low = added_mass * GRAVITY / (car.tire.stiffness + 2.0 * car.tire.hardening * sag + car.spring)
    travels = np.geomspace(*car.tire.travels, 24)
    times = np.geomspace(*car.tire.times, 9)
    held = np.repeat(platforms[:, :1], round(settle / STEP), axis=1)
    numbers = np.array(
        [
            car.wheel_mass + added_mass,
            car.tire.stiffness,
            car.tire.hardening,
            car.tire.damping,
            sag,
            car.spring,
            car.spring_hardening,
            car.spring_force,
            car.bump_at,
            car.bump_stiffness,
            *car.rebound,
            *car.compression,
            car.mount_stiffness,
            car.mount_damping,
            car.rod_mass,
            car.friction,
            car.breakaway,
            car.friction_travel,
            car.bar,
            car.bar_friction,
        ]
    )
    path = np.concatenate([held, platforms], axis=1)
    force, wheel = _march(
        path, low, numbers, car.tire.sliding_stiffness / 24, travels, car.tire.relaxing_stiffness / 9, times
    )
    return {"force": force[:, held.shape[1] :], "wheel": wheel[:, held.shape[1] :]}


def _static_sag(car: Car) -> float:
    # the deflection of the tire that carries wheel and spring while everything stands at zero
    load = car.spring_force + car.wheel_mass * GRAVITY
    k, h = car.tire.stiffness, car.tire.hardening
    return (-k + np.sqrt(k * k + 4.0 * h * load)) / (2.0 * h)


def shock_force(car: Car, velocity: float) -> float:
    """The force in N of a shock absorber by itself at a velocity in m/s, compression positive."""
    slope, knee = car.compression if velocity > 0.0 else car.rebound
    return float(_digressive(velocity, slope, knee))


@njit(cache=True)
def _digressive(v, slope, knee):  # type: ignore[no-untyped-def]
    return slope * v / (1.0 + abs(v) / knee)


@njit(cache=True)
def _march(path, low, numbers, slide, travels, relax, times):  # type: ignore[no-untyped-def]
    """Leapfrog steps of both wheels and both rods, from wheels that stand ``low`` (m) on their platforms."""
    mass, k, hardening, tire_damping, sag = numbers[:5]
    spring, progress, load, bump_at, bump = numbers[5:10]
    re_slope, re_knee, co_slope, co_knee = numbers[10:14]
    mount, mount_damping, rod_mass = numbers[14:17]
    limit, breakaway, travel, bar, bar_limit = numbers[17:]
    steps = path.shape[1]
    force, wheel = np.zeros((2, steps)), np.zeros((2, steps))
    z, v, a = path[:, 0] - low, np.zeros(2), np.zeros(2)
    y, u, b = np.zeros(2), np.zeros(2), np.zeros(2)
    stretch, memory = np.zeros((2, travels.size)), np.zeros((2, times.size))
    fade = np.exp(-STEP / times)
    remember = times / STEP * (1.0 - fade)
    grip, bar_grip, tire_before = np.zeros(2), 0.0, path[:, 0] - z + sag
    for n in range(1, steps):
        for s in range(2):
            v[s] += 0.5 * STEP * a[s]
            u[s] += 0.5 * STEP * b[s]
            z[s] += STEP * v[s]
            y[s] += STEP * u[s]
        twist = (v[0] - v[1]) * STEP
        bar_grip += twist / 0.5e-3 * (1.0 - abs(bar_grip) * bar_grip * (1.0 if twist > 0.0 else -1.0))
        roll = bar * (z[0] - z[1]) + bar_limit * bar_grip
        for s in range(2):
            x = path[s, n] - z[s] + sag
            change = x - tire_before[s]
            tire_before[s] = x
            tire = k * x + hardening * x * x + tire_damping * change / STEP
            for j in range(travels.size):
                stretch[s, j] = min(max(stretch[s, j] + change, -travels[j]), travels[j])
                tire += slide * stretch[s, j]
            for j in range(times.size):
                memory[s, j] = fade[j] * memory[s, j] + remember[j] * change
                tire += relax * memory[s, j]
            tire = max(tire, 0.0)
            speed = v[s] + 0.5 * STEP * a[s]
            rod = u[s] + 0.5 * STEP * b[s] if np.isfinite(mount) else 0.0
            shock = speed - rod
            damper = _digressive(shock, co_slope, co_knee) if shock > 0.0 else _digressive(shock, re_slope, re_knee)
            over = max(z[s] - bump_at, 0.0)
            ride = load + spring * z[s] + progress * z[s] * abs(z[s]) + bump * over * over
            step = speed * STEP / travel
            grip[s] += step * (1.0 - grip[s] * abs(grip[s]) * (1.0 if step > 0.0 else -1.0))
            dry = limit * (1.0 + (breakaway - 1.0) * np.exp(-abs(speed) / 0.03)) * grip[s]
            side = roll if s == 0 else -roll
            a[s] = (tire - ride - damper - dry - side) / mass - GRAVITY
            v[s] += 0.5 * STEP * a[s]
            if np.isfinite(mount):
                b[s] = (damper - mount * y[s] - mount_damping * rod) / rod_mass
                u[s] += 0.5 * STEP * b[s]
            force[s, n], wheel[s, n] = tire, z[s]
    force[:, 0], wheel[:, 0] = force[:, 1], wheel[:, 1]
    return force, wheel


def tire_force(tire: CarTire, deflection: np.ndarray) -> np.ndarray:
    """The force (steps,) of the tire alone along a deflection at every 50 us, beginning relaxed."""
    return _tire_alone(
        deflection,
        tire.stiffness,
        tire.hardening,
        tire.damping,
        tire.sliding_stiffness / 24,
        np.geomspace(*tire.travels, 24),
        tire.relaxing_stiffness / 9,
        np.geomspace(*tire.times, 9),
    )


@njit(cache=True)
def _tire_alone(path, k, hardening, damping, slide, travels, relax, times):  # type: ignore[no-untyped-def]
    fade = np.exp(-STEP / times)
    remember = times / STEP * (1.0 - fade)
    stretch, memory, force = np.zeros(travels.size), np.zeros(times.size), np.zeros(path.size)
    force[0] = k * path[0] + hardening * path[0] * path[0]
    for n in range(1, path.size):
        change = path[n] - path[n - 1]
        total = k * path[n] + hardening * path[n] * path[n] + damping * change / STEP
        for j in range(travels.size):
            stretch[j] = min(max(stretch[j] + change, -travels[j]), travels[j])
            total += slide * stretch[j]
        for j in range(times.size):
            memory[j] = fade[j] * memory[j] + remember[j] * change
            total += relax * memory[j]
        force[n] = max(total, 0.0)
    return force

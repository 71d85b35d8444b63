"""What a hydraulic mount answers to its deflection: rubber, and fluid between two chambers. No element of dashpot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.signal import fftconvolve
from scipy.special import gamma, gammaincc

from dashpot_specimens.tire_laws import slide
from dashpot_specimens.tire_path import STEP, DrivenPath

SUBSTEPS = 4


@dataclass(frozen=True)
class Mount:
    """An engine mount with a long track and a plate that is free between two seats; SI throughout.

    rubber: a spring of `stiffness` that hardens with `cubic`, 40 sliders, and relaxation by a stretched exponential.
    fluid: a `piston` pumps from the upper chamber of compliance `bulge` into the lower one of compliance `bellows`,
    through a track of `length` and `section`, in which inertia, laminar `friction` and the `loss` of its ends (of the
    dynamic pressure) hold it up, and past a plate of the area `plate` and the mass `plate_mass` that is free over
    `travel` to either side and then presses on a seat of `seat_stiffness`.
    """

    stiffness: float = 170e3
    cubic: float = 0.5e9
    sliding_stiffness: float = 25e3
    shortest_travel: float = 0.02e-3
    longest_travel: float = 2e-3
    relaxing_stiffness: float = 40e3
    relaxation_time: float = 12e-3

    piston: float = 2500e-6
    bulge: float = 2.5e-11
    bellows: float = 2.5e-9
    density: float = 1060.0
    length: float = 0.2
    section: float = 28e-6
    friction: float = 4.8e7
    loss: float = 1.2
    plate: float = 1500e-6
    plate_mass: float = 0.05
    plate_damping: float = 15.0
    travel: float = 0.25e-3
    seat_stiffness: float = 1.5e6

    @property
    def inertance(self) -> float:
        """Pressure over the rate of the flow through the track, Pa s^2/m^3."""
        return self.density * self.length / self.section

    @property
    def turbulence(self) -> float:
        """Pressure over the square of the flow through the track, Pa s^2/m^6."""
        return self.loss * self.density / 2.0 / self.section**2

    def force(self, path: DrivenPath) -> np.ndarray:
        """Force along a path that begins at rest, shape (steps,)."""
        return self.rubber(path.deflection) + self.piston * self.pressure(path.velocity)

    def rubber(self, x: np.ndarray) -> np.ndarray:
        """Force of the rubber, which has settled under its first deflection."""
        elastic = self.stiffness * x + self.cubic * x**3
        edges = np.geomspace(self.shortest_travel, self.longest_travel, 41)
        travels = np.sqrt(edges[1:] * edges[:-1])
        sliding = slide(x, np.full(40, self.sliding_stiffness / 40.0), travels)
        times = np.sqrt(np.arange(x.size) * STEP / self.relaxation_time)
        modulus = -2.0 * self.relaxation_time / STEP * gamma(2) * np.diff(gammaincc(2, times))
        remembered = np.concatenate([[0.0], fftconvolve(np.diff(x), modulus)[: x.size - 1]])
        return elastic + sliding + self.relaxing_stiffness * remembered

    def pressure(self, velocity: np.ndarray) -> np.ndarray:
        """Pressure in the upper chamber over the ambient one, Pa, shape (steps,), by the Runge-Kutta method."""
        numbers = (
            self.piston,
            self.bulge,
            self.bellows,
            self.inertance,
            self.friction,
            self.turbulence,
            self.plate,
            self.plate_mass,
            self.plate_damping,
            self.travel,
            self.seat_stiffness,
        )
        return _pumped(velocity, STEP / SUBSTEPS, SUBSTEPS, np.array(numbers))


@njit(cache=True)
def _rates(state, speed, numbers):  # type: ignore[no-untyped-def]
    """Rates of both pressures, the flow through the track, and place and speed of the plate."""
    piston, bulge, bellows, inertance, friction, turbulence, plate, mass, damping, travel, seat = numbers
    upper, lower, flow, place, moving = state
    drop = upper - lower
    over = max(place - travel, 0.0) + min(place + travel, 0.0)
    rates = np.empty(5)
    rates[0] = (piston * speed - flow - plate * moving) / bulge
    rates[1] = (flow + plate * moving) / bellows
    rates[2] = (drop - friction * flow - turbulence * abs(flow) * flow) / inertance
    rates[3] = moving
    rates[4] = (plate * drop - damping * moving - seat * over) / mass
    return rates


@njit(cache=True)
def _pumped(velocity, step, substeps, numbers):  # type: ignore[no-untyped-def]
    """Pressure in the upper chamber at each step, the velocity of the piston being straight between two."""
    state = np.zeros(5)
    pressure = np.zeros(velocity.size)
    for i in range(1, velocity.size):
        slope = (velocity[i] - velocity[i - 1]) / substeps
        for j in range(substeps):
            first = velocity[i - 1] + j * slope
            k1 = _rates(state, first, numbers)
            k2 = _rates(state + 0.5 * step * k1, first + 0.5 * slope, numbers)
            k3 = _rates(state + 0.5 * step * k2, first + 0.5 * slope, numbers)
            k4 = _rates(state + step * k3, first + slope, numbers)
            state = state + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        pressure[i] = state[0]
    return pressure

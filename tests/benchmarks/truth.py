"""The force of the laws along the true smooth sweep, independent of dashpot: closed forms between exact reversals.

Friction follows from the displacement alone, in closed form from one reversal to the next; relaxation is integrated by
Gauss' rule over every step; springs and dampers are functions of the exact path.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.signal import lfilter
from scipy.special import wrightomega
from workload import DT, KNOTS, Sweep

Array = NDArray[np.float64]
Numbers = Mapping[str, float]

FACTOR_AT = np.array([0.005, 0.012, 0.020, 0.028])
SHARPNESS = 10.0
GAUSS = 12


def tire_force(sweep: Sweep, numbers: Numbers) -> Array:
    """The force (samples,) in N of tire model 5; ``numbers`` by path as in the network."""
    x, v, _ = sweep.path(sweep.time)
    carcass = PchipInterpolator(KNOTS, [numbers[f"stiffness.stiffness[{k}]"] for k in range(KNOTS.size)])(x)
    factor = PchipInterpolator(FACTOR_AT, [numbers[f"damping.scale[{k}]"] for k in range(FACTOR_AT.size)])
    force = carcass + numbers["damping.damping"] * factor(np.clip(x, FACTOR_AT[0], FACTOR_AT[-1])) * v
    for k in (1, 2, 3):
        force += relaxing(sweep, numbers[f"maxwell_{k}.stiffness"], numbers[f"maxwell_{k}.relaxation_time"])
        force += spring_and_slider(sweep, numbers[f"prandtl_{k}.stiffness"], numbers[f"prandtl_{k}.limit"])
    return force + slider(sweep, numbers["friction.stiffness"], numbers["friction.limit"])


def relaxing(sweep: Sweep, stiffness: float, time: float) -> Array:
    """dF/dt = k v - F/T."""
    places, weights = np.polynomial.legendre.leggauss(GAUSS)
    gained = np.zeros(sweep.time.size)
    for place, weight in zip(0.5 * DT * (places + 1.0), 0.5 * DT * weights, strict=True):
        velocity = sweep.path(sweep.time[:-1] + place)[1]
        gained[1:] += weight * np.exp(-(DT - place) / time) * stiffness * velocity
    return lfilter([1.0], [1.0, -np.exp(-DT / time)], gained)


def slider(sweep: Sweep, stiffness: float, limit: float) -> Array:
    """dF/dx = k (1 - F/limit sgn v): 1 - F/limit sgn v fades exponentially with the way."""
    force, left = np.zeros(sweep.time.size), 1.0
    for side, ways, way, here in strokes(sweep):
        force[here] = side * limit * (1.0 - left * np.exp(-stiffness * ways / limit))
        left = 2.0 - left * np.exp(-stiffness * way / limit)
    return force


def spring_and_slider(sweep: Sweep, stiffness: float, limit: float) -> Array:
    """A spring k in series with a slider of slope s k: s u + ln(s u) falls by s k/limit times the way."""
    force, y = np.zeros(sweep.time.size), SHARPNESS
    for side, ways, way, here in strokes(sweep):
        begin, pace = y + np.log(y), SHARPNESS * stiffness / limit
        force[here] = side * limit * (1.0 - wrightomega(begin - pace * ways) / SHARPNESS)
        y = 2.0 * SHARPNESS - wrightomega(begin - pace * way)
    return force


def strokes(sweep: Sweep) -> list[tuple[float, Array, float, slice]]:
    """Between two reversals: the side, the ways to the samples, the whole way, and which samples these are."""
    times = sweep.reversals()
    places = np.concatenate([[sweep.path(np.zeros(1))[0][0]], sweep.path(times)[0]])
    edges = np.concatenate([[0], np.searchsorted(sweep.time, times), [sweep.time.size]])
    x = sweep.path(sweep.time)[0]
    found = []
    for number, place in enumerate(places):
        here = slice(edges[number], edges[number + 1])
        whole = abs(places[number + 1] - place) if number + 1 < places.size else 0.0
        found.append(((-1.0) ** number, np.abs(x[here] - place), whole, here))
    return found

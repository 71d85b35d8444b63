"""Masses that hit stops: smooth equations from event to event, each of which is located.

A rigid stop takes the relative velocity away and keeps the momentum; it holds until a force pulls the mass off.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from verification.truth.at_events import EXACT

LOOK = 5e-5  # s, from one look to the next one for ends of a phase
LATE = 1e-12  # m, by which a stop catches later than it should: not again in the instant in which it let go


@dataclass(frozen=True)
class Phase:
    """What holds until one of its ends: rates (time, state), and the measured force from times and states.

    An end is a function of time and state that rises through zero, and what answers the next phase and its first state.
    """

    rates: Callable[[float, Any], list[float]]
    force: Callable[[Any, Any], Any]
    ends: list[tuple[Callable[[float, Any], float], Callable[[float, Any], tuple[Phase, Any]]]]


@dataclass(frozen=True)
class Leg:
    """A spring and a damper between a driven node and a mass."""

    motion: Any
    stiffness: float
    damping: float

    def pull(self, t, y):
        """The force that moves the mass."""
        return self.stiffness * (self.motion.place(t) - y[0]) + self.damping * (self.motion.speed(t) - y[1])


def followed(phase, y, at):
    """The measured force at the times ``at``, and how many phases there were."""
    time, found, count = at[0], np.zeros(at.size), 1
    while True:
        events = [_event(end) for end, _ in phase.ends]
        run = solve_ivp(phase.rates, (time, at[-1]), y, events=events, **EXACT)
        ended = [(times[0], number) for number, times in enumerate(run.t_events) if times.size]
        end, which = min([*ended, *_overlooked(phase, run, time)], default=(run.t[-1], None))
        inside = (at >= time) & (at <= end)
        if inside.any():
            found[inside] = phase.force(at[inside], run.sol(at[inside]))
        if which is None:
            return found, count
        time, (phase, y) = end, phase.ends[which][1](end, run.sol(end))
        count += 1


def _overlooked(phase, run, begin):
    """Ends that come and go within a step of the integrator, as where a mass hardly touches a stop."""
    times = np.linspace(begin, run.t[-1], 2 + int((run.t[-1] - begin) / LOOK))
    for number, (end, _) in enumerate(phase.ends):
        above = np.flatnonzero(end(times, run.sol(times))[:-1] > 0.0)
        if above.size and above[0] > 0:
            yield brentq(lambda t, end=end: end(t, run.sol(t)), *times[above[0] - 1 : above[0] + 1], xtol=1e-15), number


def _event(end):
    def crosses(t, y):
        return end(t, y)

    crosses.terminal, crosses.direction = True, 1.0
    return crosses


def between_stops(leg, mass, limit, low, high, at):
    """A mass between two places of the floor, on which it rubs with a force ``limit``."""

    def slides(way):
        ends = [(lambda t, y: np.maximum(y[0] - high, low - y[0]) - LATE, caught)]
        if limit:
            ends.append((lambda t, y: -way * y[1], rests))
        return Phase(lambda t, y: [y[1], (leg.pull(t, y) - way * limit) / mass], leg.pull, ends)

    def caught(t, y):
        return rests(t, [high if y[0] > 0.5 * (low + high) else low, 0.0])

    def rests(t, y):
        y = np.array([y[0], 0.0])
        return (slides(np.sign(leg.pull(t, y))) if leaves(t, y) >= 0.0 else still), y

    def leaves(t, y):
        ahead, back = np.where(y[0] == high, np.inf, limit), np.where(y[0] == low, np.inf, limit)
        return np.maximum(leg.pull(t, y) - ahead, -leg.pull(t, y) - back)

    still = Phase(lambda t, y: [0.0, 0.0], leg.pull, [(leaves, lambda t, y: (slides(np.sign(leg.pull(t, y))), y))])
    return followed(*rests(at[0], [0.0, 0.0]), at)


def carried(leg, mass, low, high, gravity, at):
    """A mass between two stops on the driven node: place of the node less that of the mass between two numbers."""
    motion = leg.motion

    def flies():
        def goes(t, y):
            return [y[1], leg.pull(t, y) / mass - gravity]

        def beyond(t, y):
            way = motion.place(t) - y[0]
            return np.maximum(way - high, low - way) - LATE

        return Phase(goes, leg.pull, [(beyond, caught)])

    def caught(t, y):
        place = high if motion.place(t) - y[0] > 0.5 * (low + high) else low
        y = np.array([motion.place(t) - place, motion.speed(t)])
        return (flies() if lets_go(place)(t, y) >= 0.0 else held(place)), y

    def pushed(t):
        return mass * (motion.bend(t) + gravity)

    def lets_go(place):
        return lambda t, y: (pushed(t) - leg.pull(t, y)) * (-1.0 if place == high else 1.0)

    def held(place):
        moves = lambda t, y: [motion.speed(t), motion.bend(t)]  # noqa: E731
        return Phase(moves, lambda t, y: pushed(t), [(lets_go(place), lambda t, y: (flies(), y))])

    begin = np.array([motion.place(at[0]) - (high if gravity else 0.0), motion.speed(at[0])])
    return followed(held(high) if gravity else flies(), begin, at)


def pushed_along(leg, masses, gap, back, at):
    """A leg moves one mass, which hits another one in front of a spring ``back`` to the wall."""
    (one, two), total = masses, sum(masses)

    def apart():
        def goes(t, y):
            return [y[1], leg.pull(t, y) / one, y[3], -back * y[2] / two]

        return Phase(goes, leg.pull, [(lambda t, y: y[0] - y[2] - gap - LATE, joined)])

    def joined(t, y):
        speed = (one * y[1] + two * y[3]) / total
        y = np.array([y[2] + gap, speed, y[2], speed])
        return (apart() if parts(t, y) >= 0.0 else together), y

    def common(t, y):
        return (leg.pull(t, y) - back * y[2]) / total

    def parts(t, y):
        return one * common(t, y) - leg.pull(t, y)

    together = Phase(
        lambda t, y: [y[1], common(t, y), y[3], common(t, y)], leg.pull, [(parts, lambda t, y: (apart(), y))]
    )
    return followed(apart(), np.zeros(4), at)


def thrown_back(leg, mass, stiffness, high, at):
    """A mass that hits an elastic stop on the floor, without any damping."""

    def free():
        goes = lambda t, y: [y[1], leg.pull(t, y) / mass]  # noqa: E731
        return Phase(goes, leg.pull, [(lambda t, y: y[0] - high, lambda t, y: (pressed(), y))])

    def pressed():
        def goes(t, y):
            return [y[1], (leg.pull(t, y) - stiffness * (y[0] - high)) / mass]

        return Phase(goes, leg.pull, [(lambda t, y: high - y[0], lambda t, y: (free(), y))])

    return followed(free(), np.zeros(2), at)

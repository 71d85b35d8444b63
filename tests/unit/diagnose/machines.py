"""Machines with inner nodes as ordinary differential equations, for the classical Runge-Kutta method.

They share nothing with dashpot. All runs of a machine are integrated side by side: the last axis is that of the runs.
"""

import numpy as np

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run

STEP, PARTS, DURATION = 2e-3, 10, 2.0
GRAVITY = 9.81
COUNT = int(DURATION / STEP)


def sweep(amplitude, start=2.0, stop=16.0):
    """Place and speed at a time, swelling for half a second."""

    def move(t):
        rise, phase = min(t / 0.5, 1.0), 2.0 * np.pi * (start * t + 0.5 * (stop - start) / DURATION * t * t)
        swell, swells = rise * rise * (3.0 - 2.0 * rise), 12.0 * rise * (1.0 - rise)
        speed = 2.0 * np.pi * (start + (stop - start) / DURATION * t)
        return amplitude * swell * np.sin(phase), amplitude * (swells * np.sin(phase) + swell * speed * np.cos(phase))

    return move


def dahl(force, v, stiffness, limit):
    """dF/dt of a Dahl slider; none without a limit."""
    return stiffness * (v - np.abs(v) * force / limit) if limit else np.zeros_like(v)


def integrate(rate, start, moves):
    """What ``rate(state, place, speed)`` answers behind the rates, at every sample: (..., runs, samples)."""
    step = STEP / PARTS
    state = np.repeat(np.asarray(start, float)[:, None], len(moves), axis=1)

    def motion(t):
        return np.array([move(t) for move in moves]).T

    found = []
    for n in range(COUNT):
        for part in range(PARTS):
            t = n * STEP + part * step
            begin, middle, end = (motion(t + share * step) for share in (0.0, 0.5, 1.0))
            one, force = rate(state, *begin)
            if part == 0:
                found.append(force)
            two, _ = rate(state + 0.5 * step * one, *middle)
            three, _ = rate(state + 0.5 * step * two, *middle)
            four, _ = rate(state + step * three, *end)
            state = state + step / 6.0 * (one + 2.0 * two + 2.0 * three + four)
    return np.moveaxis(np.array(found), 0, -1)


def quarter_car(friction, moves):
    """Platform forces (runs, samples): wheel of 36 kg on 200 N/mm, body of 346 kg on 25 N/mm and 1500 N*s/m."""
    wheel, body, tire, loss, spring, damping = 36.0, 346.0, 200e3, 100.0, 25e3, 1500.0

    def rate(y, x, speed):
        z, v, zb, vb, slider = y
        strut = spring * (z - zb) + damping * (v - vb) + slider
        contact = tire * (x - z) + loss * (speed - v)
        slides = dahl(slider, v - vb, 100e3, friction)
        return np.array([v, (contact - strut) / wheel - GRAVITY, vb, strut / body - GRAVITY, slides]), contact

    low = -(wheel + body) * GRAVITY / tire
    return integrate(rate, [low, 0.0, low - body * GRAVITY / spring, 0.0, 0.0], moves)


def axle(friction, moves, sides):
    """Platform forces (2, runs, samples): two wheels of 45 kg, an anti-roll bar of 12 N/mm with friction.

    The right platform moves ``sides`` (runs,) times as far as the left one.
    """
    wheel, tire, loss, spring, damping, bar = 45.0, 200e3, 150.0, 24e3, 1500.0, 12e3
    ratio = np.array([np.ones(len(moves)), sides])

    def rate(y, x, speed):
        z, v, slider = y[:2], y[2:4], y[4]
        contact = tire * (ratio * x - z) + loss * (ratio * speed - v)
        roll = bar * (z[0] - z[1]) + slider
        push = contact - spring * z - damping * v - np.array([roll, -roll])
        slides = dahl(slider, v[0] - v[1], 40e3, friction)
        return np.array([*v, *(push / wheel - GRAVITY), slides]), contact

    low = -wheel * GRAVITY / (tire + spring)
    return integrate(rate, [low, low, 0.0, 0.0, 0.0], moves)


def mount(friction, moves):
    """Forces (runs, samples) of a mount: rubber of 300 N/mm, then oil of 2 N*s/mm beside a spring of 80 N/mm."""
    rubber, oil, spring = 300e3, 2e3, 80e3

    def rate(y, x, _):
        z, slider = y
        force = rubber * (x - z)
        speed = (force - spring * z - slider) / oil
        return np.array([speed, dahl(slider, speed, 150e3, friction)]), force

    return integrate(rate, [0.0, 0.0], moves)


def measured(rng, forces, names, moves, ends=("",), sides=None, noise=2.0, held_out=()):
    """A dataset of forces (ends, runs, samples) with noise; ``sides`` (ends, runs) multiply the motion."""
    time, runs = np.arange(COUNT) * STEP, []
    for k, name in enumerate(names):
        path = np.array([moves[k](t)[0] for t in time])
        channels = {}
        for end, node in enumerate(ends):
            mark, ratio = f"@{node}" if node else "", 1.0 if sides is None else sides[end][k]
            channels[f"displacement{mark}"] = ratio * path + 1e-6 * rng.standard_normal(COUNT)
            channels[f"force{mark}"] = forces[end][k] + noise * rng.standard_normal(COUNT)
        runs.append(Run(name, "sweep", time, channels, group=name, held_out=name in held_out, order=k))
    return Dataset("machine", tuple(runs))

"""A damping that follows a channel within the runs is found and written, by formulas that no element has.

The means of the channel over the runs are all alike, so that nothing tells but what happens within each of them.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from dashpot import load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.diagnose.diagnose import diagnose
from dashpot.fit.scored import score_run
from dashpot.kernel.api import simulate_runs
from dashpot.model.reading import parse_network

PLAIN = """\
format: dashpot-network/1
name: plain
branches:
  stiffness: {element: spring, stiffness: {start: 30 N/mm}}
"""
DAMPER = "  damping: {element: damper, damping: {start: 200 N*s/m}}\n"
ON_SPRING = "  damping: {element: maxwell, stiffness: {start: 30 N/mm}, relaxation_time: {start: 10 ms}}\n"
STEP, SECONDS, NOISE = 1e-3, 4.0, 2.0
TIME = STEP * np.arange(round(SECONDS / STEP))
STIFFNESS, DAMPING, SPRING = 50e3, 400.0, 40e3


def angle(t, fast):
    """The angle of a sweep from 1 Hz to ``fast`` Hz."""
    return 2.0 * np.pi * (t + 0.5 * (fast - 1.0) * t**2 / SECONDS)


def speed(t, amplitude, fast):
    """The velocity in m/s of the sweep."""
    return amplitude * 2.0 * np.pi * (1.0 + (fast - 1.0) * t / SECONDS) * np.cos(angle(t, fast))


def stepped(t, number):
    """A current in A: 0.5, 1.5 and 2.5 A for a third of the run each, in an order of its own; switched in 20 ms."""
    first, second, third = np.roll([0.5, 1.5, 2.5], number)
    switched = SECONDS / 3.0, SECONDS / 3.0 + 0.02, SECONDS / 1.5, SECONDS / 1.5 + 0.02
    return np.interp(t, switched, [first, second, second, third])


def rising(t, number):
    """A temperature in K that rises by 20 K, or falls in every other run."""
    return 313.15 + (-1.0) ** number * 20.0 * (t / SECONDS - 0.5)


def firmer(current):
    """The damping in N s/m: it saturates with the current."""
    return DAMPING * (0.6 + 0.8 * current / (1.0 + 0.3 * current))


def thinner(kelvin):
    """The damping in N s/m: a power of the temperature over a fixed one."""
    return DAMPING * (60.0 / (kelvin - 253.15)) ** 1.5


def dashpot(damping, amplitude, fast):
    """The force (n,) of a dashpot whose damping is a function of time."""
    return damping(TIME) * speed(TIME, amplitude, fast)


def dashpot_on_spring(damping, amplitude, fast):
    """The same on a spring, from rest."""

    def rate(t, force):
        return SPRING * (speed(t, amplitude, fast) - force / damping(t))

    return solve_ivp(rate, (0.0, TIME[-1]), [0.0], "LSODA", TIME, rtol=1e-9, atol=1e-7, max_step=5e-3).y[0]


def measured(channel, course, law, force, seed):
    """Six sweeps."""
    rng, runs = np.random.default_rng(seed), []
    for number in range(6):
        amplitude, fast = (2e-3, 4e-3, 3e-3)[number % 3], (9.0, 6.0)[number % 2]
        motion = amplitude * np.sin(angle(TIME, fast))
        damped = force(lambda t, number=number: law(course(t, number)), amplitude, fast)
        shown = STIFFNESS * motion + damped + NOISE * rng.standard_normal(TIME.size)
        channels = {"displacement": motion, "force": shown, channel: course(TIME, number)}
        settings = {"amplitude": amplitude, "preload": 0.0}
        runs.append(Run(f"r{number}", "sweep", TIME, channels, settings, None, f"r{number}", order=number))
    return Dataset("moving", tuple(runs))


@pytest.mark.parametrize(
    ("branch", "force", "channel", "course", "law"),
    [
        (DAMPER, dashpot, "current", stepped, firmer),
        (DAMPER, dashpot, "temperature", rising, thinner),
        (ON_SPRING, dashpot_on_spring, "temperature", rising, thinner),
    ],
    ids=["stepped current", "rising temperature", "memory"],
)
def test_a_damping_that_follows_a_channel_within_runs_is_found(seed, branch, force, channel, course, law):
    registry = load_registry()
    data = measured(channel, course, law, force, seed)
    found = diagnose(parse_network(PLAIN + branch, registry.elements), data, registry=registry)
    print(found.verdict, [(named.cause.word, named.accepted) for named in found.named], found.before, found.after)
    assert {named.cause.word for named in found.named if named.accepted} == {"setting_dependence"}
    overs = {slot.path: slot.value.over for slot in found.written.slots() if slot.value.over}
    assert list(overs) == ["damping.relaxation_time" if branch == ON_SPRING else "damping.damping"]
    assert [(over.word, over.channel) for over in overs.values()] == [(channel, True)]
    assert found.after.all < 1.1 * NOISE < 0.8 * found.before.all
    # the file says what is told of it
    forces = simulate_runs(parse_network(found.extended_text, registry.elements), data)
    for run in data.runs:
        misfit = (forces[run.name] - run.force)[score_run(run).first :]
        assert np.sqrt(np.mean(misfit**2)) == pytest.approx(found.after.per_run[run.name], rel=1e-6)


def test_a_temperature_that_does_nothing_is_not_blamed_for_friction(seed):
    """A slider beside spring and dashpot, in the same runs that warm up or cool down."""

    def with_slider(damping, amplitude, fast):
        slid, held, force = amplitude * np.sin(angle(TIME, fast)), 0.0, np.zeros(TIME.size)
        for k in range(1, TIME.size):
            held = float(np.clip(held + 2e5 * (slid[k] - slid[k - 1]), -25.0, 25.0))
            force[k] = held
        return dashpot(damping, amplitude, fast) + force

    registry = load_registry()
    data = measured("temperature", rising, lambda kelvin: DAMPING + 0.0 * kelvin, with_slider, seed)
    found = diagnose(parse_network(PLAIN + DAMPER, registry.elements), data, registry=registry)
    print(found.verdict, [(named.cause.word, named.accepted) for named in found.named], found.before, found.after)
    assert {named.cause.word for named in found.named if named.accepted} == {"friction"}

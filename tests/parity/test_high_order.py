"""Steps of high order of a network that is stepped, where its numbers allow them and where not, against an ODE."""

from __future__ import annotations

import numpy as np
import pytest
from parity.c_library import Library
from scipy.integrate import solve_ivp

from dashpot import declare
from dashpot.kernel.export import exported
from dashpot.kernel.ir.online import STEPS
from dashpot.kernel.jit import jit_network

MASS, STIFFNESS, DAMPING, TRAVEL, BUFFER, POWER = 2.0, 4e4, 60.0, 2e-3, 4e6, 2.0
REFERENCE, RATE, AMPLITUDE = 1e-3, 2.0 * np.pi * 8.0, 4e-3
# the buffer is met with 4e6 N/m and more: too quick for steps of high order of 0.5 ms, whose limit is 1.6e6 N/m
TEXT = f"""
format: dashpot-network/1
name: stopped
nodes: {{lower: driven, body: {{mass: {MASS} kg}}, wall: ground}}
branches:
  a: {{element: spring, between: [lower, body], stiffness: {STIFFNESS} N/m}}
  b: {{element: damper, between: [lower, body], damping: {DAMPING} N*s/m}}
  c: {{element: spring, between: [body, wall], stiffness: {STIFFNESS} N/m}}
  d: {{element: end_stop, between: [body, wall], stiffness: {BUFFER} N/m, compression: {TRAVEL} m, exponent: {POWER}}}
"""


def motion(t, amplitude):
    """Place, velocity and acceleration of the driven node: it grows over the first seconds."""
    grown, rate = amplitude * t**2, RATE
    return (
        grown * np.sin(rate * t),
        2.0 * amplitude * t * np.sin(rate * t) + grown * rate * np.cos(rate * t),
        2.0 * amplitude * (np.sin(rate * t) + 2.0 * t * rate * np.cos(rate * t)) - grown * rate**2 * np.sin(rate * t),
    )


def truth(times, amplitude):
    """The force at the driven node."""

    def forces(t, x, v):
        y, w, _ = motion(t, amplitude)
        above = STIFFNESS * (y - x) + DAMPING * (w - v)
        return above, above - STIFFNESS * x - BUFFER * REFERENCE * (np.maximum(x - TRAVEL, 0.0) / REFERENCE) ** POWER

    found = solve_ivp(
        lambda t, z: (z[1], forces(t, *z)[1] / MASS - GRAVITY),
        (0.0, times[-1]),
        (-MASS * GRAVITY / (2.0 * STIFFNESS), 0.0),
        t_eval=times,
        method="LSODA",
        rtol=1e-10,
        atol=1e-13,
    )
    return forces(times, *found.y)[0]


GRAVITY = declare(TEXT).gravity


def walked(times, amplitude):
    """The forces, how many steps of high order came before each sample, and the status in the end."""
    solver = jit_network(declare(TEXT))
    state, out = solver.state(2e-2), np.empty(len(times))
    steps, before = np.empty(len(times)), 2.0 * times[0] - times[1]
    for k, t in enumerate(times):
        x, v, a = motion(t, amplitude)
        given = np.array([x]), np.array([v])
        answer = np.empty(2)
        solver.step_nodes(state, *given, np.empty(0), t - before, solver.parameters, answer)
        out[k], steps[k], before = answer[0], state[STEPS], t
    return out, steps, solver.status(state)


def off(found, expected):
    return np.sqrt(np.mean((found - expected) ** 2)) / np.sqrt(np.mean(expected**2))


def test_a_stiff_contact_on_the_way_ends_them_and_leaves_the_force_right():
    times = 1e-3 * np.arange(1500)
    found, steps, status = walked(times, AMPLITUDE)
    given_up = np.flatnonzero(steps < 0.0)
    assert status == 0 and 200 < given_up[0] < 1400 and np.all(steps[given_up[0] :] < 0.0)
    assert off(found, truth(times, AMPLITUDE)) < 2e-3


def test_a_free_body_keeps_them_and_is_more_exact():
    times = 1e-3 * np.arange(1500)
    found, steps, status = walked(times, 0.2 * AMPLITUDE)
    assert status == 0 and np.all(steps >= 0.0)
    assert off(found, truth(times, 0.2 * AMPLITUDE)) < 2e-5


def test_another_step_on_the_way_begins_them_anew():
    times = np.concatenate([1e-3 * np.arange(700), 0.6995 + 0.7e-3 * np.arange(1, 700)])
    found, steps, status = walked(times, 0.2 * AMPLITUDE)
    assert status == 0 and np.all(steps >= 0.0) and steps[700] < steps[699]
    assert off(found, truth(times, 0.2 * AMPLITUDE)) < 1e-4


def test_numbers_that_never_allow_them_are_stepped_by_the_others_from_the_begin():
    solver = jit_network(declare(TEXT.replace(f"{STIFFNESS} N/m", "9e6 N/m")))
    state, out = solver.state(), np.empty(2)
    solver.step_nodes(state, np.zeros(1), np.zeros(1), np.empty(0), 1e-3, solver.parameters, out)
    assert state[STEPS] < 0.0 and solver.status(state) == 0


@pytest.mark.parametrize("amplitude", [AMPLITUDE, 0.2 * AMPLITUDE])
def test_c_gives_up_where_compiled_code_does(amplitude, tmp_path):
    from dashpot.data.drive import drive_from_path

    times, spec = 1e-3 * np.arange(1500), declare(TEXT)
    drive = drive_from_path(1e-3, *map(np.ascontiguousarray, motion(times, amplitude)))
    outputs, status = Library.build(spec, tmp_path).along([drive], np.array(exported(spec).values))
    assert status == 0 and off(outputs[:, 0], truth(times, amplitude)) < 2e-3

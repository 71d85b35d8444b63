"""The first sample of a record whose driven ends move already: closed forms, and the matrix of all dampers."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from verification.systems import excitation, lanes, system, times

from dashpot.kernel.solution import Status

# 2 mm sin(2 pi 5 Hz t): the acceleration is zero at first, the velocity is not
OMEGA = 2.0 * np.pi * 5.0


class Sine:
    """A motion that is fast at first."""

    def __init__(self, amplitude: float = 2e-3) -> None:
        self.amplitude = amplitude

    def place(self, t):
        return self.amplitude * np.sin(OMEGA * t)

    def speed(self, t):
        return self.amplitude * OMEGA * np.cos(OMEGA * t)

    def bend(self, t):
        return -self.amplitude * OMEGA**2 * np.sin(OMEGA * t)


SPEED = Sine().speed(0.0)
BLOCK = "{table: driven, block: {mass: 5 kg}, wall: ground}"
HELD = "b: {element: spring, stiffness: 20 N/mm, between: [block, wall]}"
CASES = {
    "damper to a mass": (
        BLOCK,
        "a: {element: damper, damping: 300 N*s/m, between: [table, block]}\n" + HELD,
        300.0 * SPEED,
    ),
    "square damper to a mass": (
        BLOCK,
        "a: {element: quadratic_damper, damping: 900 N*s^2/m^2, between: [table, block]}\n" + HELD,
        900.0 * SPEED**2,
    ),
    "dampers in series": (
        "",
        "leg: {series: {a: {element: damper, damping: 300 N*s/m}, b: {element: damper, damping: 600 N*s/m}}}",
        200.0 * SPEED,
    ),
    "damper and spring in series": (
        "",
        "leg: {series: {a: {element: damper, damping: 300 N*s/m}, b: {element: spring, stiffness: 20 N/mm}}}",
        0.0,
    ),
    "square dampers in series": (
        "",
        "leg: {series: {a: {element: quadratic_damper, damping: 900 N*s^2/m^2}, "
        "b: {element: quadratic_damper, damping: 900 N*s^2/m^2}}}",
        225.0 * SPEED**2,
    ),
    "sliding friction in series": (
        "",
        "leg: {series: {a: {element: damper, damping: 1000 N*s/m}, "
        "b: {element: coulomb, limit: 20 N, creep_velocity: 1e-6 m/s}}}",
        20.0,
    ),
    "sticking friction in series": (
        "",
        "leg: {series: {a: {element: damper, damping: 100 N*s/m}, "
        "b: {element: coulomb, limit: 20 N, creep_velocity: 1e-7 m/s}}}",
        100.0 * SPEED,
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_the_first_force_knows_the_velocity_of_the_drive(case):
    nodes, branches, expected = CASES[case]
    network = system(nodes, branches)
    found = network.solve(network.prepare(excitation(times(0.01), {network.outputs[0]: Sine()})))
    assert found.status == (Status.GOOD,)
    # the search ends within a millionth of the span, 2e-9 m, in one step of 1 ms
    assert found.force[0, 0, 0] == pytest.approx(expected, abs=1e-6 * 300.0 * SPEED)


def test_dampers_between_many_nodes_are_balanced_at_once():
    """Kirchhoff's laws: the matrix of all dampers, the driven nodes and the ground moved out of it."""
    rng = np.random.default_rng(seed_of("first sample of dampers"))
    names = ["left", "right", "wall", *(f"n{number}" for number in range(4))]
    pairs = [(names[rng.integers(number)], names[number]) for number in range(1, 7) for _ in range(2)]
    pairs = [(first, second) for first, second in pairs if first != second]
    damping = 10.0 ** rng.uniform(1.0, 4.0, len(pairs))
    matrix, speeds = np.zeros((7, 7)), np.array([SPEED, -0.4 * SPEED, 0.0])
    for (first, second), number in zip(pairs, damping, strict=True):
        end = np.zeros(7)
        end[[names.index(first), names.index(second)]] = 1.0, -1.0
        matrix += number * np.outer(end, end)
    free = np.linalg.solve(matrix[3:, 3:], -matrix[3:, :3] @ speeds)
    expected = matrix[:2] @ np.concatenate([speeds, free])
    nodes = "{left: driven, right: driven, wall: ground, " + ", ".join(f"{name}: free" for name in names[3:]) + "}"
    branches = "\n".join(
        f"d{k}: {{element: damper, damping: 1 N*s/m, between: [{a}, {b}]}}" for k, (a, b) in enumerate(pairs)
    )
    network = system(nodes, branches)
    values = lanes(network, **{f"d{k}__damping": number for k, number in enumerate(damping)})
    run = excitation(times(0.01), {"left": Sine(), "right": Sine(-0.8e-3)})
    assert network.solve(network.prepare(run), values).force[0, :, 0] == pytest.approx(expected, rel=1e-9)


def test_a_driven_mass_is_carried_at_once():
    class Swing(Sine):
        """The same, a quarter of a cycle later."""

        place, speed, bend = (
            lambda self, t, name=name: getattr(Sine(), name)(np.add(t, 0.05)) for name in ("place", "speed", "bend")
        )

    network = system(
        "{table: {hold: driven, mass: 3 kg}, block: {mass: 5 kg}, wall: ground}",
        "a: {element: spring, stiffness: 10 N/mm, between: [table, block]}\n" + HELD,
    )
    found = network.solve(network.prepare(excitation(times(0.01), {"table": Swing()}))).force[0, 0, 0]
    # both springs in series, and the table
    assert found == pytest.approx(2e-3 * (20e3 / 3.0) - 3.0 * 2e-3 * OMEGA**2, rel=1e-9)


def test_the_first_sample_is_continued_by_the_second():
    """A network with a light mass is near one without, from the first sample on."""
    leg = (
        "a: {{element: damper, damping: 300 N*s/m, between: [table, block]}}\n"
        "b: {{element: damper, damping: 100 N*s/m, between: [block, wall]}}"
    )
    network = system("{table: driven, block: free, wall: ground}", leg.replace("{{", "{").replace("}}", "}"))
    at = times(0.02)
    found = network.solve(network.prepare(excitation(at, {"table": Sine()}))).force[0, 0]
    assert found == pytest.approx(75.0 * Sine().speed(at), rel=1e-4)

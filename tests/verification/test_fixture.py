"""A fixture that gives way, in series with the whole network: x_specimen = x - compliance * F."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from unit.kernel.networks import ELEMENTS, compiled

from dashpot.data.drive import drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.kernel.energy import energy_balance
from dashpot.kernel.network import compile_network
from dashpot.kernel.solution import Status
from dashpot.model.reading import parse_network

DT, HERTZ, LENGTH = 1e-3, 6.0, 2e-3
OMEGA = 2.0 * np.pi * HERTZ
TIME = DT * np.arange(2001)
SETTLED = TIME > 1.0

SPRING = "a: {element: spring, stiffness: 200 N/mm}\n"
DAMPER = "b: {element: damper, damping: 900 N*s/m}\n"
MAXWELL = "c: {element: maxwell, stiffness: 80 N/mm, relaxation_time: 20 ms}\n"
MASS = "d: {element: inerter, inertance: 25 kg}\n"
LEG = "e: {series: {f: {element: spring, stiffness: 100 N/mm}, g: {element: damper, damping: 500 N*s/m}}}\n"
PRANDTL = "h: {element: prandtl, stiffness: 300 N/mm, limit: 30 N, sharpness: 5}\n"
CUBIC = "i: {element: spring, stiffness: {polynomial: [80 N/mm, 0 N/mm^2, 9 N/mm^3]}}\n"
STIFFNESSES = {
    SPRING: 2e5,
    DAMPER: 900j * OMEGA,
    MAXWELL: 8e4 * 20e-3j * OMEGA / (1.0 + 20e-3j * OMEGA),
    MASS: -25.0 * OMEGA**2,
    LEG: 1.0 / (1.0 / 1e5 + 1.0 / (500j * OMEGA)),
}


def sine():
    return drive_from_path(
        DT,
        LENGTH * np.sin(OMEGA * TIME),
        LENGTH * OMEGA * np.cos(OMEGA * TIME),
        -LENGTH * OMEGA**2 * np.sin(OMEGA * TIME),
    )


def on(compliance: float) -> str:
    return f"measurement: {{force: {{compliance: {compliance!r} m/N}}}}\n"


def simulated(branches: str, more: str = "", drive=None) -> np.ndarray:
    network = compiled(branches, more)
    return network.simulate(network.prepare(drive or sine()))


@pytest.mark.parametrize("compliance", [0.0, 1e-9, 1e-6, 3e-4])
def test_a_spring_is_softer_by_the_compliance(compliance):
    expected = LENGTH * np.sin(OMEGA * TIME) * 2e5 / (1.0 + 2e5 * compliance)
    assert np.abs(simulated(SPRING, on(compliance)) - expected).max() < 1e-12 * 400.0


@pytest.mark.parametrize("compliance", [1e-8, 3e-7, 2e-6])
@pytest.mark.parametrize(
    "branches",
    [SPRING + DAMPER, SPRING + DAMPER + MAXWELL, SPRING + DAMPER + MASS, SPRING + LEG],
    ids=["kelvin_voigt", "relaxing", "with_a_mass", "with_a_series_connection"],
)
def test_a_complex_stiffness_becomes_k_over_one_plus_ck(branches, compliance):
    alone = sum(STIFFNESSES[f"{line}\n"] for line in branches.splitlines())
    expected = LENGTH * (alone / (1.0 + compliance * alone) * np.exp(1j * OMEGA * TIME)).imag
    found = simulated(branches, on(compliance))
    size = LENGTH * abs(alone)
    rigid = np.abs(LENGTH * (alone * np.exp(1j * OMEGA * TIME)).imag - expected).max()
    assert np.abs(found - expected)[SETTLED].max() < min(2e-6 * size, 2e-3 * rigid)


@pytest.mark.parametrize(
    ("branches", "near"),
    [
        (SPRING, 1e-13),
        (SPRING + DAMPER, 1e-13),
        (SPRING + DAMPER + MASS + MAXWELL, 2e-9),
        (SPRING + LEG, 1e-12),
        (CUBIC + MAXWELL, 2e-9),
        (SPRING + PRANDTL, 3e-5),
    ],
)
def test_a_fixture_that_does_not_give_way_changes_nothing(branches, near):
    rigid = simulated(branches)
    found = simulated(branches, on(0.0))
    # between two samples a memory follows the quintic here and the cubic there; friction that turns round there is
    # seen by halved steps only
    assert np.abs(found - rigid).max() < near * np.abs(rigid).max()


def test_a_bent_spring_is_solved_and_not_linearised():
    compliance = 4e-6

    def missing(force, x):
        u = x - compliance * force
        return 8e4 * u + 9e9 * u**3 - force

    expected = [brentq(missing, -1e4, 1e4, args=(x,), xtol=1e-12, rtol=1e-15) for x in LENGTH * np.sin(OMEGA * TIME)]
    assert np.abs(simulated(CUBIC, on(compliance)) - expected).max() < 1e-9 * np.max(expected)


HEAD = "format: dashpot-network/1\nname: n\n"
CAR = """\
nodes: {{road: driven, wheel: {{mass: 40 kg}}, body: {{mass: 300 kg}}, wall: ground{more}}}
branches:
  tire: {{element: spring, stiffness: 200 N/mm, between: [{foot}, wheel]}}
  loss: {{element: damper, damping: 300 N*s/m, between: [{foot}, wheel]}}
  spring: {{element: spring, stiffness: 25 N/mm, between: [wheel, body]}}
  damper: {{element: damper, damping: 1500 N*s/m, between: [wheel, body]}}
  hand: {{element: spring, stiffness: 10 N/mm, between: [body, wall]}}
"""


def test_in_a_network_with_nodes_the_fixture_stands_between_the_drive_and_the_network():
    compliance = 5e-7
    apart = CAR.format(foot="foot", more=", foot: {mass: 0 kg}") + (
        f"  fixture: {{element: spring, stiffness: {1.0 / compliance!r}, between: [road, foot]}}\n"
    )
    found = []
    for text in (CAR.format(foot="road", more="") + on(compliance), apart):
        network = compile_network(parse_network(HEAD + text, ELEMENTS))
        solution = network.solve(network.prepare(sine()))
        assert solution.status == (Status.GOOD,)
        found.append(solution)
    names = [[name for name in each.unknown if name in ("wheel", "body")] for each in found]
    assert names[0] == names[1]
    size = np.abs(found[1].force).max()
    # the explicit fixture differentiates the whole motion of the foot, the other one only what the fixture gives way
    assert np.abs(found[0].force - found[1].force)[0, 0].max() < 2e-5 * size
    wheels = [each.motion[0, each.unknown.index("wheel")] for each in found]
    assert np.abs(wheels[0] - wheels[1]).max() < 1e-5 * LENGTH
    foot = found[0].motion[0, found[0].unknown.index("road:mounted")]
    assert foot == pytest.approx(sine().displacement - compliance * found[0].force[0, 0], abs=1e-10)


def test_a_mass_on_the_driven_node_is_moved_by_way_of_the_fixture():
    mass, compliance = 30.0, 2e-6
    text = "nodes: {plate: {mass: 30 kg, hold: driven}, wall: ground}\nbranches:\n"
    text += "  a: {element: spring, stiffness: 200 N/mm, between: [plate, wall]}\n"
    text += "  b: {element: damper, damping: 900 N*s/m, between: [plate, wall]}\n"
    network = compile_network(parse_network(HEAD + text + on(compliance), ELEMENTS))
    found = network.simulate(network.prepare(sine()))
    alone = 2e5 + 900j * OMEGA - mass * OMEGA**2
    expected = LENGTH * (alone / (1.0 + compliance * alone) * np.exp(1j * OMEGA * TIME)).imag
    assert np.abs(found - expected)[SETTLED].max() < 1e-5 * LENGTH * abs(alone)


def test_the_energy_that_is_put_in_is_found_again():
    spec = compiled(SPRING + DAMPER, on(2e-6)).spec
    balance = energy_balance(spec, Excitation.of_drive(sine()))
    [fixture] = balance.masses
    force = simulated(SPRING + DAMPER, on(2e-6))
    assert (fixture.name, fixture.word) == ("fixture", "fixture")
    assert fixture.stored == pytest.approx(0.5 * 2e-6 * (force[-1] ** 2 - force[0] ** 2), abs=1e-9)
    assert abs(balance.missing) < 1e-5 * balance.put_in

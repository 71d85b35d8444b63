"""Derivatives from lanes that hardly differ; truth: the steady state of a linear network by its impedances."""

from __future__ import annotations

import numpy as np
import pytest
from unit.kernel.networks import ELEMENTS

from dashpot.data.drive import drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.kernel import system
from dashpot.kernel.network import compile_network
from dashpot.kernel.system import CompiledSystem
from dashpot.model.reading import parse_network

DT, SAMPLES, SETTLED = 1e-3, 1600, 1000
AMPLITUDE, OMEGA = 2e-3, 2.0 * np.pi * 9.0
NUMBERS = {"wheel": 40.0, "rod": 1.5, "tire": 2e5, "absorber": 3000.0, "mount": 4e5, "strut": 2.5e4}
SMALL = 1e-5

WHEEL = """\
format: dashpot-network/1
name: wheel
nodes: {{platform: driven, wheel: {{mass: 40 kg}}, rod: {{mass: {rod} kg}}, body: ground}}
branches:
  tire: {{element: spring, stiffness: 200 N/mm, between: [platform, wheel]}}
  strut: {{element: spring, stiffness: 25 N/mm, between: [wheel, body]}}
  absorber: {{element: damper, damping: 3 kN*s/m, between: [wheel, rod]}}
  mount: {{element: spring, stiffness: 400 N/mm, between: [rod, body]}}
"""


def compiled(rod: float) -> CompiledSystem:
    found = compile_network(parse_network(WHEEL.format(rod=rod), ELEMENTS, "n.yaml"))
    assert isinstance(found, CompiledSystem)
    return found


def driven() -> Excitation:
    phase = OMEGA * DT * np.arange(SAMPLES)
    x, v, a = -np.cos(phase), OMEGA * np.sin(phase), OMEGA**2 * np.cos(phase)
    return Excitation.of_drive(drive_from_path(DT, AMPLITUDE * (1.0 + x), AMPLITUDE * v, AMPLITUDE * a))


def steady(numbers: dict[str, complex]) -> np.ndarray:
    """The force at the platform when all has settled, of numbers that may be complex in a derivative."""
    s, n = 1j * OMEGA, numbers
    rod = n["mount"] + n["rod"] * s**2
    behind = n["absorber"] * s * rod / (n["absorber"] * s + rod)
    wheel = behind + n["strut"] + n["wheel"] * s**2
    stiffness = n["tire"] * wheel / (n["tire"] + wheel)
    still = n["tire"] * n["strut"] / (n["tire"] + n["strut"])
    turning = np.exp(1j * OMEGA * DT * np.arange(SETTLED, SAMPLES))
    return AMPLITUDE * (still - (stiffness * turning).real)


def expected(key: str) -> np.ndarray:
    """How the force changes where a number grows by a small share of itself: both sides of a central difference."""
    up, down = ({**NUMBERS, key: NUMBERS[key] * (1.0 + side)} for side in (1e-4, -1e-4))
    return (steady(up) - steady(down)) / 2e-4


@pytest.fixture(scope="module")
def stiff() -> CompiledSystem:
    """A rod so light that steps of high order are not allowed."""
    return compiled(NUMBERS["rod"])


def around(network: CompiledSystem) -> np.ndarray:
    return np.vstack([network.start, network.start * (1.0 + SMALL * np.eye(network.start.size))])


PATHS = {"wheel.mass": "wheel", "tire.stiffness": "tire", "absorber.damping": "absorber", "mount.stiffness": "mount"}


@pytest.mark.parametrize("path", PATHS)
def test_derivatives_are_those_of_the_impedances(stiff, path):
    run = stiff.prepare(driven())
    assert not stiff.takes_high_order(run)
    force = stiff.solve_around(run, around(stiff)).force[:, 0, SETTLED:]
    found, truth = (force[1 + stiff.paths.index(path)] - force[0]) / SMALL, expected(PATHS[path])
    assert np.linalg.norm(found - truth) < 5e-3 * np.linalg.norm(truth)


def test_the_first_lane_is_what_it_is_alone(stiff):
    run = stiff.prepare(driven())
    alone, found = stiff.solve(run, stiff.start), stiff.solve_around(run, around(stiff))
    assert np.array_equal(alone.force[0], found.force[0]) and np.array_equal(alone.error[0], found.error[0])


def test_only_the_long_steps_are_taken_where_they_do(stiff, monkeypatch):
    asked = []
    march = CompiledSystem._march
    monkeypatch.setattr(CompiledSystem, "_march", lambda *given: asked.append(given[2:]) or march(*given))
    run, lanes = stiff.prepare(driven()), around(stiff)
    stiff.solve_around(run, lanes)
    assert [len(given[0]) for given in asked if given[2] == system.EXTRAPOLATED] == [1]
    asked.clear()
    monkeypatch.setattr(system, "LONG_ENOUGH", 0.0)
    found = stiff.solve_around(run, lanes)
    assert [len(given[0]) for given in asked if given[2] == system.EXTRAPOLATED] == [1, len(lanes)]
    assert np.array_equal(found.force, stiff.solve(run, lanes).force)


def test_lanes_of_high_order_are_solved_as_ever():
    network = compiled(30.0)
    run = network.prepare(driven())
    assert network.takes_high_order(run)
    assert np.array_equal(network.solve_around(run, around(network)).force, network.solve(run, around(network)).force)


def test_lanes_that_are_all_too_fast_are_not_led_to_the_end_by_steps_of_high_order(stiff, monkeypatch):
    marched = []
    march = CompiledSystem._march

    def watched(*given):
        found = march(*given)
        marched.append((given[4].quick, found.out[..., -1].copy()))
        return found

    run = stiff.prepare(driven())
    whole = stiff.solve(run, around(stiff)).force
    monkeypatch.setattr(
        CompiledSystem, "_slow_enough", lambda self, blocks: np.zeros(sum(b.count for b in blocks), bool)
    )
    assert np.array_equal(stiff.solve(run, around(stiff)).force, whole)
    monkeypatch.setattr(CompiledSystem, "_march", watched)
    assert np.array_equal(stiff.solve(run, around(stiff)).force, whole)
    assert [quick for quick, _ in marched] == [True, False]


def test_steps_of_high_order_are_not_prepared_beyond_the_place_where_all_lanes_were_too_fast(stiff):
    run = stiff.prepare(driven())
    assert run.quick.nbytes == 0 and run.nbytes == run.quick.expected > 0
    stiff.solve(run, around(stiff))
    made, whole = run.quick.nbytes, list(run.quick)
    assert 0 < made < run.quick.nbytes == sum(piece.coarse.nbytes + piece.fine.nbytes for piece in whole)
    assert run.quick.nbytes == pytest.approx(run.quick.expected, rel=0.01)
    assert run.nbytes == run.quick.nbytes + run.pieces.nbytes
    assert [id(piece) for piece in run.quick] == [id(piece) for piece in whole]

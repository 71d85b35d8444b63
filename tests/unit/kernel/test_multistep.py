"""Steps of high order for networks whose nodes all have masses: which lanes take them, and what they are worth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of
from unit.kernel.networks import ELEMENTS

from dashpot.data.drive import drive_from_path
from dashpot.data.excitation import Excitation
from dashpot.kernel.network import compile_network
from dashpot.kernel.scheme import FILLED, PLACE, PLACE_AHEAD, SPEED, multistep
from dashpot.kernel.solution import Status
from dashpot.kernel.system import CompiledSystem
from dashpot.model.reading import parse_network

DT, SAMPLES = 1e-3, 400
CAR = """
gravity: 9.81 m/s^2
nodes: {ground_plate: driven, wheel: {mass: 36 kg}, body: {mass: 300 kg}}
branches:
  tire: {element: spring, stiffness: 200 N/mm, between: [ground_plate, wheel], offset: 30 mm}
  rubber: {element: maxwell, stiffness: 40 N/mm, relaxation_time: 4 ms, between: [ground_plate, wheel]}
  strut: {element: spring, stiffness: 25 N/mm, between: [wheel, body], offset: 120 mm}
  absorber: {element: damper, damping: 1500 N*s/m, between: [wheel, body]}
  friction: {element: dahl, stiffness: 100 N/mm, limit: 60 N, between: [wheel, body]}
"""


def compiled(text: str) -> CompiledSystem:
    found = compile_network(parse_network(f"format: dashpot-network/1\nname: car\n{text}", ELEMENTS, "n.yaml"))
    assert isinstance(found, CompiledSystem)
    return found


def shaken(samples: int = SAMPLES) -> Excitation:
    time, omega = DT * np.arange(samples), 2.0 * np.pi * np.array([4.0, 11.0])
    phase = np.outer(time, omega)
    x, v = np.sum(2e-3 * (1.0 - np.cos(phase)), axis=1), np.sin(phase) @ (2e-3 * omega)
    return Excitation.of_drive(drive_from_path(DT, x, v, np.cos(phase) @ (2e-3 * omega**2)))


@pytest.fixture(scope="module")
def car() -> CompiledSystem:
    return compiled(CAR)


@pytest.fixture(scope="module")
def lanes(car) -> np.ndarray:
    """Lanes far from each other, of which some are too quick for the step."""
    rng = np.random.default_rng(seed_of("test_multistep"))
    values = car.start * np.exp(rng.uniform(-1.0, 1.0, (24, car.start.size)))
    values[::5, car.paths.index("absorber.damping")] *= 300.0
    return values


def plain(network: CompiledSystem) -> CompiledSystem:
    return replace(network, quick=False)


def rms(error: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(error))))


def test_the_rule_integrates_cubics_exactly():
    times = np.array([1.0, 0.0, -1.0, -2.0])  # of the accelerations, in steps
    for power in range(4):
        a = times**power
        assert np.dot(SPEED, a) == pytest.approx(1.0 / (power + 1), abs=1e-14)
        assert np.dot(PLACE, a) == pytest.approx(1.0 / ((power + 1) * (power + 2)), abs=1e-14)
        if power < 3:
            assert np.dot(PLACE_AHEAD, a[1:]) == pytest.approx(1.0 / ((power + 1) * (power + 2)), abs=1e-14)


def test_a_rule_that_is_cut_is_the_same():
    whole, parts = multistep(0.1, 0, 40), [multistep(0.1, first, 5) for first in range(0, 40, 5)]
    for key in ("slope", "now", "before", "swing", "pull", "adams", "renewed"):
        assert np.array_equal(getattr(whole, key), np.concatenate([getattr(part, key) for part in parts]))
    assert not whole.adams[:FILLED].any() and whole.adams[FILLED:].all()


def test_with_friction_they_are_nearer_to_the_truth_than_the_steps_for_all_numbers(car):
    excitation = shaken()
    truth = plain(car).solve(plain(car).prepare(excitation, 128)).force[0]
    quick, slow = (network.solve(network.prepare(excitation)) for network in (car, plain(car)))
    assert quick.status == slow.status == (Status.GOOD,)
    errors = [rms(found.force[0] - truth) for found in (quick, slow)]
    assert 0.0 < errors[0] < errors[1]
    assert errors[0] <= quick.error[0, 0] < slow.error[0, 0]


def test_a_lane_too_quick_for_them_takes_the_steps_for_all_numbers(car, lanes):
    run = car.prepare(shaken())
    found, other = car.solve(run, lanes), plain(car).solve(plain(car).prepare(shaken()), lanes)
    same = np.array([np.array_equal(*pair) for pair in zip(found.force, other.force, strict=True)])
    assert same[::5].all() and not same.all()
    assert set(found.status) == {Status.GOOD}


def test_a_lane_alone_is_bitwise_the_same_among_others(car, lanes):
    run = car.prepare(shaken())
    together = car.solve(run, lanes)
    for some in ([0], [3], [7], [9, 2], list(range(23, -1, -1))):
        found = car.solve(run, lanes[some])
        for key in ("force", "motion", "error"):
            assert np.array_equal(getattr(found, key), getattr(together, key)[some])


def test_a_score_is_that_of_the_forces(car, lanes):
    run, target = car.prepare(shaken()), np.zeros((1, SAMPLES))
    expected = np.sum(np.square(car.forces(run, lanes)), axis=2).T
    assert car.score([run], [target], [target + 1.0], lanes)[0] == pytest.approx(expected, rel=1e-12)


def test_numba_gives_the_same(car, monkeypatch):
    values = car.start * np.exp(np.random.default_rng(4).uniform(-0.1, 0.1, (3, car.start.size)))
    expected = car.solve(car.prepare(shaken()), values)
    monkeypatch.setenv("DASHPOT_BACKEND", "numba")
    other = compiled(CAR)
    found = other.solve(other.prepare(shaken()), values)
    assert found.status == expected.status
    assert np.max(np.abs(found.force - expected.force)) <= 1e-12 * rms(expected.force)


def test_a_node_without_a_mass_keeps_the_steps_for_all_numbers():
    free = compiled(
        CAR.replace("body: {mass: 300 kg}", "body: free")
        + "  hook: {element: spring, stiffness: 9 N/mm, between: [body, ground_plate]}\n"
    )  # noqa: E501
    assert free.prepare(shaken()).quick is None
    assert compiled(CAR).prepare(shaken()).quick is not None

"""Every target gives the force that the interpreted graph gives, and the same status."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from parity.c_library import Library
from parity.cubics import along_cubics
from parity.random_networks import draw_network
from seeds import seed_of
from verification.shipped import NAMES, Dice, filled
from verification.systems import shipped, system

from dashpot import declare, load_registry
from dashpot.data.drive import Drive
from dashpot.data.excitation import Excitation
from dashpot.kernel.eager import simulate_interpreted
from dashpot.kernel.ir.system import TOLERANCE as NEWTON
from dashpot.kernel.jit import jit_network
from dashpot.kernel.network import compile_network
from dashpot.kernel.solution import Status
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import parse_network
from dashpot.testing import random_drive

TOLERANCE = 1e-12
CARRIED = 1e-11  # rounding that masses and springs carry on from step to step
RANDOM, JITTED = 50, 8
SYSTEMS = ("quarter_car", "axle_model_1", "axle_model_2", "axle_model_3", "axle_model_3_top_mount")
SOON = [name if name == "quarter_car" else pytest.param(name, marks=pytest.mark.slow) for name in SYSTEMS]


def error(found: np.ndarray, expected: np.ndarray) -> float:
    """The largest difference, as a share of the root mean square."""
    assert np.isfinite(expected).all() and np.isfinite(found).all()
    return float(np.max(np.abs(found - expected)) / (np.sqrt(np.mean(expected**2)) + np.finfo(float).tiny))


def jitted(spec: NetworkSpec, drive: Drive, values: np.ndarray) -> np.ndarray:
    out = np.empty(drive.samples)
    solver = jit_network(spec)
    assert solver.simulate_path is not None
    solver.simulate_path(drive.displacement, drive.velocity, drive.acceleration, drive.dt, values, out)
    return out


def on_numba(monkeypatch, spec: NetworkSpec, drive: Drive, values: np.ndarray) -> np.ndarray:
    monkeypatch.setenv("DASHPOT_BACKEND", "numba")
    network = compile_network(spec)
    return network.simulate(network.prepare(drive), values)


def fast(spec: NetworkSpec, drive: Drive, values: np.ndarray) -> np.ndarray:
    network = compile_network(spec)
    return network.simulate(network.prepare(drive), values)


def shipped_case(name: str) -> tuple[NetworkSpec, Drive, np.ndarray]:
    seed = seed_of(f"targets {name}")
    rng = np.random.default_rng(seed)
    spec = filled(name, Dice(seed))
    drive = random_drive(rng, "multisine", 6e-3, 0.01, 400, 1e-3)
    return spec, drive, compile_network(spec).start * np.exp(rng.uniform(-0.2, 0.2, len(spec.slots())))


@pytest.mark.parametrize("name", NAMES)
def test_every_target_agrees_on_shipped_networks(name, tmp_path, monkeypatch):
    spec, drive, values = shipped_case(name)
    expected = simulate_interpreted(spec, drive, values)
    outputs, status = Library.build(spec, tmp_path).along([drive], values)
    assert status == 0 and error(outputs[:, 0], expected) <= TOLERANCE
    assert error(fast(spec, drive, values), expected) <= TOLERANCE
    assert error(jitted(spec, drive, values), expected) <= TOLERANCE
    assert error(on_numba(monkeypatch, spec, drive, values), expected) <= TOLERANCE


@pytest.mark.parametrize("number", range(RANDOM))
def test_c_and_the_fast_target_agree_on_random_networks(number, tmp_path):
    spec, drive, values = draw_network(seed_of(f"random network {number}"))
    expected = simulate_interpreted(spec, drive, values)
    outputs, status = Library.build(spec, tmp_path).along([drive], values)
    assert status == 0 and error(outputs[:, 0], expected) <= TOLERANCE
    assert error(fast(spec, drive, values), expected) <= TOLERANCE


def agree_on_numba(number: int, monkeypatch) -> None:
    spec, drive, values = draw_network(seed_of(f"random network {number}"))
    expected = simulate_interpreted(spec, drive, values)
    assert error(jitted(spec, drive, values), expected) <= TOLERANCE
    assert error(on_numba(monkeypatch, spec, drive, values), expected) <= TOLERANCE


BESIDE = {
    "gas_spring": "force: 900 N, length: 40 mm, exponent: 1.3",
    "end_stop": "stiffness: 400 N/mm, compression: 3 mm, rebound: -4 mm",
    "clearance": "stiffness: 60 N/mm, gap: 1 mm",
}


@pytest.mark.parametrize("element", BESIDE)
def test_a_law_beside_a_table_has_the_deflection_on_every_target(element, tmp_path, monkeypatch):
    text = f"""format: dashpot-network/1
name: both
branches:
  curve:
    element: spring
    stiffness: {{deflection: [-8 mm, 0 mm, 8 mm], force: [{{start: -1 kN}}, 0 N, {{start: 2 kN}}]}}
  law: {{element: {element}, {BESIDE[element]}}}
"""
    spec = parse_network(text, load_registry().elements)
    drive = random_drive(np.random.default_rng(seed_of("beside a table")), "multisine", 6e-3, 0.01, 400, 1e-3)
    values = compile_network(spec).start
    expected = simulate_interpreted(spec, drive, values)
    outputs, status = Library.build(spec, tmp_path).along([drive], values)
    assert status == 0 and error(outputs[:, 0], expected) <= TOLERANCE
    assert error(jitted(spec, drive, values), expected) <= TOLERANCE
    assert error(on_numba(monkeypatch, spec, drive, values), expected) <= TOLERANCE


@pytest.mark.parametrize("number", range(JITTED))
def test_numba_agrees_on_random_networks(number, monkeypatch):
    agree_on_numba(number, monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(JITTED, RANDOM))
def test_numba_agrees_on_more_random_networks(number, monkeypatch):
    agree_on_numba(number, monkeypatch)


def system_case(name: str) -> tuple[NetworkSpec, Excitation]:
    rng = np.random.default_rng(seed_of(f"system {name}"))
    network = shipped(name)
    motions = {node: random_drive(rng, "multisine", 4e-3, 0.02, 200, 1e-3) for node in network.outputs}
    drive = next(iter(motions.values()))
    return network.spec, Excitation(motions, {}, {"added_mass": 0.0}, drive.dt, drive.samples, "run")


@pytest.mark.parametrize("name", SYSTEMS)
def test_c_agrees_on_networks_with_nodes(name, tmp_path):
    spec, excitation = system_case(name)
    network = shipped(name)
    expected = network.solve(network.prepare(excitation))
    outputs, status = Library.build(spec, tmp_path).along(list(excitation.motions.values()), network.start)
    count = len(expected.driven)
    assert status == 0 and expected.status == (Status.GOOD,)
    assert error(outputs[:, :count].T, expected.force[0]) <= CARRIED
    assert error(outputs[:, count:].T, expected.motion[0]) <= CARRIED


@pytest.mark.parametrize("name", SOON)
def test_numba_agrees_on_networks_with_nodes(name, monkeypatch):
    spec, excitation = system_case(name)
    network = shipped(name)
    values = network.start * np.exp(np.random.default_rng(1).uniform(-0.1, 0.1, (3, network.start.size)))
    values[1] = np.nan
    expected = network.solve(network.prepare(excitation), values)
    monkeypatch.setenv("DASHPOT_BACKEND", "numba")
    other = compile_network(spec)
    found = other.solve(other.prepare(excitation), values)
    assert found.status == expected.status and Status.NOT_FINITE in found.status
    assert error(found.force[[0, 2]], expected.force[[0, 2]]) <= CARRIED
    cubic = replace(excitation, motions={node: along_cubics(each) for node, each in excitation.motions.items()})
    stepped, alone = walked(spec, cubic, network.start), network.solve(network.prepare(cubic))
    assert error(stepped[:, : len(alone.driven)].T, alone.force[0]) <= CARRIED
    assert error(stepped[:, len(alone.driven) :].T, alone.motion[0]) <= CARRIED


def walked(spec: NetworkSpec, excitation: Excitation, values: np.ndarray) -> np.ndarray:
    """The answers (samples, answers) of a solver that is stepped."""
    solver = jit_network(spec)
    drives = [excitation.motions[node] for node in solver.driven]
    state = solver.state(span=max(float(np.ptp(each.displacement)) for each in drives))
    found = np.empty((excitation.samples, len(solver.driven) + len(solver.free)))
    for k, out in enumerate(found):
        x, v = (np.array([getattr(each, name)[k] for each in drives]) for name in ("displacement", "velocity"))
        solver.step_nodes(state, x, v, np.empty(0), excitation.dt, values, out)
    return found


def test_every_target_tells_alike_how_a_lane_failed(tmp_path, monkeypatch):
    spec, excitation = system_case("quarter_car")
    fast_network = shipped("quarter_car")
    rng = np.random.default_rng(seed_of("lanes that fail"))
    # of numbers off by up to a factor of 8000 many have no solution within the steps that Newton's method is given
    values = fast_network.start * np.exp(rng.uniform(-9.0, 9.0, (32, fast_network.start.size)))
    expected = fast_network.solve(fast_network.prepare(excitation), values).status
    assert {Status.GOOD, Status.UNSOLVED, Status.UNBALANCED} <= set(expected)
    monkeypatch.setenv("DASHPOT_BACKEND", "numba")
    other = compile_network(spec)
    assert other.solve(other.prepare(excitation), values).status == expected
    library, drives = Library.build(spec, tmp_path), list(excitation.motions.values())
    codes = [library.along(drives, lane)[1] for lane in values]
    assert [CODES[code] for code in codes] == list(expected)
    assert [CODES[stepped(spec, drives[0], lane)] for lane in values] == list(expected)


CODES = {0: Status.GOOD, 1: Status.UNSOLVED, 2: Status.UNBALANCED, 3: Status.NOT_FINITE}


def stepped(spec: NetworkSpec, drive: Drive, values: np.ndarray) -> int:
    """The status of a solver after the last step."""
    solver = jit_network(spec)
    state, nothing = solver.state(span=float(np.ptp(drive.displacement))), np.empty(0)
    out = np.empty(len(solver.driven) + len(solver.free))
    for x, v in zip(drive.displacement, drive.velocity, strict=True):
        solver.step_nodes(state, np.array([x]), np.array([v]), nothing, drive.dt, values, out)
    return int(solver.status(state))


def test_every_target_solves_stiff_friction_in_series(tmp_path, monkeypatch):
    network = system(
        "",
        "leg: {series: {k: {element: spring, stiffness: 900 N/mm}, "
        "c: {element: coulomb, limit: 60 N, creep_velocity: 1e-6 m/s}}}",
    )
    drive = random_drive(np.random.default_rng(seed_of("stiff friction")), "multisine", 3e-3, 0.02, 200, 1e-3)
    expected = network.solve(network.prepare(drive))
    assert expected.status == (Status.GOOD,)
    outputs, status = Library.build(network.spec, tmp_path).along([drive], network.start)
    # a step ends where the next one of Newton's method is short: so far may the end of the spring be off either way
    left, force = 2.0 * NEWTON * np.ptp(drive.displacement) * network.start[0], expected.force[0, 0]
    for found in (
        outputs[:, 0],
        jitted(network.spec, drive, network.start),
        on_numba(monkeypatch, network.spec, drive, network.start),
    ):
        assert np.sqrt(np.mean((found - force) ** 2)) <= 1e-6 * np.sqrt(np.mean(force**2))
        assert np.max(np.abs(found - force)) <= left
    assert status == 0


def test_every_target_catches_masses_at_rigid_stops(tmp_path, monkeypatch):
    network = system(
        "{base: driven, hub: {mass: 1 kg}, other: {mass: 0.4 kg}, wall: ground}",
        """
        leg: {element: maxwell, stiffness: 6 N/mm, relaxation_time: 5 ms, between: [base, hub]}
        back: {element: spring, stiffness: 9 N/mm, between: [other, wall]}
        rub: {element: ideal_coulomb, limit: 3 N, between: [hub, wall]}
        one: {element: rigid_stop, compression: 1 mm, between: [hub, other]}
        two: {element: rigid_stop, compression: 2 mm, rebound: -2 mm, between: [base, hub]}
        """,
    )
    spec, values = network.spec, network.start
    drive = along_cubics(
        random_drive(np.random.default_rng(seed_of("rigid stops")), "multisine", 6e-3, 0.02, 300, 1e-3)
    )
    excitation = Excitation({"base": drive}, {}, {}, drive.dt, drive.samples, "run")
    expected = network.solve(network.prepare(excitation))
    assert expected.status == (Status.GOOD,)
    # a stop of 1e14 N/m makes forces of the rounding of places
    outputs, status = Library.build(spec, tmp_path).along([drive], values)
    assert status == 0 and error(outputs[:, 0], expected.force[0, 0]) <= 1e-7
    assert error(walked(spec, excitation, values)[:, 0], expected.force[0, 0]) <= 1e-7
    monkeypatch.setenv("DASHPOT_BACKEND", "numba")
    other = compile_network(spec)
    found = other.solve(other.prepare(excitation), np.tile(values, (3, 1)))
    assert error(found.force[:, 0], np.tile(expected.force[0, 0], (3, 1))) <= 1e-7


WITHOUT_MEMORY = """
format: dashpot-network/1
name: plain
nodes: {lower: driven, body: {mass: 5 kg}, wall: ground}
branches:
  a: {element: spring, between: [lower, body], stiffness: 20 N/mm}
  b: {element: damper, between: [body, wall], damping: 100 N*s/m}
  c: {element: spring, between: [body, wall], stiffness: 40 N/mm}
"""


def test_every_target_solves_a_network_in_which_nothing_turns(tmp_path, monkeypatch):
    spec = declare(WITHOUT_MEMORY)
    drive = along_cubics(
        random_drive(np.random.default_rng(seed_of("nothing turns")), "multisine", 3e-3, 0.02, 200, 1e-3)
    )
    network = compile_network(spec)
    assert not network.system.passes["turn"].updates
    excitation = Excitation({"lower": drive}, {}, {}, drive.dt, drive.samples, "run")
    expected = network.solve(network.prepare(excitation)).force[0, 0]
    outputs, status = Library.build(spec, tmp_path).along([drive], network.start)
    assert status == 0 and error(outputs[:, 0], expected) <= TOLERANCE
    assert error(jitted(spec, drive, network.start), expected) <= TOLERANCE
    monkeypatch.setenv("DASHPOT_BACKEND", "numba")
    other = compile_network(spec)
    assert error(other.solve(other.prepare(excitation)).force[0, 0], expected) <= TOLERANCE


def test_an_unknown_backend_is_told(monkeypatch):
    from dashpot.kernel.targets.choice import backend
    from dashpot.text.problem import InputError

    monkeypatch.setenv("DASHPOT_BACKEND", "numpa")
    with pytest.raises(InputError, match="expected one of llvm, numba, got 'numpa'"):
        backend()


def test_the_sources_are_the_same_each_time(tmp_path: Path):
    first, second = tmp_path / "a", tmp_path / "b"
    for folder in (first, second):
        folder.mkdir()
        Library.build(shipped_case("gehmann")[0], folder)
    assert (first / "gehmann.c").read_bytes() == (second / "gehmann.c").read_bytes()

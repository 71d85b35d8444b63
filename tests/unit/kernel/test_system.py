"""Networks with unknown nodes as blocks of lanes: company, scores, settings, and how a lane may fail."""

from __future__ import annotations

import textwrap
from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of
from unit.kernel.networks import ELEMENTS

from dashpot.data.drive import drive_from_path, drive_from_samples
from dashpot.data.excitation import Excitation
from dashpot.fit.objective import Objective
from dashpot.fit.scored import ScoredRun
from dashpot.kernel import system as module
from dashpot.kernel.api import solve
from dashpot.kernel.network import compile_network
from dashpot.kernel.solution import Status
from dashpot.kernel.system import CompiledSystem
from dashpot.kernel.within import FINEST
from dashpot.model.reading import parse_network, read_network
from dashpot.text.problem import InputError

SAMPLES, DT = 120, 1e-3
AXLE = """
gravity: 9.81 m/s^2
nodes:
  left: driven
  right: driven
  wheel: {mass: 30 kg, added_mass: {setting: added_mass, value: 0 kg}}
  wheel_right: {same_as: wheel}
  body: ground
branches:
  tire: {element: spring, stiffness: 200 N/mm, between: [left, wheel], offset: 5 mm}
  tire_right: {same_as: tire, between: [right, wheel_right]}
  strut:
    between: [wheel, body]
    series: {absorber: {element: damper, damping: 900 N*s/m}, mount: {element: spring, stiffness: 300 N/mm}}
  strut_right: {same_as: strut, between: [wheel_right, body]}
  friction: {element: dahl, stiffness: 100 N/mm, limit: 40 N, between: [wheel, body]}
  bar: {element: spring, stiffness: 20 N/mm, between: [wheel, wheel_right]}
  springs: {element: spring, stiffness: 25 N/mm, between: [wheel, body]}
  springs_right: {same_as: springs, between: [wheel_right, body]}
"""


def compiled(text: str) -> CompiledSystem:
    return compile_network(parse_network(f"format: dashpot-network/1\nname: bench\n{text}", ELEMENTS, "n.yaml"))


def shaken(network: CompiledSystem, amplitude: float = 3e-3, samples: int = SAMPLES, **settings: float) -> Excitation:
    """Every driven node on its own sine, from rest."""
    time, motions = DT * np.arange(samples), {}
    for number, node in enumerate(network.outputs):
        omega = 2.0 * np.pi * (11.0 + 4.0 * number)
        x, v = amplitude * (1.0 - np.cos(omega * time)), amplitude * omega * np.sin(omega * time)
        motions[node] = drive_from_path(DT, x, v, amplitude * omega**2 * np.cos(omega * time))
    return Excitation(motions, {}, settings, DT, samples)


@pytest.fixture(scope="module")
def axle() -> CompiledSystem:
    return compiled(AXLE)


@pytest.fixture(scope="module")
def block(axle) -> np.ndarray:
    """64 lanes, some of them far from the others, so that Newton's method ends at other times."""
    seed = seed_of("test_system")
    print(f"seed {seed}")
    rng = np.random.default_rng(seed)
    return axle.start * np.exp(rng.uniform(-1.0, 1.0, (64, axle.start.size)))


def test_a_lane_alone_is_bitwise_the_same_among_63_others(axle, block):
    run = axle.prepare(shaken(axle))
    together = axle.solve(run, block)
    assert set(together.status) == {Status.GOOD}
    for lanes in ([0], [17], [63], [5, 40], list(range(63, -1, -1))):
        some = axle.solve(run, block[lanes])
        assert np.array_equal(some.force, together.force[lanes])
        assert np.array_equal(some.motion, together.motion[lanes])
        assert np.array_equal(some.error, together.error[lanes])


def test_more_lanes_than_a_block_holds_are_answered_in_their_order(axle, block):
    run = axle.prepare(shaken(axle))
    many = np.concatenate([block, block[::-1], block[:3]])
    found, once = axle.forces(run, many), axle.forces(run, block)
    assert np.array_equal(found, np.concatenate([once, once[::-1], once[:3]]))


def test_a_score_is_the_weighted_sum_of_squared_errors_at_every_driven_node(axle, block):
    rng = np.random.default_rng(3)
    runs = [axle.prepare(shaken(axle)), axle.prepare(shaken(axle, 1e-3, 90, added_mass=4.0))]
    measured = [1e3 * rng.standard_normal((2, run.excitation.samples)) for run in runs]
    weights = [rng.uniform(0.0, 1.0, target.shape) for target in measured]
    expected = [
        np.einsum("lns,ns->nl", (axle.forces(run, block) - target) ** 2, weight)
        for run, target, weight in zip(runs, measured, weights, strict=True)
    ]
    for jobs in (1, 2):
        assert axle.score(runs, measured, weights, block, jobs) == pytest.approx(np.array(expected), rel=1e-11)


def test_a_setting_of_the_run_stands_for_the_number_that_asks_for_it(axle):
    added = axle.start.copy()
    added[axle.paths.index("wheel.added_mass")] = 12.0
    given = axle.forces(axle.prepare(shaken(axle, added_mass=12.0)))
    assert np.array_equal(given, axle.forces(axle.prepare(shaken(axle)), added))
    heavier = added.copy()
    heavier[[axle.paths.index(f"wheel.{key}") for key in ("mass", "added_mass")]] = 42.0, 0.0
    assert given == pytest.approx(axle.forces(axle.prepare(shaken(axle)), heavier), rel=1e-12)


def test_a_motion_that_is_missing_is_named(axle):
    whole = shaken(axle)
    with pytest.raises(InputError, match="displacement@right"):
        axle.prepare(replace(whole, motions={"left": whole.motions["left"]}))


def test_the_force_at_a_node_is_asked_for_by_its_name(axle):
    run = axle.prepare(shaken(axle))
    found = axle.solve(run)
    assert (found.driven, found.unknown[:2]) == (("left", "right"), ("wheel", "wheel_right"))
    for number, node in enumerate(found.driven):
        assert np.array_equal(axle.simulate(run, end=node), found.force[0, number])
    assert found.force.shape == (1, 2, SAMPLES) and found.motion.shape == (1, len(found.unknown), SAMPLES)


@pytest.mark.parametrize("path", ["wheel.mass", "friction.limit", "tire.stiffness", "strut.mount.stiffness"])
def test_a_number_that_is_none_fails_its_own_lane_alone(axle, block, path):
    run = axle.prepare(shaken(axle))
    sound = axle.forces(run, block)
    broken = block.copy()
    broken[[2, 50], axle.paths.index(path)] = np.nan, np.inf
    found = axle.solve(run, broken)
    assert found.status[2] is Status.NOT_FINITE
    others = np.delete(np.arange(64), [2, 50])
    assert np.array_equal(found.force[others], sound[others])


def test_what_no_force_holds_has_no_equilibrium_and_says_so():
    hanging = compiled("""
gravity: 9.81 m/s^2
nodes: {table: driven, block: {mass: 20 kg}}
branches:
  d: {element: damper, damping: 200 N*s/m, between: [table, block]}
  k: {element: contact, stiffness: 200 N/mm, between: [block, table]}
""")
    run = hanging.prepare(shaken(hanging))
    found = hanging.solve(run)
    assert found.status == (Status.UNBALANCED,)
    assert "no static equilibrium" in found.status[0].value
    assert np.isnan(hanging.simulate(run)).all()
    assert np.isnan(hanging.score([run], [np.zeros((1, SAMPLES))], [np.ones((1, SAMPLES))], hanging.start)).all()


def test_a_path_that_can_only_slide_stays_finite():
    sliders = compiled("""
branches:
  leg: {series: {a: {element: dahl, stiffness: 200 N/mm, limit: 20 N}, b: {element: dahl, stiffness: 100 N/mm, limit: 10 N}}}
""")  # noqa: E501
    found = sliders.solve(sliders.prepare(shaken(sliders, 5e-3, 300)))
    assert found.status == (Status.GOOD,)
    # the weaker one decides
    assert np.max(np.abs(found.force)) == pytest.approx(10.0, rel=1e-3)
    assert np.max(np.abs(found.motion)) < 11e-3


def test_a_lane_that_fails_costs_infinity(axle):
    excitation = shaken(axle)
    force = axle.simulate(axle.prepare(excitation), end="right")
    run = ScoredRun("it", "harmonic", excitation.motions["right"], force, 0, "right", whole=excitation)
    values = np.repeat(axle.start[None], 3, axis=0)
    values[1, axle.paths.index("wheel.mass")] = np.nan
    values[2, axle.paths.index("tire.stiffness")] *= 1.1
    losses = Objective(axle, [run]).losses(values)
    assert losses[0] == pytest.approx(0.0, abs=1e-9)
    assert losses[1] == np.inf
    assert 0.0 < losses[2] < np.inf


def test_halving_the_steps_is_what_the_estimate_comes_from(axle):
    estimates = [axle.solve(axle.prepare(shaken(axle), pairs)).error for pairs in (1, 2, 4)]
    assert np.log2(estimates[0] / estimates[1]) == pytest.approx(np.full((1, 2), 2.0), abs=0.3)
    assert np.log2(estimates[1] / estimates[2]) == pytest.approx(np.full((1, 2), 2.0), abs=0.3)


@pytest.mark.parametrize("backend", ["llvm", "numba"])
def test_a_long_record_goes_through_in_pieces_to_the_same_bits(monkeypatch, backend):
    monkeypatch.setenv("DASHPOT_BACKEND", backend)
    network = compile_network(read_network("axle_model_1", ELEMENTS))
    time = 1e-3 * np.arange(700)
    motions = {
        node: drive_from_samples(1e-3, 5e-3 * np.sin(2 * np.pi * f * time) + 1e-3 * np.cos(70.0 * time))
        for node, f in (("platform_left", 3.0), ("platform_right", 4.3))
    }
    excitation = Excitation(motions, dt=1e-3, samples=700, settings={"added_mass": 0.0})
    whole = network.solve(network.prepare(excitation))
    measured, weight = np.zeros((2, 700)), np.ones((2, 700))
    score = network.score([network.prepare(excitation)], [measured], [weight], network.start[None])
    for size, kept, stretch in ((300, 0, 4000), (300, 1000, 4000), (350, 0, 97), (1, 0, 4000), (700, 0, 64)):
        monkeypatch.setattr(module, "PIECE", size)
        monkeypatch.setattr(module, "KEPT", kept)
        monkeypatch.setattr(module, "STRETCH", stretch)
        rows = network.prepare(excitation)
        found = network.solve(rows)
        for key in ("force", "motion", "error"):
            assert getattr(found, key).tobytes() == getattr(whole, key).tobytes(), (size, key)
        assert network.score([rows], [measured], [weight], network.start[None]).tobytes() == score.tobytes()


SLIDING = """
mount: {element: spring, stiffness: 400 N/mm, between: [base, hub]}
dry: {element: coulomb, limit: 60 N, creep_velocity: 1e-5 m/s, between: [hub, wall]}
stop: {element: end_stop, stiffness: 900 N/mm, compression: 0.5 mm, rebound: -0.5 mm, between: [hub, wall]}
"""


def test_steps_are_halved_until_the_error_is_within_the_tolerance():
    text = (
        "format: dashpot-network/1\nname: n\nnodes: {base: driven, hub: free, wall: ground}\nbranches:\n"
        + textwrap.indent(SLIDING.strip("\n"), "  ")
        + "\n"
    )
    network = compile_network(parse_network(text, ELEMENTS))
    time = 1e-3 * np.arange(400)
    excitation = Excitation.of_drive(drive_from_samples(1e-3, 2e-3 * np.sin(2 * np.pi * 7.0 * time)))
    truth = network.solve(network.prepare(excitation, 256)).force[0, 0]
    size, refined = np.sqrt(np.mean(truth**2)), []
    for tolerance in (1e-1, 1e-3, 1e-4):
        found = solve(network, excitation, tolerance=tolerance)
        [told] = found.error.values()
        [force] = found.force.values()
        assert np.sqrt(np.mean((force - truth) ** 2)) <= told
        assert np.max(np.abs(force - truth)) <= found.peak["base"]
        assert told <= tolerance * size * 1.001 or found.refine == FINEST
        refined.append(found.refine)
    assert refined == sorted(refined) and refined[0] == 2 < refined[-1]
    assert solve(network, excitation, 3).refine == 3

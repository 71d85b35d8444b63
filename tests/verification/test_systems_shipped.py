"""Every shipped network with unknown nodes against an integration of its equations of motion to ten digits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from seeds import seed_of
from verification.systems import drawn, excitation, rms, shipped, times
from verification.truth.motion import Cosines, smooth_motion
from verification.truth.vehicle import axle_of, quarter_car_of

from dashpot import load_registry
from dashpot.kernel.solution import Solution, Status
from dashpot.kernel.system import CompiledSystem
from dashpot.model.reading import read_network
from dashpot.model.shipped import shipped_networks
from dashpot.model.topology import topology_of

# the tire of each axle, and whether its shock absorbers have top mounts
AXLES = {
    "axle_model_1": ("kelvin_voigt", True),
    "axle_model_2": ("ftire", True),
    "axle_model_3": ("model_5", False),
    "axle_model_3_top_mount": ("model_5", True),
}
QUICK = ("quarter_car", "axle_model_1", "axle_model_3", "axle_model_3_top_mount")
SECONDS, ADDED = 0.4, 7.5


@pytest.fixture
def rng() -> np.random.Generator:
    seed = seed_of("test_systems_shipped")
    print(f"seed {seed}")
    return np.random.default_rng(seed)


@dataclass(frozen=True)
class Case:
    """Numbers of one network and motions of its platforms, right and left alike or opposite to each other."""

    name: str
    values: np.ndarray
    left: Cosines
    right: Cosines

    @property
    def network(self) -> CompiledSystem:
        return shipped(self.name)

    @classmethod
    def draw(cls, name: str, rng: np.random.Generator, way: float) -> Case:
        left = smooth_motion(rng, rng.uniform(-6e-3, 6e-3), rng.uniform(1e-3, 5e-3))
        return cls(name, drawn(shipped(name), rng), left, left.scaled(way))

    def truth(self) -> np.ndarray:
        """Forces (platforms, n)."""
        at, model = times(SECONDS), vehicle(self.network, self.name, self.values, ADDED)
        return (
            model.force(self.left, at)[None] if self.name == "quarter_car" else model.forces(self.left, self.right, at)
        )

    def found(self, pairs: int = 1) -> Solution:
        motions = dict(zip(self.network.outputs, (self.left, self.right), strict=False))
        run = self.network.prepare(excitation(times(SECONDS), motions, {"added_mass": ADDED}), pairs)
        return self.network.solve(run, self.values)


def vehicle(network: CompiledSystem, name: str, values: np.ndarray, added: float):
    """The independent model with the numbers of one lane."""
    numbers = dict(zip(network.paths, map(float, values), strict=True))
    knots = {path: curve.at for path, curve in network.spec.curves().items()}
    if name == "quarter_car":
        return quarter_car_of(numbers, knots, added)
    return axle_of(numbers, knots, *AXLES[name], added)


def test_every_shipped_network_with_unknown_nodes_is_verified_here_or_among_the_components():
    elements = load_registry().elements
    names = {name for name in shipped_networks() if not topology_of(read_network(name, elements)).parallel}
    # two with a series connection between two ends stand in test_components
    assert names == {"quarter_car", *AXLES, "engine_mount", "tread_block"}


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("name", QUICK)
def test_the_forces_agree_with_an_integration_within_their_estimated_error(name, way, rng, state):
    case = Case.draw(name, rng, way)
    truth, found = case.truth(), case.found()
    error = rms(found.force[0] - truth)
    state(
        f"{name}, {'in phase' if way > 0 else 'in anti-phase'}, at 1 ms: error {error.max():.1e} N, estimate "
        f"{found.error.max():.1e} N, of the RMS {truth.std(axis=1).max():.0f} N"
    )
    assert found.status == (Status.GOOD,)
    assert np.all(error <= found.error[0])
    assert np.max(np.abs(found.force[0] - truth)) < 2e-4 * truth.std(axis=1).max()


@pytest.mark.slow
def test_the_estimated_error_holds_over_many_draws(rng, state):
    draws = [("quarter_car", 1.0)] * 16 + [(name, way) for name in AXLES for way in (1.0, -1.0) for _ in range(8)]
    shares, orders = [], []
    for name, way in draws:
        case = Case.draw(name, rng, way)
        truth, found, finer = case.truth(), case.found(), case.found(4)
        error = rms(found.force[0] - truth)
        assert found.status == (Status.GOOD,)
        assert np.max(np.abs(found.force[0] - truth)) < 2e-4 * truth.std(axis=1).max()
        shares.append(np.max(error / found.error[0]))
        orders.append(np.log2(np.max(error) / np.max(rms(finer.force[0] - truth))) / 2.0)
    state(
        f"{len(draws)} draws of shipped networks at 1 ms: error over estimate median {np.median(shares):.3f}, "
        f"95 % below {np.quantile(shares, 0.95):.3f}, largest {max(shares):.3f}, smallest {min(shares):.4f}; order "
        f"with friction {np.median(orders):.2f}"
    )
    assert np.mean(np.array(shares) <= 1.0) >= 0.95
    assert np.median(shares) > 0.01
    assert np.median(orders) > 1.7


@pytest.mark.parametrize("name", ["quarter_car", "axle_model_1", "axle_model_3"])
def test_the_record_begins_in_the_static_equilibrium(name, rng):
    network = shipped(name)
    values = np.array([drawn(network, rng) for _ in range(40)])
    still = [Cosines(rng.uniform(-15e-3, 15e-3), np.zeros(1), np.ones(1)) for _ in network.outputs]
    run = network.prepare(excitation(times(5e-3), dict(zip(network.outputs, still, strict=True))))
    found = network.solve(run, values)
    assert set(found.status) == {Status.GOOD}
    for lane, motion in zip(values, found.motion, strict=True):
        model = vehicle(network, name, lane, 0.0)
        places = [motion.mean for motion in still]
        rest = model.equilibrium(places[0])[[0, 2]] if name == "quarter_car" else model.equilibrium(places)
        assert motion[:2, 0] == pytest.approx(rest, abs=1e-9)
        assert np.ptp(motion[:2], axis=1) == pytest.approx(0.0, abs=1e-9)


def test_gravity_compresses_the_springs_by_the_weight_above_them():
    network = shipped("quarter_car")
    still = Cosines(0.0, np.zeros(1), np.ones(1))
    found = network.solve(network.prepare(excitation(times(5e-3), {"platform": still}, {"added_mass": ADDED})))
    assert found.force[0, 0] == pytest.approx((36.0 + ADDED + 346.0) * 9.81, rel=1e-9)
    wheel, body = found.motion[0, :, 0]
    assert wheel - body + 0.133 == pytest.approx(346.0 * 9.81 / 25570.0, rel=1e-8)

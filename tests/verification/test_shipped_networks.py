"""The force of every shipped network against an independent integration with ten digits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from seeds import seed_of
from verification.shipped import NAMES, Dice, filled
from verification.truth.history import Histories
from verification.truth.static import elastic, factor

from dashpot.data.drive import drive_from_path, drive_from_samples
from dashpot.kernel.network import compile_network
from dashpot.model.network import Branch, NetworkSpec

DT, SECONDS = 1e-3, 3.0
MIDDLE, AMPLITUDE = 16e-3, 4e-3
SLOWEST, FASTEST = 1.0, 25.0
TIME = DT * np.arange(int(SECONDS / DT) + 1)


def phase(t):
    return 2.0 * np.pi * (SLOWEST * t + 0.5 * (FASTEST - SLOWEST) * t**2 / SECONDS)


def speed(t):
    return 2.0 * np.pi * (SLOWEST + (FASTEST - SLOWEST) * t / SECONDS)


def position(t):
    return MIDDLE + AMPLITUDE * np.sin(phase(t))


def velocity(t):
    return AMPLITUDE * speed(t) * np.cos(phase(t))


def turns():
    # the phase is an odd multiple of a quarter turn
    angles = np.pi * (np.arange(0, int(phase(SECONDS) / np.pi)) + 0.5)
    rise = 2.0 * np.pi * (FASTEST - SLOWEST) / SECONDS
    start = 2.0 * np.pi * SLOWEST
    return (np.sqrt(start**2 + 2.0 * rise * angles) - start) / rise


# largest distance between a sine and its cubics, at the fastest end of the sweep
CUBIC_ERROR = AMPLITUDE * (2.0 * np.pi * FASTEST * DT) ** 4 / 384.0


def steepest(spec: NetworkSpec) -> float:
    """What the force can change per metre right after a reversal; a slider is twice as stiff there."""
    slopes = [
        (2.0 if branch.element.word == "dahl" else 1.0) * branch.values["stiffness"].number
        for branch in spec.leaves()
        if branch.element.declares.states
    ]
    return sum(slopes)


def damping(spec: NetworkSpec) -> float:
    """What the forces of all dampers can change per m/s."""
    return sum(
        branch.curves["damping"].values[0].number * (max(table(branch.scale)[1]) if branch.scale else 1.0)
        for branch in spec.leaves()
        if branch.element.word == "damper"
    )


@dataclass
class Truth:
    """Forces with memory of all branches of all networks, along the cubic path and along the true motion."""

    networks: dict[str, NetworkSpec]
    histories: Histories
    x: np.ndarray
    v: np.ndarray
    along_cubics: np.ndarray
    along_curve: np.ndarray

    def force(self, name: str, x: np.ndarray, v: np.ndarray, memory: np.ndarray) -> np.ndarray:
        return sum(self.branch(branch, x, v, memory) for branch in self.networks[name].leaves())

    def branch(self, branch: Branch, x: np.ndarray, v: np.ndarray, memory: np.ndarray) -> np.ndarray:
        word = branch.element.word
        if word == "spring":
            found = elastic(*table(branch.curves["stiffness"]), x)
        elif word == "damper":
            found = branch.curves["damping"].values[0].number * v
        else:
            found = memory[self.histories.place(word, numbers(branch))]
        return found if branch.scale is None else found * factor(*table(branch.scale), x)


def table(curve) -> tuple[np.ndarray, np.ndarray]:
    return np.array(curve.at), np.array([value.number for value in curve.values])


def numbers(branch: Branch) -> tuple[float, ...]:
    orders = {"maxwell": ("stiffness", "relaxation_time"), "hydro": ("fluid_mass", "stiffness", "damping")}
    order = orders.get(branch.element.word, ("stiffness", "limit"))
    assert set(branch.values) == set(order)
    return tuple(branch.values[key].number for key in order)


@pytest.fixture(scope="module")
def truth(state: Callable[[str], None]) -> Truth:
    seed = seed_of("test_shipped_networks")
    state(f"random numbers of the networks: seed {seed}")
    dice, histories = Dice(seed), Histories()
    networks = {name: filled(name, dice) for name in NAMES}
    for spec in networks.values():
        for branch in spec.leaves():
            if branch.element.declares.states:
                histories.ask(branch.element.word, numbers(branch))
    x, v = position(TIME), velocity(TIME)
    return Truth(
        networks, histories, x, v, histories.along_cubics(DT, x, v), histories.along_curve(velocity, turns(), TIME)
    )


@pytest.mark.parametrize("name", NAMES)
def test_the_force_agrees_with_an_integration_of_the_same_path(name, truth, state):
    network = compile_network(truth.networks[name])
    drive = drive_from_path(DT, truth.x, truth.v, np.gradient(truth.v, DT))
    found = network.simulate(network.prepare(drive))
    expected = truth.force(name, truth.x, truth.v, truth.along_cubics)
    error, size = np.max(np.abs(found - expected)), np.sqrt(np.mean((expected - expected.mean()) ** 2))
    state(f"{name}: largest error along the same cubic path {error:.1e} N, {error / size:.1e} of the RMS {size:.0f} N")
    assert error <= 1e-6 * size


@pytest.mark.parametrize("name", NAMES)
def test_the_path_between_the_samples_costs_little_against_the_true_motion(name, truth, state):
    network = compile_network(truth.networks[name])
    expected = truth.force(name, truth.x, truth.v, truth.along_curve)
    known = drive_from_path(DT, truth.x, truth.v, np.gradient(truth.v, DT))
    splined = drive_from_samples(DT, truth.x)
    errors = [network.simulate(network.prepare(drive)) - expected for drive in (known, splined)]
    largest = [np.max(np.abs(error)) for error in errors]
    state(
        f"{name}: largest error against the true sweep {largest[0]:.1e} N with its velocities, "
        f"{largest[1]:.1e} N from displacement samples alone"
    )
    # the velocity of the spline is off by some um/s at the ends of the record, which the dampers feel
    slip = np.max(np.abs(splined.velocity - truth.v))
    assert max(largest) < 1e-4 + 1.01 * slip * damping(truth.networks[name]) + CUBIC_ERROR * steepest(
        truth.networks[name]
    )

"""A parallel network branch by branch adds up to the whole."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.kernel.networks import compiled
from verification.shipped import NAMES, Dice, filled

from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.kernel.parts import take_apart
from dashpot.kernel.scratch import Scratch
from dashpot.testing import random_drive

DRIVE = random_drive(np.random.default_rng(3), "multisine", 6e-3, 0.01, 400, 1e-3)
EVERYTHING = """
    a: {element: spring, stiffness: 1e5}
    b: {element: spring, stiffness: {deflection: [-2 mm, 0 mm, 1 mm], force: [-200, 0, 150]}}
    c: {element: spring, stiffness: {deflection: [-3 mm, 0 mm, 1 mm], force: [-200, 0, 150]}}
    d: {element: spring, stiffness: {polynomial: [1e5, 1e6]}}
    dd: {element: spring, stiffness: {polynomial: [1e5, 1e6, 1e8]}}
    e: {element: damper, damping: 100}
    f: {element: damper, damping: 100, scale: {deflection: [-1 mm, 1 mm], factor: [1.5, 0.5]}}
    g: {element: quadratic_damper, damping: 80}
    h: {element: inerter, inertance: 2}
    i: {repeat: 2, element: maxwell, stiffness: [1e4, 2e4], relaxation_time: [5 ms, 50 ms]}
    j: {element: dahl, stiffness: 6e4, limit: 15}
    k: {element: dahl, stiffness: 7e4, limit: 25}
    l: {element: prandtl, stiffness: 2e4, limit: 20}
"""


def assert_adds_up(network: CompiledNetwork) -> None:
    parts = take_apart(network.spec)
    rng = np.random.default_rng(seed_of("test_parts"))
    values = network.start * np.exp(rng.uniform(-0.1, 0.1, network.start.size))
    which = [k for k, path in enumerate(network.paths) if not path.startswith("measurement")]
    shifts = 1e-3 * np.where(values[which] == 0.0, 1.0, values[which])
    moves = np.zeros((len(which), values.size))
    moves[np.arange(len(which)), which] = shifts
    rows = [part.network.prepare(DRIVE) for part in parts.members]
    force, *changes = parts.sensitivities(rows, parts.lanes(values, moves), len(which), Scratch())
    run = network.prepare(DRIVE)
    moved = np.repeat(values[None], len(which), axis=0)
    moved[np.arange(len(which)), which] += shifts
    whole = network.simulate(run, values)
    scale = np.max(np.abs(whole))
    assert np.max(np.abs(force - whole)) < 1e-12 * scale
    assert np.max(np.abs(changes - (network.simulate(run, moved) - whole))) < 1e-11 * scale


@pytest.mark.parametrize("name", NAMES)
def test_a_shipped_network_is_the_sum_of_its_branches(name):
    assert_adds_up(compile_network(filled(name, Dice(1))))


def test_branches_of_all_makes_are_kept_apart():
    assert_adds_up(compiled(EVERYTHING))


def test_branches_of_one_make_share_a_block():
    parts = take_apart(
        compiled(
            "it: {repeat: 3, element: maxwell, stiffness: 5, relaxation_time: 5}\nmore: {element: damper, damping: 5}"
        ).spec
    )
    assert sorted(len(part.slots) for part in parts.members) == [1, 3]


def test_what_the_force_channel_does_belongs_to_no_branch():
    network = compiled("it: {element: spring, stiffness: 5}", "measurement: {force: {delay: 1 ms}}\n")
    assert take_apart(network.spec).outside.tolist() == [False, True]

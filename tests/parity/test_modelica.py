"""The functions of an exported Modelica package give the force that the interpreted graph gives.

They are translated statement by statement from the text (``unit/exports/modelica_functions``), by no part of dashpot.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from parity.cubics import along_cubics
from parity.random_networks import draw_network
from parity.test_targets import (
    SYSTEMS,
    TOLERANCE,
    WITHOUT_MEMORY,
    error,
    shipped_case,
    system_case,
)
from seeds import seed_of
from unit.exports.modelica_functions import Array, functions_of
from verification.shipped import NAMES
from verification.systems import shipped

from dashpot import declare, load_registry
from dashpot.data.drive import Drive
from dashpot.data.excitation import Excitation
from dashpot.kernel.eager import simulate_interpreted
from dashpot.kernel.export import exported
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec
from dashpot.testing import random_drive

RANDOM, QUICK = 50, 20


def sampled(spec: NetworkSpec, drives: list[Drive], values: np.ndarray) -> np.ndarray:
    """The outputs (samples, outputs) of the function that the model calls at every sample."""
    [text] = load_registry().exports["modelica"]().files(spec).values()
    step, online = functions_of(text.decode())["sampled"], exported(spec).online
    span, memory, found = max(float(np.ptp(each.displacement)) for each in drives), Array(np.zeros(online.size)), []
    for k in range(drives[0].samples):
        x, v = (Array([getattr(each, name)[k] for each in drives]) for name in ("displacement", "velocity"))
        memory = step(memory, drives[0].dt, Array(values), x, v, Array([]), span)
        found.append(memory.values[online.outputs : online.before])
    return np.array(found)


@pytest.mark.parametrize("name", NAMES)
def test_modelica_agrees_on_shipped_networks(name):
    spec, drive, values = shipped_case(name)
    drive = along_cubics(drive)
    expected = simulate_interpreted(spec, drive, values)
    assert error(sampled(spec, [drive], values)[:, 0], expected) <= TOLERANCE


def agrees(number: int) -> None:
    spec, drive, values = draw_network(seed_of(f"random network {number}"))
    drive = along_cubics(drive)
    expected = simulate_interpreted(spec, drive, values)
    assert error(sampled(spec, [drive], values)[:, 0], expected) <= TOLERANCE


@pytest.mark.parametrize("number", range(QUICK))
def test_modelica_agrees_on_random_networks(number):
    agrees(number)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(QUICK, RANDOM))
def test_modelica_agrees_on_more_random_networks(number):
    agrees(number)


@pytest.mark.parametrize("name", SYSTEMS)
def test_modelica_agrees_on_networks_with_nodes(name):
    spec, excitation = system_case(name)
    cubic = replace(excitation, motions={node: along_cubics(each) for node, each in excitation.motions.items()})
    network = shipped(name)
    expected = network.solve(network.prepare(cubic))
    found = sampled(spec, list(cubic.motions.values()), network.start)
    count = len(expected.driven)
    assert error(found[:, :count].T, expected.force[0]) <= TOLERANCE
    # a motion sums up the rounding of the accelerations of all steps, twice
    assert error(found[:, count:].T, expected.motion[0]) <= 2.0 * TOLERANCE


def test_modelica_agrees_on_a_network_in_which_nothing_turns():
    spec = declare(WITHOUT_MEMORY)
    drive = along_cubics(
        random_drive(np.random.default_rng(seed_of("nothing turns")), "multisine", 3e-3, 0.02, 200, 1e-3)
    )
    network = compile_network(spec)
    excitation = Excitation({"lower": drive}, {}, {}, drive.dt, drive.samples, "run")
    expected = network.solve(network.prepare(excitation)).force[0, 0]
    assert error(sampled(spec, [drive], network.start)[:, 0], expected) <= TOLERANCE

"""A Modelica compiler gives the force that dashpot simulates: stored, and anew where it is installed."""

from __future__ import annotations

import json

import numpy as np
import pytest
from parity.modelica_compiler import STORED, compiled_force, motion, network
from parity.test_targets import TOLERANCE, error
from verification.shipped import NAMES

from dashpot.kernel.network import compile_network


def simulated(name: str) -> np.ndarray:
    compiled = compile_network(network(name))
    return compiled.simulate(compiled.prepare(motion()))


@pytest.mark.parametrize("name", NAMES)
def test_the_stored_forces_are_those_that_dashpot_simulates(name):
    kept = json.loads(STORED.read_text(encoding="utf-8"))
    assert error(np.array(kept["forces"][name]), simulated(name)[:: kept["every"]]) <= TOLERANCE


@pytest.mark.parametrize("name", NAMES)
def test_a_compiler_gives_the_simulated_force(name):
    pytest.importorskip("rumoca")
    assert error(compiled_force(network(name)), simulated(name)) <= TOLERANCE

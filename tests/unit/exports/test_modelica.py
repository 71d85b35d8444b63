"""What a Modelica tool gets."""

from __future__ import annotations

import numpy as np
import pytest
from unit.exports.modelica_functions import Array, functions_of
from unit.exports.mounts import leg, mount, sine

from dashpot import declare, load_registry
from dashpot.kernel.network import compile_network
from dashpot.text.problem import InputError

CURVED = """
format: dashpot-network/1
name: curved
branches:
  rubber: {element: spring, stiffness: {deflection: [-2 mm, 0 mm, 1 mm, 3 mm], force: [-300 N, 0 N, 200 N, 900 N]}}
  sliding: {element: prandtl, stiffness: 400 N/mm, limit: 50 N}
"""


def written(network) -> str:
    [content] = load_registry().exports["modelica"]().files(network).values()
    return content.decode()


@pytest.mark.parametrize("network", [mount(), declare(CURVED)], ids=["mount", "curved"])
def test_the_functions_give_the_simulated_force(network):
    sampled, drive = functions_of(written(network))["sampled"], sine()
    compiled = compile_network(network)
    memory, force = Array(np.zeros(written(network).count("\n") + 200)), []
    for x, v in zip(drive.displacement.tolist(), drive.velocity.tolist(), strict=True):
        memory = sampled(memory, drive.dt, Array(compiled.start), x, v)
        force.append(memory[8])
    expected = compiled.simulate(compiled.prepare(drive))
    assert np.max(np.abs(force - expected)) <= 1e-12 * np.max(np.abs(expected))


@pytest.mark.parametrize("network", [mount(), declare(CURVED)], ids=["mount", "curved"])
def test_a_parser_takes_the_text(network):
    parser = pytest.importorskip("pymoca.parser")
    tree = parser.parse(written(network))
    assert tree is not None
    inner = tree.classes[network.name].classes
    assert {"Specimen", "Law"} <= set(inner) and "sampled" in inner["Law"].classes


def test_numbers_are_parameters_with_units():
    assert "parameter Real 'friction.limit'(unit = \"N\") = 60.0;" in written(mount())


def test_a_network_with_inner_nodes_is_refused_by_name():
    with pytest.raises(InputError, match="the network has 'leg:1' whose motion is solved for"):
        written(leg())

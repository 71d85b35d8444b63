"""The text of a kernel: equal networks give equal texts."""

from __future__ import annotations

import math
import re
import subprocess
import sys

import numpy as np
from seeds import seed_of
from unit.kernel.networks import network

from dashpot.kernel.compiler.tiers import sort_tiers
from dashpot.kernel.compiler.trace import trace_network
from dashpot.kernel.eager import simulate_eagerly
from dashpot.kernel.network import compile_network
from dashpot.kernel.targets.llvm.source import print_source
from dashpot.model.element import Element, Parameter, Response
from dashpot.model.network import Branch, Group, NetworkSpec, Value
from dashpot.testing import random_drive

MIXED = """
    {a}: {{element: spring, stiffness: {{deflection: [0, {x}], force: [0, {x}]}}}}
    {b}: {{repeat: 2, element: maxwell, stiffness: {x}, relaxation_time: {x}}}
    {c}: {{element: prandtl, stiffness: {x}, limit: {x}, exponent: 2}}
    {d}: {{element: dahl, stiffness: {x}, limit: {x}, scale: {{deflection: [0, {x}], factor: [1, 2]}}}}
"""
PRINTER = """
import sys
sys.path[:0] = {path!r}
from unit.kernel.test_source import printed
{before}
import hashlib
print(hashlib.sha256(printed("a", "b", "c", "d", 2.0).encode()).hexdigest())
"""


def source(branches: str) -> str:
    return print_source(sort_tiers(trace_network(network(branches))), 2)


def printed(a: str, b: str, c: str, d: str, x: float) -> str:
    return source(MIXED.format(a=a, b=b, c=c, d=d, x=x))


def test_the_same_topology_with_other_numbers_and_names_gives_the_same_text():
    first = printed("a", "b", "c", "d", 2.0)
    assert printed("a", "b", "c", "d", 3.5) == first
    assert printed("rubber", "z", "path", "aa", 7.0) == first
    assert "rubber" not in first


def test_what_was_traced_before_does_not_matter():
    reversed_parts = "it = printed('d', 'c', 'b', 'a', 1.0)"
    digests = {
        subprocess.run(
            [sys.executable, "-c", PRINTER.format(path=sys.path, before=before)],
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for before in ("", reversed_parts)
    }
    assert len(digests) == 1


def test_another_topology_gives_another_text():
    first = source("it: {element: maxwell, stiffness: 5, relaxation_time: 5}")
    assert source("it: {repeat: 2, element: maxwell, stiffness: 5, relaxation_time: 5}") != first
    assert source("it: {element: damper, damping: 5}") != first


def test_a_text_needs_nothing_but_functions_of_the_c_library():
    declared = re.findall(r"declare double @(\w+)", printed("a", "b", "c", "d", 2.0))
    assert all(hasattr(math, name) for name in declared) and "pow" in declared


class Strange(Element):
    """Every operation that a law may use, with infinite and negative constants and conditions on numbers."""

    word = "strange"
    stiffness = Parameter("N/m", "slope", bounds=(1.0, 1e9))
    shape = Parameter("1", "shape", bounds=(-5.0, 5.0), scale="linear")

    def step(self, x, z, p, dt):
        soft = (p.shape > 1.0) & ~(p.shape >= 3.0) | (p.shape == 0.5)
        moved = (x.new != x.old) | (x.new < -1.0)
        level = np.where(soft, -2.0, np.where(p.shape < -np.inf, np.inf, 0.25))
        waves = (
            np.sin(x.new) + np.cos(x.new) + np.tanh(p.shape * x.new) + np.expm1(-np.abs(x.new)) + np.log1p(x.new**2.0)
        )
        powers = np.abs(x.new) ** p.shape + np.sqrt(np.abs(x.new)) + np.sign(x.new) + np.minimum(p.shape, x.new)
        chosen = np.where(soft & moved, waves, powers) * np.where(np.logical_or(soft, moved), 1.0, -3.0)
        return Response(p.stiffness * (chosen + level * np.maximum(np.minimum(x.new, np.inf), -np.inf)))


def test_every_operation_of_a_law_is_written():
    values = {"stiffness": Value(3.0, "N/m"), "shape": Value(2.0, "1")}
    spec = NetworkSpec("n", Group("", "parallel", (Branch("it", Strange, values, {}),)))
    found = compile_network(spec)
    drive = random_drive(np.random.default_rng(seed_of("test_source")), "multisine", 1.0, 0.01, 200)
    lanes = np.array([[3.0, shape] for shape in (-1.5, 0.5, 0.7, 1.0, 2.0, 3.0, 4.0)])
    expected = simulate_eagerly(spec, drive, lanes)
    sound = np.isfinite(expected)
    force = found.simulate(found.prepare(drive), lanes)
    assert np.allclose(force[sound], expected[sound], rtol=1e-12, atol=1e-12)
    assert np.array_equal(np.isfinite(force), sound)

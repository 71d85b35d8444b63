"""Cutting a pass into stages: everything is computed once, in time, and nothing is overwritten too early."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.expr.node import symbol, walk
from dashpot.kernel.eager import simulate_eagerly
from dashpot.kernel.ir.stages import LONG, cut_stages
from dashpot.kernel.network import compile_network
from dashpot.model.element import Element, Parameter, Response, State
from dashpot.model.network import Branch, Group, NetworkSpec, Value
from dashpot.testing import random_drive

X, P = symbol("x"), symbol("p")


def cut(*roots):
    return cut_stages([node for node in walk(roots) if node.arguments])


def test_without_long_functions_there_is_one_stage():
    (stage,) = cut(X * P + 1.0)
    assert [node.operation for node in stage.nodes] == ["multiply", "add"]
    assert not stage.calls


def test_a_long_function_stands_between_its_argument_and_its_use():
    root = 2.0 * np.exp(X * P) + X
    first, second = cut(root)
    assert [node.operation for node in first.nodes] == ["multiply"]
    assert [node.operation for node in first.calls] == ["exp"]
    assert [node.operation for node in second.nodes] == ["multiply", "add"]


def test_long_functions_that_do_not_need_each_other_are_called_together():
    first, _ = cut(np.exp(X) + np.log(P) + np.exp(X * P))
    assert sorted(call.operation for call in first.calls) == ["exp", "exp", "log"]


def test_long_functions_inside_each_other_follow_each_other():
    stages = cut(np.exp(np.log(X) * P))
    assert [[node.operation for node in stage.calls] for stage in stages] == [["log"], ["exp"], []]


def test_what_is_not_needed_early_stands_beside_the_last_long_function():
    late = X * 3.0
    first, second = cut(np.exp(np.exp(P * X)) + late)[:2]
    assert late not in {*first.nodes, *first.beside, *second.nodes} and late in set(second.beside)


def random_roots(rng):
    nodes = [X, P, symbol("q")]
    for _ in range(40):
        a, b = (nodes[k] for k in rng.integers(0, len(nodes), 2))
        kind = rng.integers(0, 5)
        nodes.append((a + b, a * b, np.exp(a), np.log(np.abs(b)), a - 0.5)[kind])
    return nodes[-5:]


def test_every_node_is_computed_once_and_after_its_arguments():
    seed = seed_of("test_stages")
    print(f"seed {seed}")
    rng = np.random.default_rng(seed)
    for _ in range(50):
        roots = random_roots(rng)
        wanted = [node for node in walk(roots) if node.arguments]
        done = set()
        for stage in cut_stages(wanted):
            for node in (*stage.nodes, *stage.calls, *stage.beside):
                assert node.serial not in done
                assert all(a.serial in done or not a.arguments for a in node.arguments)
                done.add(node.serial)
            assert all(node.operation in LONG for node in stage.calls)
            assert not {argument for node in stage.beside for argument in node.arguments} & set(stage.calls)
        assert done == {node.serial for node in wanted}


class Tangled(Element):
    """Memories that need each other's old values, before and after exponentials."""

    word = "tangled"
    size = Parameter("1", "size", bounds=(0.1, 10.0))
    a = State("1", "memory")
    b = State("1", "memory")
    c = State("1", "memory")
    d = State("1", "memory")

    def step(self, x, z, p, dt):
        a = np.exp(-np.abs(z.b)) * p.size
        b = z.a
        c = z.c * 0.5 + x.travel * p.size
        d = np.exp(-np.abs(z.d) - np.abs(c)) + z.c
        return Response(np.exp(-np.abs(d)) * z.c + a + z.b * z.d, a=a, b=b, c=c, d=d)


def test_a_new_state_does_not_hide_the_old_one_before_its_time():
    spec = NetworkSpec("n", Group("", "parallel", (Branch("it", Tangled, {"size": Value(2.0, "1")}, {}),)))
    compiled = compile_network(spec)
    drive = random_drive(np.random.default_rng(seed_of("test_stages2")), "multisine", 1.0, 0.01, 100)
    lanes = np.array([[0.3], [1.0], [4.0]])
    assert compiled.simulate(compiled.prepare(drive), lanes) == pytest.approx(
        simulate_eagerly(spec, drive, lanes), rel=1e-12, abs=1e-12
    )

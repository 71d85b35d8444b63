"""A single lane: several numbers in a vector."""

from __future__ import annotations

import re

import numpy as np
import pytest
from seeds import seed_of
from unit.kernel.networks import compiled

from dashpot.kernel.ir.layout import LANES
from dashpot.kernel.targets.llvm.assembly import NUMBER, Assembly
from dashpot.kernel.targets.llvm.native import load_native
from dashpot.kernel.targets.llvm.packing import packed, unpacked
from dashpot.kernel.targets.llvm.source import ARGUMENTS, print_source
from dashpot.testing import random_drive

ATTRIBUTES = "attributes #0 = { nounwind }\n"


@pytest.mark.parametrize("count", [1, 2, LANES, LANES + 1, 3 * LANES - 1])
def test_what_is_packed_is_unpacked_alike(count):
    a = Assembly()
    bundles = [a.load([a.address("%given", LANES * number)]) for number in range(count)]
    wide = packed(bundles)
    assert len(wide.names) == -(-count // LANES) and wide.type == NUMBER
    for number, bundle in enumerate(unpacked(wide, count)):
        a.store(bundle, [a.address("%out", LANES * number)])
    a.do("ret void")
    drawn = np.random.default_rng(seed_of("test_packing")).standard_normal(count)
    given, out = np.repeat(drawn, LANES), np.zeros(count * LANES)
    load_native(a.function("void @run(ptr %given, ptr %out)") + ATTRIBUTES, 2)(given, out)
    assert np.array_equal(out, given)


@pytest.mark.parametrize("count", [1, 3, LANES + 1])
def test_a_lane_alone_gives_the_bits_that_it_gives_among_others(count):
    network = compiled(f"""
        filler: {{repeat: {count}, element: prandtl, stiffness: 9 N/mm, limit: 20 N}}
        slider: {{repeat: {count}, element: dahl, stiffness: 60 N/mm, limit: 15 N}}
        rubber: {{element: maxwell, stiffness: 8 N/mm, relaxation_time: 30 ms}}
    """)
    rng = np.random.default_rng(seed_of("test_packing2"))
    run = network.prepare(random_drive(rng, "multisine", 1e-3, 5e-3, 400))
    values = network.start * np.exp(rng.uniform(-1.0, 1.0, (2 * LANES + 1, network.start.size)))
    together, few = network.simulate(run, values), network.simulate(run, values[:3])
    for lane, force in zip(values, together, strict=True):
        assert np.array_equal(network.simulate(run, lane), force)
    assert np.array_equal(few, together[:3])


def test_a_lane_alone_takes_one_exponential_for_all_branches():
    program = compiled("slider: {repeat: 5, element: dahl, stiffness: 60 N/mm, limit: 15 N}").program
    alone, few = (len(re.findall(r"shl", print_source(program, 1, alone))) for alone in (True, False))
    assert few == 5 * alone > 0
    assert load_native(print_source(program, 1, True), len(ARGUMENTS))

"""Functions of four arguments in a vector, against scipy and the library of mathematics."""

from __future__ import annotations

import numpy as np
import pytest
from numba import njit
from scipy.special import wrightomega

from dashpot.kernel.targets.numba import packed

PACKS = (packed.packed_0, packed.packed_1, packed.packed_2, packed.packed_3, packed.packed_4)
CLOSE = 1e-14


@pytest.mark.parametrize("omegas", range(5))
def test_each_place_has_its_function(omegas):
    pack = PACKS[omegas]
    compiled = njit(lambda a, b, c, d: pack(a, b, c, d))
    rng = np.random.default_rng(omegas)
    for x in np.vstack([rng.uniform(-690.0, 24.0, (300, 4)), rng.uniform(-3.0, 3.0, (300, 4)), np.zeros((1, 4))]):
        expected = [wrightomega(each) if k < omegas else np.exp(each) for k, each in enumerate(x)]
        assert compiled(*x) == pytest.approx(expected, rel=CLOSE, abs=0.0)
        assert pack(*x) == pytest.approx(expected, rel=CLOSE, abs=0.0)


def test_one_that_is_not_a_number_does_not_touch_the_others():
    pack = packed.packed_3
    found = njit(lambda a, b, c, d: pack(a, b, c, d))(np.nan, 1.0, -1e300, np.nan)
    assert np.isnan(found[0]) and np.isnan(found[3])
    assert found[1] == pytest.approx(1.0, rel=CLOSE) and 0.0 <= found[2] < 1e-300


def test_a_pack_beyond_what_it_takes_goes_one_by_one():
    import dashpot as dp

    mount = dp.declare("""
        format: dashpot-network/1
        name: mount
        branches:
          a: {element: prandtl, stiffness: 400 N/mm, limit: 50 N, sharpness: 30}
          b: {element: prandtl, stiffness: 200 N/mm, limit: 90 N, sharpness: 60}
    """)
    solver = mount.jit()
    x = np.concatenate([np.linspace(0.0, 5e-3, 200), np.linspace(5e-3, -5e-3, 400)])
    force = np.empty(x.size)
    solver.simulate(x, np.gradient(x, 1e-3), 1e-3, solver.parameters, force)
    # each slides at its limit in the end
    assert force[199] == pytest.approx(140.0, rel=1e-6) and force[-1] == pytest.approx(-140.0, rel=1e-6)

"""Functions of four arguments in a vector, against scipy and the library of mathematics."""

from __future__ import annotations

import numpy as np
import pytest
from numba import njit
from scipy.special import wrightomega

from dashpot.kernel.targets.numba import packed
from dashpot.kernel.targets.numba.module import load_module

CLOSE = 1e-14
MODULE = """\
from __future__ import annotations

from dashpot.kernel.targets.numba.native import native
from dashpot.kernel.targets.numba.packed import packed_0, packed_1, packed_2, packed_3, packed_4


@native
def along(x: array, out: array, count: count) -> nothing:
    for k in range(0, count):
        a, b, c, d = packed_{omegas}(x[4 * k], x[4 * k + 1], x[4 * k + 2], x[4 * k + 3])
        out[4 * k] = a
        out[4 * k + 1] = b
        out[4 * k + 2] = c
        out[4 * k + 3] = d
"""


def along(omegas: int, x: np.ndarray) -> np.ndarray:
    """The answers (n, 4) of a pack for arguments (n, 4)."""
    run, out = load_module(MODULE.format(omegas=omegas)).along, np.empty(x.size)
    njit(lambda x, out, count: run(x, out, count))(x.ravel(), out, len(x))
    return out.reshape(x.shape)


@pytest.mark.parametrize("omegas", range(5))
def test_each_place_has_its_function(omegas):
    rng = np.random.default_rng(omegas)
    x = np.vstack([rng.uniform(-690.0, 24.0, (300, 4)), rng.uniform(-3.0, 3.0, (300, 4)), np.zeros((1, 4))])
    expected = np.hstack([wrightomega(x[:, :omegas]), np.exp(x[:, omegas:])])
    assert along(omegas, x) == pytest.approx(expected, rel=CLOSE, abs=0.0)
    in_python = [packed.Packed(omegas)(*each) for each in x]
    assert np.array(in_python) == pytest.approx(expected, rel=CLOSE, abs=0.0)


def test_one_that_is_not_a_number_does_not_touch_the_others():
    (found,) = along(3, np.array([[np.nan, 1.0, -1e300, np.nan]]))
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

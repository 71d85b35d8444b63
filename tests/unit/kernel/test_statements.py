"""Printed functions as machine code against the same text run by Python."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numba import njit
from numba.core.errors import TypingError

from dashpot.kernel.targets.numba.module import load_module

HEAD = """\
from __future__ import annotations

from math import cos, exp, expm1, fabs, inf, log, log1p, pow, sin, sqrt, tanh

import numpy as np

from dashpot.kernel.targets.numba.native import native
"""
BODY = """
knots = np.array([0.5, 1.5, 4.0])


{native}
def nearest(x: number) -> count:
    k = 0
    for j in range(0, 3):
        if x >= knots[j]:
            k = k + 1
    return k


{native}
def side(x: number) -> number:
    if x > 0.0:
        return 1.0
    if x < 0.0:
        return -1.0
    return x


{native}
def halved(x: number) -> count:
    steps = 0
    while (x > 1.0) & (steps < 60):
        x = x / 2
        steps = steps + 1
    return steps


{native}
def several(x: array, out: array, places: counts, n: count) -> nothing:
    for k in range(0, n):
        a = x[k]
        heavy = (a > 2.0) | (not (a != a))
        out[places[k]] = (exp(-fabs(a)) if a < 1.0 else log(a)) + 0.5 * side(a) + nearest(a) + halved(a)
        if heavy & (k % 2 == 0):
            out[places[k]] = out[places[k]] - sqrt(fabs(a)) * tanh(a) + pow(fabs(a), 1.5) * expm1(-fabs(a))
        else:
            out[places[k]] = out[places[k]] + log1p(fabs(a)) * cos(a) - sin(a) / (1 + k)
        if a > 1e300:
            out[places[k]] = inf
"""


def test_all_statements_do_what_python_does():
    rng = np.random.default_rng(3)
    x = np.concatenate([rng.normal(0.0, 3.0, 200), [0.0, 0.5, 1.5, 1e301, np.nan, 37.0]])
    places = rng.permutation(x.size)
    run = load_module(HEAD + BODY.format(native="@native")).several
    found, expected = np.empty(x.size), np.empty(x.size)
    njit(lambda x, out, places, n: run(x, out, places, n))(x, found, places, x.size)
    plain = {**vars(math), "np": np}
    exec("from __future__ import annotations\n" + BODY.format(native=""), plain)
    plain["several"](x, expected, places, x.size)
    np.testing.assert_allclose(found, expected, rtol=1e-13)


def test_arrays_that_are_not_contiguous_are_refused():
    run = load_module(HEAD + BODY.format(native="@native")).several
    x = np.ones((4, 2))
    with pytest.raises(TypingError, match="expected a contiguous one-dimensional array of float64"):
        njit(lambda x, out, places, n: run(x, out, places, n))(x[:, 0], np.ones(4), np.arange(4), 4)

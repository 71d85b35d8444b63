"""The Wright omega function of the reference against numbers of many digits."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from dashpot.expr.omega import wrightomega

PLACES = np.concatenate([np.linspace(-700.0, -30.0, 40), np.linspace(-42.0, 3.0, 301), np.geomspace(3.0, 1e300, 60)])


def exact(x: float) -> mpmath.mpf:
    with mpmath.workprec(200):
        return mpmath.lambertw(mpmath.exp(x)).real if x < 1000.0 else x - mpmath.log(x - mpmath.log(mpmath.mpf(x)))


@pytest.mark.filterwarnings("error")
def test_it_is_good_to_fourteen_digits():
    away = [abs(float(found / exact(x) - 1.0)) for x, found in zip(PLACES.tolist(), wrightomega(PLACES), strict=True)]
    assert max(away) < 1e-14


@pytest.mark.filterwarnings("error")
def test_at_its_ends():
    assert wrightomega(1.0) == pytest.approx(1.0, rel=1e-15)
    assert np.array_equal(wrightomega(np.array([np.inf, -np.inf, np.nan])), [np.inf, 0.0, np.nan], equal_nan=True)

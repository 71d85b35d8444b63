"""The Wright omega of the reference, held against scipy's, which shares no code with it."""

import numpy as np
import pytest
from scipy.special import wrightomega as scipys

from dashpot.expr.omega import wrightomega


def test_omega_is_good_to_fourteen_digits_everywhere():
    x = np.concatenate([np.linspace(-45.0, 45.0, 20001), np.geomspace(50.0, 1e150, 500), [-700.0, -40.0, -2.0, 1.0]])
    assert wrightomega(x) == pytest.approx(scipys(x), rel=1e-14, abs=0.0)


def test_omega_at_the_ends_and_of_nothing():
    with np.errstate(invalid="ignore"):
        found = wrightomega(np.array([-np.inf, np.inf, np.nan]))
    assert found[0] == 0.0 and found[1] == np.inf and np.isnan(found[2])
    assert wrightomega(1.0) == 1.0 and np.ndim(wrightomega(1.0)) == 0

"""The rule in turn of trapezoidal and backward difference steps: its order, and that it forgets stiff errors."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.kernel.scheme import PAIR, alternate


def march(rate: complex, step: float, pairs: int, start: complex = 1.0) -> complex:
    """x' = rate x by the rule: the new velocity is slope x + now x0 + before x1 + swing v0."""
    rule = alternate(step, pairs)
    x, earlier, v = start, start, rate * start
    for slope, now, before, swing in zip(rule.slope, rule.now, rule.before, rule.swing, strict=True):
        drift = now * x + before * earlier + swing * v
        new = drift / (rate - slope)
        x, earlier, v = new, x, rate * new
    return x


def test_each_rule_is_exact_for_what_it_promises():
    step = 0.125
    rule = alternate(step, 3)
    assert rule.slope.size == PAIR * 3
    # constants do not move, straight lines have their slope; after the first step parabolas are exact as well
    for number, (slope, now, before, swing) in enumerate(
        zip(rule.slope, rule.now, rule.before, rule.swing, strict=True)
    ):
        assert slope + now + before == pytest.approx(0.0, abs=1e-12)
        assert slope * step - before * step + swing == pytest.approx(1.0)
        if number:
            assert slope * step**2 + before * step**2 == pytest.approx(2.0 * step)


@pytest.mark.parametrize("rate", [-3.0, 20j, -2.0 + 15j])
def test_the_order_is_two_and_halving_makes_it_three(rate):
    errors = np.array([march(rate, 1.0 / (PAIR * pairs), pairs) - np.exp(rate) for pairs in (200, 400, 800)])
    order = np.log2(np.abs(errors[:-1] / errors[1:]))
    assert order == pytest.approx([2.0, 2.0], abs=0.1)
    extrapolated = errors[1:] + (errors[1:] - errors[:-1]) / 3.0
    assert np.log2(np.abs(extrapolated[0] / extrapolated[1])) > 2.7


def test_a_stiff_error_is_gone_after_a_few_pairs():
    assert abs(march(-1e9, 1e-3, 4)) < 1e-6


@pytest.mark.parametrize("frequency", [0.1, 1.0, 10.0, 1000.0])
def test_an_oscillation_never_grows(frequency):
    assert abs(march(1j * frequency, 0.1, 500)) <= 1.0 + 1e-12

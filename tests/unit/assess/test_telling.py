"""The next measurement: found where two models come apart, none where they cannot."""

import numpy as np
import pytest

from dashpot.assess.contest import Bench
from dashpot.assess.menu import LONGEST, Sweep, Triangle
from dashpot.assess.noise import flat_noise
from dashpot.assess.telling import ENOUGH, telling_run
from dashpot.contract.registry import load_registry
from dashpot.data.run import Run
from dashpot.fit.scored import score_run
from dashpot.model.reading import parse_network

DASHPOT = """\
format: dashpot-network/1
name: dashpot
branches:
  stiffness: {element: spring, stiffness: {start: 200 N/mm}}
  damping: {element: damper, damping: {start: 300 N*s/m}}
"""
MAXWELL = """\
format: dashpot-network/1
name: maxwell
branches:
  stiffness: {element: spring, stiffness: {start: 200 N/mm}}
  relaxation: {element: maxwell, stiffness: {start: 30 N/mm}, relaxation_time: {start: 10 ms, bounds: [1 ms, 100 ms]}}
"""
TIME = np.arange(2000) * 2e-3
NOISE = 1.0


@pytest.fixture(scope="module")
def bench():
    """One run at 2 Hz of a spring and a Maxwell branch of 30 N/mm and 40 ms with noise, by its complex stiffness."""
    angle = 2.0 * np.pi * 2.0 * TIME
    x = 2e-3 * np.sin(angle)
    lag = 2.0 * np.pi * 2.0 * 40e-3
    complex_stiffness = 3e4 * 1j * lag / (1.0 + 1j * lag)
    force = (
        2e5 * x
        + 2e-3 * np.imag(complex_stiffness * np.exp(1j * angle))
        + NOISE * np.random.default_rng().standard_normal(x.size)
    )
    run = Run("a", "harmonic", TIME, {"displacement": x, "force": force})
    return Bench([score_run(run)], load_registry().elements, {})


def fitted(bench, text):
    declared = parse_network(text, bench.elements)
    return bench.fit(declared, bench.start_from(declared, declared), flat_noise({"a": NOISE}))


def test_a_dashpot_and_a_maxwell_branch_come_apart_at_another_frequency(bench):
    """At 2 Hz alone they fit alike; the run that is proposed is no repetition, and tells them apart."""
    one, other = fitted(bench, DASHPOT), fitted(bench, MAXWELL)
    assert abs(one.chi_square - other.chi_square) < 0.05 * one.chi_square
    found = telling_run(bench, one, other, flat_noise({"a": NOISE}))
    assert found is not None
    assert found.distance >= ENOUGH
    assert "a sweep" in found.words or "a triangle" in found.words


def test_where_no_run_is_long_enough_a_longer_one_is(bench):
    """In noise forty times as loud the squared distance of the same runs is 1600 times as small."""
    one, other = fitted(bench, DASHPOT), fitted(bench, MAXWELL)
    short = telling_run(bench, one, other, flat_noise({"a": NOISE}))
    found = telling_run(bench, one, other, flat_noise({"a": 40.0 * NOISE}))
    assert short is not None
    assert found is not None
    assert found.distance >= ENOUGH
    assert LONGEST > found.proposal.seconds > short.proposal.seconds


def test_what_takes_longer_keeps_to_the_same_path():
    sweep = Sweep(1e-3, 5e-3, 1.0, 10.0, 2.0)
    slow = sweep.longer(3)
    assert slow.displacement.size == pytest.approx(3 * sweep.displacement.size, rel=1e-2)
    assert np.ptp(slow.displacement) == pytest.approx(2e-3, rel=1e-2)
    assert "in 6 s" in slow.words
    triangle = Triangle(2e-3, 6e-3, 1e-3)
    assert triangle.seconds == 8.0
    thrice = triangle.longer(3)
    assert thrice.seconds == 24.0
    assert thrice.words.startswith("3 triangles over 4 mm")
    np.testing.assert_allclose(np.abs(np.diff(thrice.displacement)) / thrice.dt, 1e-3)
    assert thrice.displacement[[0, 1000, 2000, 3000, 6000]] == pytest.approx([2e-3, 6e-3, 2e-3, 6e-3, 2e-3])


def test_no_run_tells_a_model_from_itself(bench):
    one = fitted(bench, DASHPOT)
    assert telling_run(bench, one, fitted(bench, DASHPOT), flat_noise({"a": NOISE})) is None

"""What a fit writes into its file about the motions that it saw."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.fit.bench import KELVIN_VOIGT, kelvin_voigt, network, run, runs

import dashpot as dp
from dashpot.data.excitation import Excitation
from dashpot.fit.seen_range import covered, seen_range
from dashpot.model.identified import Identified, outside


def test_the_range_is_that_of_all_runs():
    found = seen_range(network(KELVIN_VOIGT), runs())
    speed = 2.0 * np.pi * max(2e-3 * 2.0, 1e-3 * 11.0)
    assert found["displacement"] == pytest.approx((-2e-3, 2e-3), rel=1e-9)
    assert found["speed"] == pytest.approx((0.0, speed), rel=1e-9)
    assert found["amplitude"] == pytest.approx((1e-3, 2e-3), rel=2e-3)
    assert found["frequency"] == pytest.approx((2.0, 11.0), rel=0.02)


def test_no_run_that_was_seen_lies_outside_and_others_do():
    spec = network(KELVIN_VOIGT)
    spec = replace(spec, identified=Identified(range=seen_range(spec, runs())))

    def words(one) -> list[str]:
        return [each.split()[0] for each in outside(covered(spec, one.excitation), spec.identified.range)]

    assert [words(one) for one in runs()] == [[], []]
    assert words(run("small", 1e-4, 5.0, kelvin_voigt)) == ["amplitude"]
    assert words(run("fast", 1e-3, 20.0, kelvin_voigt)) == ["speed", "frequency"]
    assert words(run("far", 1e-3, 5.0, kelvin_voigt, middle=5e-3)) == ["displacement", "preload"]


def test_the_nodes_of_an_axle_have_ranges_of_their_own():
    axle = dp.declare("""
        format: dashpot-network/1
        name: beam
        nodes: {left: driven, right: driven}
        branches: {rubber: {element: spring, between: [left, right], stiffness: 220 N/mm}}
    """)
    left, right = (run(name, size, 5.0, kelvin_voigt).drive for name, size in (("left", 1e-3), ("right", 3e-3)))
    whole = Excitation({"left": left, "right": right}, dt=left.dt, samples=left.samples)
    found = covered(axle, whole)
    assert found["amplitude@left"] == pytest.approx((1e-3, 1e-3), rel=2e-3)
    assert found["amplitude@right"] == pytest.approx((3e-3, 3e-3), rel=2e-3)

"""A search does not let the characteristic of a damper fall."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import ready, run

from dashpot.fit.refine import refine

KNOTS = """
    oil:
      element: damper
      damping:
        velocity: [-1 m/s, -0.1 m/s, 0 m/s, 0.05 m/s, 0.1 m/s, 1 m/s]
        force: [{start: -900 N, bounds: [-5 kN, 0 N]}, {start: -90 N, bounds: [-5 kN, 0 N]}, 0 N,
                {start: 50 N, bounds: [0 N, 5 kN]}, {start: 90 N, bounds: [0 N, 5 kN]},
                {start: 500 N, bounds: [0 N, 5 kN]}]
"""


def test_knots_of_a_damper_are_in_order_on_either_side_of_a_fixed_one():
    _, _, coordinates = ready(KNOTS, [run("sine", 2e-3, 8.0, lambda x, v, a: 900.0 * v)])
    assert [tuple(coordinates.paths[knot] for knot in chain) for chain in coordinates.rising] == [
        ("oil.damping[0]", "oil.damping[1]"),
        ("oil.damping[3]", "oil.damping[4]", "oil.damping[5]"),
    ]


def test_the_nearest_allowed_point_is_within_bounds_in_order_and_near():
    _, _, coordinates = ready(KNOTS, [run("sine", 2e-3, 8.0, lambda x, v, a: 900.0 * v)])
    rng = np.random.default_rng(seed_of("test_rising"))
    points = rng.uniform(-7e3, 7e3, (50, 5))
    allowed = coordinates.allowed(points)
    assert (allowed >= coordinates.low).all() and (allowed <= coordinates.high).all()
    assert (np.diff(allowed[:, :2]) >= 0.0).all() and (np.diff(allowed[:, 2:]) >= 0.0).all()
    inside = coordinates.allowed(allowed)
    assert inside == pytest.approx(allowed)
    ordered = np.sort(points[:, 2:], axis=1)
    nearest = np.linalg.norm(allowed[:, 2:] - points[:, 2:], axis=1)
    assert (nearest <= np.linalg.norm(np.clip(ordered, 0.0, 5e3) - points[:, 2:], axis=1) + 1e-9).all()


def test_a_fit_to_a_force_that_falls_ends_at_a_flat_law():
    _, objective, coordinates = ready(KNOTS, [run("sine", 2e-3, 8.0, lambda x, v, a: 60.0 * np.sin(30.0 * v))])
    found = refine(objective, coordinates, coordinates.start)
    law = coordinates.to_values(found.point)[0]
    assert (np.diff(law) >= 0.0).all()


def test_without_one_coordinate_the_others_stay_in_order():
    _, _, coordinates = ready(KNOTS, [run("sine", 2e-3, 8.0, lambda x, v, a: 900.0 * v)])
    held = coordinates.held(3, 90.0)
    assert [tuple(held.paths[knot] for knot in chain) for chain in held.rising] == [
        ("oil.damping[0]", "oil.damping[1]"),
        ("oil.damping[3]", "oil.damping[5]"),
    ]


def test_a_knot_that_does_not_matter_gives_way():
    _, _, coordinates = ready(KNOTS, [run("sine", 2e-3, 8.0, lambda x, v, a: 900.0 * v)])
    point = np.array([-900.0, -90.0, 3000.0, 90.0, 500.0])
    weights = np.array([1.0, 1.0, 0.0, 2.0, 1.0])
    assert coordinates.allowed(point, weights)[0] == pytest.approx([-900.0, -90.0, 90.0, 90.0, 500.0], abs=1e-3)
    assert coordinates.allowed(point)[0, 2:] == pytest.approx(3590.0 / 3.0)

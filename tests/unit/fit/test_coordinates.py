"""Searched numbers as coordinates and back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from unit.fit.bench import network

from dashpot.fit.coordinates import search_coordinates, with_point

SPEC = network("""
    rubber: {element: spring, stiffness: {start: 1e5, bounds: [1e3, 1e7]}}
    oil: {element: damper, damping: 200}
    mass: {element: inerter, inertance: {start: 3, bounds: [-10, 20]}}
    bent: {element: spring, stiffness: {deflection: [0, 1, 2], force: [0, {start: 40, bounds: [0, 9000]}, 500]}}
""")
COORDINATES = search_coordinates(SPEC)


def test_only_searched_numbers_are_coordinates():
    assert COORDINATES.paths == ("rubber.stiffness", "mass.inertance", "bent.stiffness[1]")
    assert COORDINATES.which.tolist() == [0, 2, 4]
    assert COORDINATES.log.tolist() == [True, False, False]


def test_the_start_is_the_point_of_the_file():
    assert COORDINATES.start == pytest.approx([np.log(1e5), 3.0, 40.0])
    assert COORDINATES.to_values(COORDINATES.start)[0] == pytest.approx([1e5, 200.0, 3.0, 0.0, 40.0, 500.0])


def test_a_start_outside_its_bounds_is_moved_to_them():
    moved = search_coordinates(with_point(SPEC, COORDINATES, np.array([np.log(1e9), 50.0, 40.0])))
    assert moved.start == pytest.approx([np.log(1e7), 20.0, 40.0])


@given(st.lists(st.floats(0.0, 1.0), min_size=3, max_size=3))
def test_cube_coordinates_and_values_go_forth_and_back(cube):
    points = COORDINATES.from_cube(np.array([cube]))
    assert COORDINATES.to_cube(points)[0] == pytest.approx(cube, abs=1e-12)
    values = COORDINATES.to_values(points)
    assert COORDINATES.of_values(values[0]) == pytest.approx(points[0], abs=1e-9)
    found = with_point(SPEC, COORDINATES, points[0])
    assert [slot.value.number for slot in found.slots()] == pytest.approx(values[0].tolist())


def test_a_block_of_points_gives_a_block_of_lanes():
    values = COORDINATES.to_values(np.tile(COORDINATES.start, (5, 1)) + np.arange(5.0)[:, None])
    assert values.shape == (5, 6)
    assert values[:, 1].tolist() == [200.0] * 5
    assert values[:, 0] == pytest.approx(1e5 * np.exp(np.arange(5.0)))


def test_a_natural_step_is_a_factor_or_the_size_of_the_number_or_of_its_table():
    assert COORDINATES.unit == pytest.approx([1.0, 3.0, 500.0])
    (zero,) = search_coordinates(network("m: {element: inerter, inertance: {start: 0, bounds: [-1, 3]}}")).unit
    assert zero == 4.0


def test_a_choice_of_slots():
    chosen = search_coordinates(SPEC, lambda slot: slot.path.startswith("mass"))
    assert chosen.paths == ("mass.inertance",)
    assert chosen.to_values(np.array([7.0]))[0] == pytest.approx([1e5, 200.0, 7.0, 0.0, 40.0, 500.0])
    assert search_coordinates(SPEC, lambda slot: False).start.shape == (0,)


def test_a_number_without_bounds_is_refused():
    with pytest.raises(ValueError, match="expected bounds for every searched parameter, got none for it.damping"):
        search_coordinates(network("it: {element: damper, damping: {start: 5}}"))


@given(st.lists(st.floats(-3.0, 3.0), min_size=3, max_size=3))
def test_a_step_upwards_moves_every_number_in_proportion(steps):
    start = COORDINATES.start
    before, after = (COORDINATES.numbers(point) for point in (start, COORDINATES.moved(start, np.array(steps))))
    stiffness, mass, force = (b - a for a, b in zip(before, after, strict=True))
    assert (mass, force) == pytest.approx((3.0 * steps[1], 500.0 * steps[2]))
    if steps[0] > 0.0:
        assert stiffness == pytest.approx(1e5 * steps[0], abs=1e-9)
    else:
        assert after[0] == pytest.approx(1e5 * np.exp(steps[0]))

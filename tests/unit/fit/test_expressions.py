"""Fits of networks in which numbers follow from others, against regression by hand."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import STIFFNESS, network, ready, runs

from dashpot.fit.coordinates import search_coordinates, with_point
from dashpot.fit.derived_intervals import derived_intervals
from dashpot.fit.known import known_numbers
from dashpot.fit.linear import linearise
from dashpot.fit.order import interchangeable
from dashpot.fit.refine import refine
from dashpot.fit.uncertainty import assess_uncertainty

TIED = """
    rubber: {element: spring, stiffness: {start: 1e5}}
    oil: {element: damper, damping: {expression: 1.5 ms * rubber.stiffness}}
"""
TIME = 1.5e-3


@pytest.fixture(scope="module")
def noisy():
    rng = np.random.default_rng(seed_of("test_expressions"))
    scored = runs(lambda x, v, a: STIFFNESS * x + 250.0 * v)
    for each in scored:
        each.force[:] += 5.0 * rng.standard_normal(each.force.size)
    return scored


def test_a_fit_is_the_regression_on_the_sum_of_both(noisy):
    _, objective, coordinates = ready(TIED, noisy)
    assert coordinates.paths == ("rubber.stiffness",)
    found = refine(objective, coordinates, coordinates.start)
    weights = [1.0 / each.samples for each in noisy]  # runs count alike, whatever their length
    motion = [(each.drive.displacement + TIME * each.drive.velocity)[each.first :] for each in noisy]
    force = [each.force[each.first :] for each in noisy]
    expected = sum(w * z @ f for w, z, f in zip(weights, motion, force, strict=True)) / sum(
        w * z @ z for w, z in zip(weights, motion, strict=True)
    )
    assert coordinates.numbers(found.point)[0] == pytest.approx(expected, rel=1e-6)
    fitted = with_point(objective.network.spec, coordinates, found.point)
    assert fitted.slots()[1].value.number == pytest.approx(TIME * expected, rel=1e-6)


def test_the_interval_of_what_follows_is_that_of_its_origin_times_the_slope(noisy):
    spec, objective, coordinates = ready(TIED, noisy)
    found = refine(objective, coordinates, coordinates.start)
    fitted = with_point(spec, coordinates, found.point)
    coordinates = search_coordinates(fitted)
    known = assess_uncertainty(objective, coordinates, coordinates.start)
    [(path, pair)] = derived_intervals(fitted.slots(), coordinates, known).items()
    assert path == "oil.damping"
    # the interval of the stiffness is symmetric in the logarithm, that of the damping to first order
    assert pair == pytest.approx([TIME * side for side in known.intervals[0]], rel=1e-4)


def test_the_gradient_counts_both_numbers(noisy):
    _, objective, coordinates = ready(TIED, noisy)
    point = coordinates.start
    linear = linearise(objective, coordinates, point)
    step = 1e-4
    losses = objective.losses(coordinates.to_values(np.array([point + step, point - step])))
    slope = objective.total * (losses[0] ** 2 - losses[1] ** 2) / (2.0 * step)
    assert 2.0 * linear.gradient[0] == pytest.approx(slope, rel=1e-4)


def test_a_search_never_enters_where_what_follows_makes_no_sense(noisy):
    spec, objective, coordinates = ready(
        """
        rubber: {element: spring, stiffness: {start: 3e5, bounds: [1e4, 1e6]}}
        oil: {element: damper, damping: {expression: 1 ms * rubber.stiffness - 150 N*s/m}}
        """,
        noisy,
    )
    low, high = np.log([1e4, 2e5])
    assert objective.losses(coordinates.to_values(np.array([[low], [high]])))[0] == np.inf
    found = refine(objective, coordinates, coordinates.start)
    fitted = with_point(spec, coordinates, found.point)
    stiffness, damping = (slot.value.number for slot in fitted.slots())
    assert damping == pytest.approx(1e-3 * stiffness - 150.0)


def test_what_follows_from_a_known_number_moves_with_it():
    spec = network("""
        part: {element: spring, stiffness: {known: 80e3, interval: [70e3, 90e3]}}
        oil: {element: damper, damping: {expression: 2 ms * part.stiffness}}
    """)
    [known] = known_numbers(spec)
    assert known.step[1] == pytest.approx(2e-3 * known.step[0])


def test_branches_that_an_expression_tells_apart_do_not_exchange_their_numbers():
    pair = """
        first: {element: maxwell, stiffness: {start: 2e4}, relaxation_time: {start: 0.01}}
        second: {element: maxwell, stiffness: {start: 3e4}, relaxation_time: {start: 0.1}}
    """
    plain, tied = (
        network(pair),
        network(pair + "    third: {element: damper, damping: {expression: 1 ms * first.stiffness}}\n"),
    )
    assert [family.names for family in interchangeable(plain, plain)] == [("first", "second")]
    assert interchangeable(tied, tied) == ()

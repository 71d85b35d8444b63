"""The backbone of a slow loop; truth: Dahl friction and the spring in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.backbone import (
    backbone_force,
    correct_backbone,
    extract_backbone,
    friction_start,
    touch_point,
)
from dashpot.data.loop import mean_loop, middle_of_loop

MILLIMETRE = 1e-3
# Two sliders that together are 123 N wide in the middle of 30 mm.
SLIDERS = ((61.454, 7.807e-3), (79.164, 0.551e-3))


@pytest.fixture
def random() -> np.random.Generator:
    seed = seed_of("test_backbone")
    return np.random.default_rng(seed)


def dahl(displacement: np.ndarray, limit: float, travel: float) -> np.ndarray:
    """Exact over every monotone step: force tends to the limit of its direction with exp(-way / travel)."""
    force = [0.0]
    for way in np.diff(displacement).tolist():
        side = np.copysign(limit, way)
        force.append(side + (force[-1] - side) * np.exp(-abs(way) / travel))
    return np.array(force)


def jenkin(displacement: np.ndarray, limit: float, travel: float) -> np.ndarray:
    force = [0.0]
    for way in np.diff(displacement).tolist():
        force.append(min(max(force[-1] + limit / travel * way, -limit), limit))
    return np.array(force)


def sliders(displacement: np.ndarray, each=SLIDERS) -> np.ndarray:
    return sum(dahl(displacement, limit, travel) for limit, travel in each)


def spring(displacement: np.ndarray) -> np.ndarray:
    return 180e3 * displacement + 1e6 * displacement**2


def path(*stations: float, samples: int = 2000) -> np.ndarray:
    """Straight ways between the stations, so many samples for the longest one."""
    longest = max(abs(b - a) for a, b in zip(stations, stations[1:], strict=False))
    ways = [
        np.linspace(a, b, max(2, int(samples * abs(b - a) / longest)))[1:]
        for a, b in zip(stations, stations[1:], strict=False)
    ]
    return np.concatenate([[stations[0]], *ways])


def sine(low: float, high: float, loops: int) -> np.ndarray:
    turn = np.linspace(0.0, 2.0 * np.pi * loops, 4000 * loops)
    return 0.5 * (low + high) - 0.5 * (high - low) * np.cos(turn)


def white(signal: np.ndarray, deviation: float, random: np.random.Generator) -> np.ndarray:
    return signal + random.normal(0.0, deviation, len(signal))


DRIVES = {
    "three triangles": path(0.0, 0.03, 0.0, 0.03, 0.0, 0.03, 0.0),
    "sines": sine(0.0, 0.03, 3),
    "one loop": path(0.0, 0.03, 0.0),
    "loading only": path(0.0, 0.03),
    "unloading only": path(0.03, 0.0),
    "from the middle": path(0.01, 0.03, 0.0, 0.01),
    "both sides": path(0.0, 0.015, -0.015, 0.015, -0.015, 0.0),
    "with holds": np.concatenate([np.zeros(400), path(0.0, 0.03), np.full(400, 0.03), path(0.03, 0.0, 0.03, 0.0)]),
    "sparse": path(0.0, 0.03, 0.0, 0.03, 0.0, samples=150),
}


def test_friction_bends_the_mid_line_at_its_ends():
    displacement = path(0.0, *(0.03, 0.0) * 4)
    loop = mean_loop(displacement, spring(displacement) + sliders(displacement))
    bias = np.interp(np.array([0.5, 2, 8, 15, 22, 28, 29.5]) * MILLIMETRE, loop.deflection, loop.middle)
    bias -= spring(np.array([0.5, 2, 8, 15, 22, 28, 29.5]) * MILLIMETRE)
    np.testing.assert_allclose(bias, [-86, -47, -18, 0, 18, 47, 88], atol=1.5)
    assert np.interp(0.015, loop.deflection, loop.half_width) == pytest.approx(123.0, abs=0.5)


@pytest.mark.parametrize("drive", DRIVES)
def test_one_correction_with_the_right_friction_leaves_the_spring(drive, random):
    displacement = DRIVES[drive]
    each = [(random.uniform(20, 80), np.exp(random.uniform(np.log(0.3), np.log(8.0))) * MILLIMETRE) for _ in range(3)]
    friction = sliders(displacement, each)
    measured = spring(displacement) + friction
    first = extract_backbone(displacement, measured)
    second = correct_backbone(first, displacement, measured, backbone_force(first, displacement) + friction)
    before = np.abs(first.force - spring(first.deflection)).max()
    after = np.abs(second.force - spring(second.deflection)).max()
    assert before > 0.3 * sum(limit for limit, _ in each)
    assert after < 0.01 * before


def test_noise_on_force_and_displacement_is_averaged(random):
    displacement = path(0.0, *(0.03, 0.0) * 3)
    friction = sliders(displacement)
    colour = random.uniform(0.0, 0.9)
    noise = autoregressive(len(displacement), colour, 10.0, random)
    measured, seen = spring(displacement) + friction + noise, white(displacement, 5e-6, random)
    first = extract_backbone(seen, measured)
    second = correct_backbone(first, seen, measured, backbone_force(first, seen) + friction)
    error = second.force - spring(second.deflection)
    # A knot averages over 4 branches of 2000 / 24 samples, of which (1 - colour) / (1 + colour) are independent.
    expected = 10.0 / np.sqrt(4 * 2000 / 24 * (1.0 - colour) / (1.0 + colour))
    assert np.sqrt(np.mean(error**2)) < 3.0 * expected + 0.5


def autoregressive(samples: int, memory: float, deviation: float, random: np.random.Generator) -> np.ndarray:
    from scipy.signal import lfilter

    gain = np.sqrt(1.0 - memory**2) * deviation
    return lfilter([gain], [1.0, -memory], random.normal(size=samples + 2000))[2000:]


def test_the_first_of_several_loops_is_left_out():
    displacement = path(0.0, *(0.03, 0.0) * 3)
    bedding_in = np.where(np.arange(len(displacement)) < len(displacement) // 3 - 5, 300.0, 0.0)
    table = extract_backbone(displacement, spring(displacement) + bedding_in)
    np.testing.assert_allclose(table.force, spring(table.deflection), atol=2.0)
    assert table.loops == 3


@pytest.mark.parametrize(("stroke", "knots"), [(0.002, 16), (0.02, 21), (0.2, 24)])
def test_knots_stand_a_millimetre_apart_within_limits(stroke, knots):
    displacement = path(0.0, stroke, 0.0)
    table = extract_backbone(displacement, 1e5 * displacement)
    assert len(table.deflection) == knots
    assert table.deflection[[0, -1]] == pytest.approx([0.0, stroke], abs=1e-12)
    assert len(extract_backbone(displacement, 1e5 * displacement, knots=10).force) == 10


def test_the_table_never_falls(random):
    displacement = path(-0.01, *(0.01, -0.01) * 2)
    table = extract_backbone(displacement, white(2e3 * displacement, 30.0, random))
    assert np.all(np.diff(table.force) >= 0.0)


def test_one_direction_alone_is_flagged():
    displacement = path(0.0, 0.03)
    table = extract_backbone(displacement, spring(displacement) + sliders(displacement))
    assert not table.complete
    assert np.isnan(table.friction) and np.all(np.isnan(table.half_width))
    with pytest.raises(ValueError, match="expected a loop with loading and unloading.*run that turns round"):
        friction_start(displacement, spring(displacement))


def test_a_loop_that_gives_energy_has_no_friction_to_start_from():
    displacement = path(0.0, 0.03, 0.0)
    with pytest.raises(ValueError, match="expected a loop that dissipates, got a friction force of -.* wrong sign"):
        friction_start(displacement, spring(displacement) - sliders(displacement))


def test_friction_starts_at_the_limit_and_travel_of_a_dahl_slider(random):
    limit, travel = random.uniform(10, 200), random.uniform(0.3, 1.0) * MILLIMETRE
    displacement = path(0.0, *(0.03, 0.0) * 3)
    start = friction_start(displacement, spring(displacement) + dahl(displacement, limit, travel))
    assert start.limit == pytest.approx(limit, rel=1e-3)
    assert start.travel == pytest.approx(travel, rel=0.02)
    assert start.stiffness == pytest.approx(limit / travel, rel=0.02)


def test_a_jenkin_slider_has_done_63_percent_of_its_jump_after_126_percent_of_its_travel():
    displacement = path(0.0, *(0.03, 0.0) * 3, samples=4000)
    start = friction_start(displacement, spring(displacement) + jenkin(displacement, 80.0, 1e-3))
    assert start.limit == pytest.approx(80.0, rel=1e-3)
    assert start.travel == pytest.approx(2e-3 * (1.0 - np.exp(-1.0)), rel=0.02)


def test_contact_begins_where_the_line_through_the_loaded_part_meets_zero():
    displacement = path(-0.005, *(0.02, -0.005) * 2)
    contact = 1.3 * MILLIMETRE
    table = extract_backbone(displacement, 2e5 * np.maximum(displacement - contact, 0.0))
    assert touch_point(table) == pytest.approx(contact, abs=0.02 * MILLIMETRE)


def test_no_touch_point_without_load():
    table = extract_backbone(path(0.0, 0.02, 0.0), 1e3 * path(0.0, 0.02, 0.0))
    with pytest.raises(ValueError, match="expected a backbone through 200 to 1000 N, got .* to 20 N"):
        touch_point(table)


@pytest.mark.parametrize("displacement", [np.zeros(500), np.linspace(0.0, 1.0, 10)])
def test_a_test_that_does_not_move_or_is_too_short_is_refused(displacement):
    with pytest.raises(ValueError, match="expected a slow test of 20 samples or more.*give a quasi-static run"):
        extract_backbone(displacement, displacement)


def test_noise_at_rest_is_not_a_slow_test(random):
    with pytest.raises(ValueError, match="moves further than its noise"):
        extract_backbone(random.normal(0.0, 1e-6, 3000), np.zeros(3000))


def test_the_matrix_of_the_mid_line_keeps_what_both_directions_share_and_drops_what_they_differ_by():
    way = np.linspace(0.0, 30.0 * MILLIMETRE, 500)
    path = np.concatenate([way, way[-2::-1], way[1:], way[-2::-1]])
    middle, side = middle_of_loop(path), np.sign(np.gradient(path))
    inner = slice(2, -2)  # a bin at an end holds the sample at which the motion turns
    assert middle.sum(axis=1) == pytest.approx(1.0)
    assert (middle @ (100.0 * side))[inner] == pytest.approx(0.0, abs=1e-9)
    shared = middle @ (2e5 * path)
    assert shared[inner] == pytest.approx(mean_loop(path, 2e5 * path + 100.0 * side).middle[inner], abs=10.0)
    assert np.all(np.diff(shared) > 0.0)


def test_the_errors_of_the_knots_are_those_of_many_measurements():
    rng, x, draws = np.random.default_rng(seed_of("errors of knots")), path(0.0, 0.02, 0.0, 0.02, 0.0), 400
    tables = [extract_backbone(x, 2e5 * x + rng.standard_normal(x.size)) for _ in range(draws)]
    scatter = np.std([table.force for table in tables], axis=0)
    told = np.sqrt(np.mean([table.error**2 for table in tables], axis=0))
    # a standard deviation of 400 draws is known to 3.5 %
    assert told == pytest.approx(scatter, rel=0.15)

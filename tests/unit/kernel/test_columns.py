"""What the kernel sees of a drive: at samples, and at turning points between them."""

from __future__ import annotations

import numpy as np
import pytest
from unit.kernel.networks import compiled

from dashpot.data.drive import Drive, drive_from_path
from dashpot.kernel.columns import see_samples, see_turns

# the path turns at 4 between samples 1 and 2, and twice between samples 3 and 4
DRIVE = Drive(
    0.1,
    np.array([1.0, 3.0, 3.5, 2.0, 2.1]),
    np.array([9.0, 5.0, -3.0, 4.0, 1.0]),
    np.array([1.0, 2.0, 3.0, 4.0, 5.0]),
    np.array([2, 4, 4]),
    np.array([4.0, 2.4, 1.9]),
)


def test_a_branch_without_memory_sees_every_sample_as_it_is():
    seen = see_samples(DRIVE)
    assert seen["still.new"] is DRIVE.displacement
    assert seen["still.velocity_new"] is DRIVE.velocity
    assert seen["still.acceleration"] is DRIVE.acceleration
    assert seen["still.old"].tolist() == [1.0, 1.0, 3.0, 3.5, 2.0]
    assert seen["dt"] == 0.1


def test_a_branch_with_memory_has_not_moved_when_the_record_begins():
    seen = see_samples(DRIVE)
    for key in ("velocity_old", "velocity_new", "acceleration"):
        assert seen[f"path.{key}"][0] == 0.0
    assert seen["path.old"][0] == seen["path.new"][0] == 1.0
    assert seen["path.velocity_old"].tolist() == [0.0, 9.0, 5.0, -3.0, 4.0]
    assert seen["path.velocity_new"].tolist() == [0.0, 5.0, -3.0, 4.0, 1.0]


def test_a_monotone_branch_starts_a_step_from_the_last_turning_point():
    seen = see_samples(DRIVE)
    assert seen["monotone.old"].tolist() == [1.0, 1.0, 4.0, 3.5, 1.9]
    assert seen["monotone.new"].tolist() == [1.0, 3.0, 3.5, 2.0, 2.1]
    assert "monotone.velocity_new" not in seen


def test_turning_points_follow_each_other():
    turns = see_turns(DRIVE)
    assert turns["monotone.old"].tolist() == [3.0, 2.0, 2.4]
    assert turns["monotone.new"].tolist() == [4.0, 2.4, 1.9]


def test_a_drive_without_turning_points():
    drive = drive_from_path(0.1, np.arange(4.0), np.full(4, 10.0), np.zeros(4))
    assert drive.turn_step.size == 0
    assert see_turns(drive)["monotone.new"].size == 0
    assert see_samples(drive)["monotone.old"].tolist() == [0.0, 0.0, 1.0, 2.0]


def slider(force, travel, stiffness=10.0, limit=12.0):
    side = np.sign(travel)
    return side * limit + (force - side * limit) * np.exp(-stiffness / limit * abs(travel))


def test_friction_goes_through_every_turning_point_in_its_order():
    network = compiled("it: {element: dahl, stiffness: 10, limit: 12}")
    force, expected = 0.0, [0.0]
    for places in ([1.0, 3.0], [3.0, 4.0, 3.5], [3.5, 2.0], [2.0, 2.4, 1.9, 2.1]):
        for old, new in zip(places, places[1:], strict=False):
            force = slider(force, new - old)
        expected.append(force)
    assert network.simulate(network.prepare(DRIVE)) == pytest.approx(expected, rel=1e-13)


def test_a_turning_point_between_samples_is_not_lost():
    # samples at the same height to the left and to the right of a crest
    t = 0.1 * np.arange(-5, 6) + 0.05
    drive = drive_from_path(0.1, 5.0 - t**2, -2.0 * t, np.full(t.size, -2.0))
    assert drive.turn_displacement == pytest.approx([5.0])
    network = compiled("it: {element: dahl, stiffness: 10, limit: 12}")
    force = network.simulate(network.prepare(drive))
    crest = slider(0.0, 5.0 - drive.displacement[0])
    assert force[-1] == pytest.approx(slider(crest, drive.displacement[-1] - 5.0), rel=1e-13)


def test_tables_are_looked_up_along_the_drive():
    network = compiled("""
        a: {element: spring, stiffness: {deflection: [1, 2, 3], force: [10, 30, 40]}}
        b: {element: spring, stiffness: {deflection: [0, 4], force: [0, 8]}}
    """)
    rows = network.prepare(DRIVE)
    assert rows.index.shape == rows.local.shape == (5, 2)
    assert rows.local[:, 0] == pytest.approx([0.0, 0.0, 0.5, 0.0, 0.1])
    assert rows.local[:, 1] == pytest.approx([1.0, 3.0, 3.5, 2.0, 2.1])
    assert network.simulate(rows)[0] == pytest.approx(10.0 + 2.0)

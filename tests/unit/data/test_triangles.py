"""Triangles are told from sines, sharp or round at the turns."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.data.triangles import is_triangle
from dashpot_rigs.triangle_path import triangle_path

TIME = np.arange(4000) * 1e-3
SINE = np.sin(2.0 * np.pi * 2.0 * TIME)


def limited(motion, step):
    """What an actuator follows that goes no farther than ``step`` from sample to sample."""
    place, path = 0.0, np.zeros(motion.size)
    for number, wanted in enumerate(motion):
        place += float(np.clip(wanted - place, -step, step))
        path[number] = place
    return path


@pytest.mark.parametrize("corner", [0.0, 0.1, 0.2])
def test_triangles_of_a_rig(corner):
    """The speed fades within a share of a stroke before and after each turn."""
    path = triangle_path(8e-3, 3e-3, 3, corner * 8.0 / 3.0, 5e-3).displacement
    assert is_triangle(path + 1e-5 * np.random.default_rng(1).standard_normal(path.size))


@pytest.mark.parametrize(
    "motion",
    [
        SINE,
        SINE + 0.05 * np.sin(6.0 * np.pi * 2.0 * TIME),
        np.clip(2.0 * SINE, -1.0, 1.0),
        np.sin(2.0 * np.pi * (TIME + 2.0 * TIME**2)),
        np.sin(2.0 * np.pi * 0.2 * np.arange(400)),  # five samples a cycle
        limited(np.minimum(1.0, TIME) * SINE, 9e-3),
        TIME,
        0.0 * TIME,
    ],
    ids=["sine", "third harmonic", "trapezium", "sweep", "coarse", "limited", "ramp", "rest"],
)
def test_other_motions(motion):
    assert not is_triangle(motion)

"""The network that the tests of exports write."""

from __future__ import annotations

import numpy as np

import dashpot as dp
from dashpot.data.drive import Drive, drive_from_path

STEP, SAMPLES = 1e-3, 400
MOUNT = """
format: dashpot-network/1
name: mount
branches:
  rubber: {element: spring, stiffness: 220 N/mm}
  friction: {element: dahl, stiffness: 900 N/mm, limit: {value: 60 N, bounds: [10 N, 200 N], interval: [55 N, 66 N]}}
  relaxation: {element: maxwell, stiffness: 150 N/mm, relaxation_time: 20 ms}
"""
LEG = """
format: dashpot-network/1
name: leg
branches:
  rubber: {element: spring, stiffness: 220 N/mm}
  leg:
    series:
      valve: {element: damper, damping: 2 N*s/mm}
      bush: {element: spring, stiffness: 900 N/mm}
"""


def mount() -> dp.Model:
    return dp.declare(MOUNT)


def leg() -> dp.Model:
    return dp.declare(LEG)


def sine(samples: int = SAMPLES) -> Drive:
    """2 mm at 60 rad/s; its acceleration is that of the cubics through places and velocities, which exports use."""
    phase = 60.0 * STEP * np.arange(samples)
    x, v = 2e-3 * np.sin(phase), 0.12 * np.cos(phase)
    bend = np.concatenate([[0.0], (6.0 * (x[:-1] - x[1:]) / STEP + 2.0 * v[:-1] + 4.0 * v[1:]) / STEP])
    return drive_from_path(STEP, x, v, bend)

"""Motions with the accelerations of the cubics through places and velocities, which solvers and exports use."""

from __future__ import annotations

import numpy as np

from dashpot.data.drive import Drive, drive_from_path


def along_cubics(drive: Drive) -> Drive:
    """The drive with these accelerations."""
    x, v, dt = drive.displacement, drive.velocity, drive.dt
    bends = (6.0 * (x[:-1] - x[1:]) / dt + 2.0 * v[:-1] + 4.0 * v[1:]) / dt
    return drive_from_path(dt, x, v, np.concatenate([[0.0], bends]))

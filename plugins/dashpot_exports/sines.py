"""Sines around a preload, with which tables and conversions are made."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive, drive_from_path
from dashpot.model.network import NetworkSpec
from dashpot.model.topology import topology_of
from dashpot.text.problem import InputError, Place

Array = NDArray[np.float64]

PERIODS, SAMPLES = 8, 200  # of a sine, and in one period; the last period counts


def sine(frequency: float, amplitude: float, preload: float) -> Drive:
    """Eight periods from rest at the preload."""
    phase = 2.0 * np.pi * np.arange(PERIODS * SAMPLES + 1) / SAMPLES
    rate = 2.0 * np.pi * frequency
    x = preload + amplitude * np.sin(phase)
    return drive_from_path(1.0 / (frequency * SAMPLES), x, amplitude * rate * np.cos(phase),
                           -amplitude * rate**2 * np.sin(phase))  # fmt: skip


def require_one_end(network: NetworkSpec, what: str) -> None:
    """InputError for a network that is not driven at one end alone."""
    topology = topology_of(network)
    if len(topology.held("driven")) != 1 or topology.held("loaded"):
        raise InputError.at(Place(network.file), f"{what} needs a network with one driven end, got "
                            f"{len(topology.held('driven'))}", "export it with --to fmu")  # fmt: skip

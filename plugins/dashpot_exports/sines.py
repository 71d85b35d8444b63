"""Sines around a preload, with which tables and conversions are made."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dashpot.data.drive import Drive, drive_from_path
from dashpot.model.identified import outside, quantity_of
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
    return drive_from_path(
        1.0 / (frequency * SAMPLES), x, amplitude * rate * np.cos(phase), -amplitude * rate**2 * np.sin(phase)
    )


def preloads_of(network: NetworkSpec) -> tuple[float, ...]:
    """The least, the middle and the largest preload (m) with which a network was identified; 0 where none is known."""
    ends = [ends for key, ends in network.identified.range.items() if quantity_of(key) == "preload"]
    low, high = ends[0] if ends else (0.0, 0.0)
    return (low, 0.5 * (low + high), high) if low < high else (low,)


def beyond(network: NetworkSpec, sines: Sequence[tuple[float, float, float]]) -> str:
    """What of the sines (frequency, amplitude, preload) lies outside the range of identification, in words."""
    frequencies, amplitudes, preloads = (np.array(row) for row in zip(*sines, strict=True))
    seen = {
        "frequency": frequencies,
        "amplitude": amplitudes,
        "preload": preloads,
        "displacement": np.concatenate([preloads - amplitudes, preloads + amplitudes]),
        "speed": np.append(2.0 * np.pi * frequencies * amplitudes, 0.0),
    }
    known = network.identified.range
    ends = {key: (float(seen[quantity_of(key)].min()), float(seen[quantity_of(key)].max())) for key in known}
    words = outside(ends, known)
    return f"Sines outside of the range of identification: {'; '.join(words)}." if words else ""


def require_one_end(network: NetworkSpec, what: str) -> None:
    """InputError for a network that is not driven at one end alone."""
    topology = topology_of(network)
    if len(topology.held("driven")) != 1 or topology.held("loaded"):
        raise InputError.at(
            Place(network.file),
            f"{what} needs a network with one driven end, got {len(topology.held('driven'))}",
            "export it with --to fmu",
        )

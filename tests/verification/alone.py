"""An element alone, moved in a circle."""

from __future__ import annotations

import numpy as np

from dashpot import load_registry
from dashpot.data.drive import Drive, drive_from_path
from dashpot.kernel.network import compile_network
from dashpot.model.reading import parse_network


def network_of(element: str, **numbers: object):
    """The compiled network of a single branch, its numbers as they stand in a file."""
    entries = "".join(f", {key}: {value}" for key, value in numbers.items())
    text = f"format: dashpot-network/1\nname: alone\nbranches:\n  it: {{element: {element}{entries}}}\n"
    return compile_network(parse_network(text, load_registry().elements))


def circling(amplitude: float, frequency: float, cycles: int, samples: int) -> Drive:
    """A sine with ``samples`` a cycle, with its true rates."""
    dt = 1.0 / (frequency * samples)
    omega = 2.0 * np.pi * frequency
    angle = 2.0 * np.pi * np.arange(cycles * samples + 1) / samples
    x, v = amplitude * np.sin(angle), amplitude * omega * np.cos(angle)
    return drive_from_path(dt, x, v, -(omega**2) * x)


def last_cycle(element: str, amplitude: float, frequency: float, cycles: int, samples: int, **numbers: object):
    """Angle, displacement and force over the last cycle of a sine."""
    network, drive = network_of(element, **numbers), circling(amplitude, frequency, cycles, samples)
    force = network.simulate(network.prepare(drive))[-samples:]
    angle = 2.0 * np.pi * np.arange(1, samples + 1) / samples
    return angle, drive.displacement[-samples:], force


def dynamic_stiffness(element: str, amplitude: float, frequency: float, cycles: int, samples: int, **numbers: object):
    """K' + j K'' of the first harmonic in the steady state."""
    angle, _, force = last_cycle(element, amplitude, frequency, cycles, samples, **numbers)
    return 2.0 / (amplitude * samples) * (force @ np.sin(angle) + 1j * (force @ np.cos(angle)))

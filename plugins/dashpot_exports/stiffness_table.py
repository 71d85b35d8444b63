"""Dynamic stiffness over frequency, amplitude and preload."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.export import Export
from dashpot.data.drive import Drive, drive_from_path
from dashpot.kernel.network import compile_network
from dashpot.kernel.targets.c99.header import identifier
from dashpot.model.network import NetworkSpec
from dashpot.model.topology import topology_of
from dashpot.text.problem import InputError, Place

Array = NDArray[np.float64]

PERIODS, SAMPLES = 8, 200  # of a sine, and in one period; the last period counts
HEAD = """\
frequency,amplitude,preload,storage,loss,stiffness,loss_angle
Hz,m,m,N/m,N/m,N/m,deg
"""


class StiffnessTable(Export):
    """A CSV table of dynamic stiffness and loss angle over frequency, amplitude and preload, for bushing tables.

    Sines around each preload, from rest there; the first harmonic of the force in the eighth period. What relaxes more
    slowly than eight periods is not settled then. frequencies, amplitudes, preloads: of the sines.
    """

    word = "stiffness_table"

    def __init__(
        self,
        frequencies: Annotated[tuple[float, ...], "Hz"] = (1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 25.0),
        amplitudes: Annotated[tuple[float, ...], "m"] = (1e-4, 5e-4, 1e-3, 2e-3),
        preloads: Annotated[tuple[float, ...], "m"] = (0.0,),
    ):
        if min(*frequencies, *amplitudes) <= 0.0:
            raise ValueError("frequencies and amplitudes: expected more than 0")
        self.frequencies, self.amplitudes, self.preloads = frequencies, amplitudes, preloads

    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """``NAME_stiffness.csv``."""
        topology = topology_of(network)
        if len(topology.held("driven")) != 1 or topology.held("loaded"):
            raise InputError.at(Place(network.file), "a table of stiffness needs a network with one driven end, got "
                                f"{len(topology.held('driven'))}", "export it with --to fmu")  # fmt: skip
        rows = (",".join(f"{number!r}" for number in row) for row in self._rows(network))
        return {f"{identifier(network.name)}_stiffness.csv": (HEAD + "\n".join(rows) + "\n").encode()}

    def _rows(self, network: NetworkSpec) -> Iterator[tuple[float, ...]]:
        compiled = compile_network(network)
        for preload in self.preloads:
            for amplitude in self.amplitudes:
                for frequency in self.frequencies:
                    force = compiled.along(_sine(frequency, amplitude, preload))()
                    found = _harmonic(force[-SAMPLES:]) / amplitude
                    size, angle = abs(found), np.degrees(np.angle(found))
                    yield (frequency, amplitude, preload, *map(float, (found.real, found.imag, size, angle)))


def _sine(frequency: float, amplitude: float, preload: float) -> Drive:
    phase = 2.0 * np.pi * np.arange(PERIODS * SAMPLES + 1) / SAMPLES
    rate = 2.0 * np.pi * frequency
    x = preload + amplitude * np.sin(phase)
    return drive_from_path(1.0 / (frequency * SAMPLES), x, amplitude * rate * np.cos(phase),
                           -amplitude * rate**2 * np.sin(phase))  # fmt: skip


def _harmonic(force: Array) -> complex:
    """The part in phase with the motion, and that ahead of it, in N; ``force`` begins one sample after a zero."""
    phase = 2.0 * np.pi * np.arange(1, force.size + 1) / force.size
    return complex(2.0 * np.mean(force * np.sin(phase)), 2.0 * np.mean(force * np.cos(phase)))

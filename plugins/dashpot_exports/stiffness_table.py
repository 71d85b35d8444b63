"""Dynamic stiffness over frequency, amplitude and preload."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.export import Export
from dashpot.model.network import NetworkSpec
from dashpot_exports.sines import SAMPLES, beyond, preloads_of, require_one_end, sine

Array = NDArray[np.float64]

HEAD = """\
frequency,amplitude,preload,storage,loss,stiffness,loss_angle
Hz,m,m,N/m,N/m,N/m,deg
"""


class StiffnessTable(Export):
    """A CSV table of dynamic stiffness and loss angle over frequency, amplitude and preload, for bushing tables.

    Sines around each preload, from rest there; the first harmonic of the force in the eighth period. What relaxes more
    slowly than eight periods is not settled then. frequencies, amplitudes, preloads: of the sines; by default the
    least, the middle and the largest preload of the identification.
    """

    word = "stiffness_table"

    def __init__(
        self,
        frequencies: Annotated[tuple[float, ...], "Hz"] = (1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 25.0),
        amplitudes: Annotated[tuple[float, ...], "m"] = (1e-4, 5e-4, 1e-3, 2e-3),
        preloads: Annotated[tuple[float, ...], "m"] = (),
    ):
        if min(*frequencies, *amplitudes) <= 0.0:
            raise ValueError("frequencies and amplitudes: expected more than 0")
        self.frequencies, self.amplitudes, self.preloads = frequencies, amplitudes, preloads

    def files(self, network: NetworkSpec) -> Mapping[str, bytes]:
        """``NAME_stiffness.csv``, and beside it a text that says of which network."""
        from dashpot.kernel.export import exported
        from dashpot.kernel.targets.c99.header import identifier

        require_one_end(network, "a table of stiffness")
        sines = list(product(self.preloads or preloads_of(network), self.amplitudes, self.frequencies))
        rows = "".join(f"{','.join(map(repr, row))}\n" for row in _rows(network, sines))
        name = f"{identifier(network.name)}_stiffness"
        told = [exported(network).title, beyond(network, [each[::-1] for each in sines])]
        return {
            f"{name}.csv": (HEAD + rows).encode(),
            f"{name}.txt": "".join(f"{line}\n" for line in told if line).encode(),
        }


def _rows(network: NetworkSpec, sines: list[tuple[float, float, float]]) -> Iterator[tuple[float, ...]]:
    from dashpot.kernel.network import compile_network

    compiled = compile_network(network)
    for preload, amplitude, frequency in sines:
        force = compiled.along(sine(frequency, amplitude, preload))()
        found = _harmonic(force[-SAMPLES:]) / amplitude
        size, angle = abs(found), np.degrees(np.angle(found))
        yield (frequency, amplitude, preload, *map(float, (found.real, found.imag, size, angle)))


def _harmonic(force: Array) -> complex:
    """The part in phase with the motion, and that ahead of it, in N; ``force`` begins one sample after a zero."""
    phase = 2.0 * np.pi * np.arange(1, force.size + 1) / force.size
    return complex(2.0 * np.mean(force * np.sin(phase)), 2.0 * np.mean(force * np.cos(phase)))

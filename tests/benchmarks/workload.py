"""The fixed work W1: tire_model_5 on twelve sweeps of 30 s at 1 kHz, 96 parameter vectors."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.registry import load_registry
from dashpot.data.drive import Drive, drive_from_path, drive_from_samples
from dashpot.kernel.columns import Rows
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.model.network import Characteristic, NetworkSpec, Value
from dashpot.model.reading import parse_network, read_network

Array = NDArray[np.float64]

NETWORK, LANES = "tire_model_5", 96
DT, SECONDS = 1e-3, 30.0
SLOWEST, FASTEST = 1.0, 25.0
AMPLITUDES, PRELOADS = (1e-3, 2e-3, 5e-3), (0.010, 0.015, 0.020, 0.025)
KNOTS = np.linspace(0.0, 0.035, 15)


@dataclass(frozen=True)
class Sweep:
    """A linear sweep: amplitude and preload in m, length in s."""

    amplitude: float
    preload: float
    seconds: float = SECONDS

    @property
    def time(self) -> Array:
        """When it is sampled, in s."""
        return DT * np.arange(round(self.seconds / DT))

    @property
    def rate(self) -> float:
        """How fast the frequency grows, in Hz/s."""
        return (FASTEST - SLOWEST) / self.seconds

    def path(self, time: Array) -> tuple[Array, Array, Array]:
        """Displacement, velocity and acceleration."""
        phase = 2.0 * np.pi * (SLOWEST * time + 0.5 * self.rate * time**2)
        turning = 2.0 * np.pi * (SLOWEST + self.rate * time)
        sine, cosine = self.amplitude * np.sin(phase), self.amplitude * np.cos(phase)
        return self.preload + sine, cosine * turning, 2.0 * np.pi * self.rate * cosine - sine * turning**2

    def reversals(self) -> Array:
        """The times at which it turns round, in s."""
        last = self.time[-1]
        cycles = SLOWEST * last + 0.5 * self.rate * last**2
        quarter = np.arange(int(2.0 * cycles) + 2) / 2.0 + 0.25
        found = (np.sqrt(SLOWEST**2 + 2.0 * self.rate * quarter) - SLOWEST) / self.rate
        return found[found < last]

    def drive(self) -> Drive:
        """The drive with its exact rates."""
        return drive_from_path(DT, *self.path(self.time))

    def sampled(self) -> Drive:
        """The drive of which only the displacement at the samples is known."""
        return drive_from_samples(DT, self.path(self.time)[0])


SWEEPS = tuple(Sweep(amplitude, preload) for amplitude in AMPLITUDES for preload in PRELOADS)


@cache
def drives() -> tuple[Drive, ...]:
    """The twelve drives."""
    return tuple(sweep.drive() for sweep in SWEEPS)


@cache
def network(name: str = NETWORK) -> CompiledNetwork:
    """A shipped network with a progressive carcass of 180 to 250 N/mm in the place of its curve from data."""
    return compile_network(grounded(read_network(name, load_registry().elements)))


@cache
def network_of(branches: str) -> CompiledNetwork:
    """A network with these branches, as they stand in a file."""
    return compile_network(
        parse_network("format: dashpot-network/1\nname: bench\nbranches:\n" + branches, load_registry().elements)
    )


def grounded(spec: NetworkSpec) -> NetworkSpec:
    """The network with its curves from data filled in."""
    for path, curve in spec.data_curves().items():
        values = tuple(Value(1.8e5 * x + 1e6 * x * x, "N", "identified", (0.0, 1e5), "linear") for x in KNOTS.tolist())
        spec = spec.with_curve(path, Characteristic(curve.curve, "table", values, tuple(KNOTS.tolist()), curve.data))
    return spec


def lanes(compiled: CompiledNetwork, count: int = LANES, seed: int = 1) -> Array:
    """Parameter vectors within a factor of two of the file's, the first one as it is; curves are as they are."""
    values = np.repeat(compiled.start[None], count, axis=0)
    free = ["[" not in path for path in compiled.paths]
    values[1:, free] *= np.exp(np.random.default_rng(seed).uniform(-0.7, 0.7, (count, sum(free)))[1:])
    return values


@dataclass(frozen=True, eq=False)
class Task:
    """A network on runs: ``score()`` scores all lanes on all of them, ``units`` lanes times samples."""

    network: CompiledNetwork
    rows: tuple[Rows, ...]
    values: Array
    jobs: int

    @classmethod
    def of(cls, compiled: CompiledNetwork, runs: tuple[Drive, ...], count: int = LANES, jobs: int = 1) -> Task:
        """The task of a block of ``count`` lanes."""
        return cls(compiled, tuple(compiled.prepare(drive) for drive in runs), lanes(compiled, count), jobs)

    @property
    def units(self) -> int:
        """Lanes times samples."""
        return self.values.shape[0] * sum(run.drive.samples for run in self.rows)

    def score(self) -> Array:
        """The scores (runs, lanes) against zero."""
        zeros = [np.zeros(run.drive.samples) for run in self.rows]
        return self.network.score(self.rows, zeros, [zero + 1.0 for zero in zeros], self.values, self.jobs)

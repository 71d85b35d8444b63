"""The fixed work W1: tire_model_5 on twelve sweeps of 30 s at 1 kHz, 96 parameter vectors."""

from __future__ import annotations

import numpy as np

from dashpot.contract.registry import load_registry
from dashpot.data.drive import Drive, drive_from_path
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.model.network import Characteristic, NetworkSpec, Value
from dashpot.model.reading import read_network

DT, SECONDS, LANES = 1e-3, 30.0, 96
AMPLITUDES, PRELOADS = (1e-3, 2e-3, 5e-3), (0.010, 0.015, 0.020, 0.025)
KNOTS = np.linspace(0.0, 0.035, 15)


def sweep(amplitude: float, preload: float, seconds: float = SECONDS) -> Drive:
    """A linear sweep from 1 to 25 Hz with its exact rates."""
    time = DT * np.arange(round(seconds / DT))
    rate = 24.0 / seconds
    phase = 2.0 * np.pi * (time + 0.5 * rate * time**2)
    turning = 2.0 * np.pi * (1.0 + rate * time)
    sine, cosine = amplitude * np.sin(phase), amplitude * np.cos(phase)
    acceleration = -sine * turning**2 + cosine * 2.0 * np.pi * rate
    return drive_from_path(DT, preload + sine, cosine * turning, acceleration)


def runs() -> list[Drive]:
    """The twelve sweeps."""
    return [sweep(amplitude, preload) for amplitude in AMPLITUDES for preload in PRELOADS]


def network(name: str) -> CompiledNetwork:
    """A shipped network with a progressive carcass of 180 to 250 N/mm in the place of its curve from data."""
    return compile_network(grounded(read_network(name, load_registry().elements)))


def grounded(spec: NetworkSpec) -> NetworkSpec:
    """The network with its curves from data filled in."""
    for path, curve in spec.data_curves().items():
        values = tuple(Value(1.8e5 * x + 1e6 * x * x, "N") for x in KNOTS.tolist())
        spec = spec.with_curve(path, Characteristic(curve.curve, "table", values, tuple(KNOTS.tolist()), curve.data))
    return spec


def lanes(compiled: CompiledNetwork, count: int = LANES, seed: int = 1) -> np.ndarray:
    """Parameter vectors within a factor of two of the file's, curves as they are."""
    values = np.repeat(compiled.start[None], count, axis=0)
    free = ["[" not in path for path in compiled.paths]
    factors = np.exp(np.random.default_rng(seed).uniform(-0.7, 0.7, (count, sum(free))))
    values[:, free] *= factors
    return values

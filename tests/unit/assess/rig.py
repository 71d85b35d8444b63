"""Sweeps with known forces and noise, and networks fitted to them."""

import numpy as np

from dashpot.contract.registry import load_registry
from dashpot.data.run import Run
from dashpot.model.reading import parse_network

REGISTRY = load_registry()
STEP = 1e-3
TIME = np.arange(3000) * STEP


def sweep(name, amplitude, preload, rng, force, held_out=False):
    phase = 2.0 * np.pi * (TIME + 3.0 * TIME**2)
    x = preload + amplitude * np.sin(phase)
    v = amplitude * np.cos(phase) * 2.0 * np.pi * (1.0 + 6.0 * TIME)
    noisy = force(x, v) + 4.0 * rng.standard_normal(TIME.size)
    return Run(name, "sweep", TIME, {"displacement": x, "force": noisy}, group=name, held_out=held_out)


def fitted(bench, text):
    declared = parse_network(text, REGISTRY.elements)
    return bench.fit(declared, bench.start_from(declared, declared), None)

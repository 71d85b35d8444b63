"""Sweeps with known forces and noise, networks fitted to them, and a cause that suspects nothing."""

import numpy as np

from dashpot.contract.cause import Cause
from dashpot.contract.registry import load_registry
from dashpot.data.run import Run
from dashpot.model.reading import parse_network

REGISTRY = load_registry()
STEP = 1e-3
TIME = np.arange(3000) * STEP
# amplitude and preload in m; the latter two reach the stop of `stopped`
STOPPED_AT = {"near": (4e-3, 10e-3), "small": (2e-3, 8e-3), "far": (6e-3, 16e-3), "far_too": (5e-3, 17e-3)}


class Made(Cause):
    """A cause for tests."""

    word, kind, about, shows = "made", "specimen", "made for a test", "in no way"

    def suspects(self, view, network):
        """None of its own."""
        return ()


def stopped(x, v):
    """A spring and a damper that meet a buffer of 20 N/mm beyond 18 mm."""
    return 200e3 * x + 250.0 * v + 20e3 * np.maximum(x - 18e-3, 0.0)


def sweep(name, amplitude, preload, rng, force, held_out=False):
    phase = 2.0 * np.pi * (TIME + 3.0 * TIME**2)
    x = preload + amplitude * np.sin(phase)
    v = amplitude * np.cos(phase) * 2.0 * np.pi * (1.0 + 6.0 * TIME)
    noisy = force(x, v) + 4.0 * rng.standard_normal(TIME.size)
    return Run(name, "sweep", TIME, {"displacement": x, "force": noisy}, group=name, held_out=held_out)


def fitted(bench, text):
    declared = parse_network(text, REGISTRY.elements)
    return bench.fit(declared, bench.start_from(declared, declared), None)

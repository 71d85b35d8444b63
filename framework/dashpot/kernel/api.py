"""Simulating measured runs, as the load cell would show them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.registry import Registry, load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.ends import one_force_each
from dashpot.data.excitation import Excitation
from dashpot.kernel.network import CompiledNetwork, compile_network
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import read_network


def simulate_runs(spec: NetworkSpec | str | Path, dataset: Dataset, *,
                  registry: Registry | None = None) -> dict[str, NDArray[np.float64]]:  # fmt: skip
    """The force (n,) in N of a network along the motion of every run, by the name of the run.

    Where a run measures the forces at several nodes the names are ``run@node``.

    It is seen through the network's ``measurement`` (gain, offset, delay). A network given by file or shipped name is
    read with the elements of ``registry``, by default the installed ones. Raises InputError for a network with mistakes
    or with a curve that has no numbers yet, and for a run that lacks a motion.
    """
    if not isinstance(spec, NetworkSpec):
        spec = read_network(spec, (registry or load_registry()).elements)
    network = compile_network(spec)
    observation = network.observation(network.start)
    found = {}
    for run in one_force_each(dataset).runs:
        rows = network.prepare(Excitation.of_run(run))
        force = network.simulate(rows) if isinstance(network, CompiledNetwork) else network.simulate(rows, end=run.end)
        found[run.name] = observation.see(force[None], run.sample_time)[0]
    return found

"""Simulating measured runs, as the load cell would show them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from dashpot.contract.registry import Registry, load_registry
from dashpot.data.dataset import Dataset
from dashpot.data.drive import Drive, drive_from_samples
from dashpot.data.run import Run
from dashpot.kernel.network import compile_network
from dashpot.model.network import NetworkSpec
from dashpot.model.reading import read_network
from dashpot.text.problem import InputError, Place


def simulate_runs(spec: NetworkSpec | str | Path, dataset: Dataset, *,
                  registry: Registry | None = None) -> dict[str, NDArray[np.float64]]:  # fmt: skip
    """The force (n,) in N of a network along the motion of every run, by the name of the run.

    It is seen through the network's ``measurement`` (gain, offset, delay). A network given by file or shipped name is
    read with the elements of ``registry``, by default the installed ones. Raises InputError for a network with mistakes
    or with a curve that has no numbers yet, and for a run without displacement.
    """
    if not isinstance(spec, NetworkSpec):
        spec = read_network(spec, (registry or load_registry()).elements)
    network = compile_network(spec)
    observation = network.observation(network.start)
    found = {}
    for run in dataset.runs:
        drive = _drive(run)
        found[run.name] = observation.see(network.simulate(network.prepare(drive))[None], drive.dt)[0]
    return found


def _drive(run: Run) -> Drive:
    if "displacement" not in run.channels:
        raise InputError.at(Place(run.source or None), f"run '{run.name}' has no channel 'displacement'",
                            "declare it under 'channels'")  # fmt: skip
    return drive_from_samples(run.sample_time, run.displacement)

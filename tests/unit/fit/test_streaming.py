"""Runs that are read when they are needed: the same numbers, and memory for a few of them only."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from seeds import seed_of
from unit.kernel.networks import compiled

from dashpot.contract.registry import load_registry
from dashpot.data.dataset import read_dataset
from dashpot.data.stream import open_dataset
from dashpot.fit.objective import Objective
from dashpot.fit.scored import score_run
from dashpot.fit.streaming import StreamedObjective

SAMPLES, DT = 5000, 1e-3
ENTRY = """  - name: r{number}
    file: r{number}.npz
    kind: random
    channels:
      time: {{column: t, unit: s}}
      displacement: {{column: x, unit: m}}
      force: {{column: F, unit: N}}
"""
TIRE = """
    carcass: {element: spring, stiffness: 200 N/mm}
    rubber: {element: maxwell, stiffness: 8 N/mm, relaxation_time: 30 ms}
    filler: {repeat: 2, element: prandtl, stiffness: 9 N/mm, limit: [6 N, 20 N]}
"""


@pytest.fixture(scope="module")
def readers():
    return {word: reader() for word, reader in load_registry().formats.items()}


def dataset(folder: Path, count: int) -> Path:
    rng, time = np.random.default_rng(seed_of("test_streaming")), DT * np.arange(SAMPLES)
    for number in range(count):
        x = 1e-3 * sum(np.sin(2.0 * np.pi * rng.uniform(1.0, 20.0) * time + rng.uniform(0.0, 6.0)) for _ in range(4))
        np.savez(folder / f"r{number}.npz", t=time, x=x, F=2e5 * x + rng.standard_normal(SAMPLES))
    entries = "".join(ENTRY.format(number=number) for number in range(count))
    (folder / "dataset.yaml").write_text(f"format: dashpot-dataset/1\nruns:\n{entries}")
    return folder


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_errors_are_those_of_the_objective(tmp_path, readers, jobs):
    folder, network = dataset(tmp_path, 3), compiled(TIRE)
    rng = np.random.default_rng(seed_of("test_streaming2"))
    values = network.start * np.exp(rng.uniform(-0.5, 0.5, (5, network.start.size)))
    whole = Objective(network, [score_run(run) for run in read_dataset(folder, readers).runs])
    streamed = StreamedObjective(network, open_dataset(folder, readers), jobs)
    found = dict(streamed.rmse(values))
    assert list(found) == ["r0", "r1", "r2"]
    assert np.array_equal(list(found.values()), whole.rmse(values))
    assert np.allclose(streamed.losses(values), whole.losses(values), rtol=1e-12)


def test_a_lane_that_fails_costs_infinity(tmp_path, readers):
    network = compiled(TIRE)
    values = np.repeat(network.start[None], 2, axis=0)
    values[1, 0] = np.nan
    losses = StreamedObjective(network, open_dataset(dataset(tmp_path, 2), readers)).losses(values)
    assert np.isfinite(losses).tolist() == [True, False] and losses[1] == np.inf


def test_memory_does_not_grow_with_the_number_of_runs(tmp_path, readers):
    network, peaks = compiled(TIRE), []
    values = np.repeat(network.start[None], 96, axis=0)
    for count in (3, 15):
        folder = tmp_path / str(count)
        folder.mkdir()
        streamed = StreamedObjective(network, open_dataset(dataset(folder, count), readers))
        streamed.losses(values)
        tracemalloc.start()
        streamed.losses(values)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    channel = 8 * SAMPLES  # the turning points of a run take some, twelve runs more take as many at the least
    assert peaks[1] < peaks[0] + 5 * channel

"""The colour of noise before a fit, against covariances in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import toeplitz
from seeds import seed_of
from unit.fit.bench import jacobian_of

from dashpot import load_registry
from dashpot.contract.bench import Bench
from dashpot.contract.measuring import Measuring
from dashpot.data.dataset import Dataset
from dashpot.data.noise import UNKNOWN
from dashpot.data.noise_spectrum import NoiseSpectrum
from dashpot.fit.coordinates import search_coordinates
from dashpot.fit.floor import noise_floor
from dashpot.fit.identifiability import identifiability
from dashpot.fit.noise_of_runs import noise_of_runs, variance_of, white
from dashpot.fit.objective import Objective
from dashpot.fit.ranges import natural_sizes, with_ranges
from dashpot.fit.scored import score_run
from dashpot.fit.virtual_test import virtual_test
from dashpot.kernel.network import compile_network
from dashpot.model.reading import parse_network

DT, NOISE, MEMORY, MEASUREMENTS = 1e-3, 9.0, 10e-3, 24
SPECIMEN = """\
format: dashpot-network/1
name: specimen
branches:
  rubber: {element: spring, stiffness: {start: 200 N/mm}}
  oil: {element: damper, damping: {start: 60 N*s/m}}
  slow: {element: maxwell, stiffness: {start: 30 N/mm}, relaxation_time: {start: 25 ms}}
"""


def covariance(samples: int, dt: float) -> np.ndarray:
    """Of the virtual load cell: half of the power white, half remembered."""
    remembered = toeplitz(np.exp(-dt * np.arange(samples) / MEMORY))
    return 0.5 * NOISE**2 * (np.eye(samples) + remembered)


def test_sums_of_coloured_noise_vary_as_their_covariance_says():
    frequency = np.linspace(0.0, 500.0, 4000)
    kept = np.exp(-DT / MEMORY)
    turn = np.exp(-2j * np.pi * frequency * DT)
    density = NOISE**2 * DT * (1.0 + (1.0 - kept**2) / np.abs(1.0 - kept * turn) ** 2)
    time = DT * np.arange(2000)
    window = np.sin(np.pi * time / time[-1]) ** 2
    columns = window * np.array([np.sin(2 * np.pi * 8.0 * time), np.cos(2 * np.pi * 8.0 * time), np.sin(300.0 * time)])
    found = variance_of(columns, NoiseSpectrum(frequency, density, DT))
    expected = columns @ covariance(2000, DT) @ columns.T
    assert np.abs(found - expected).max() < 0.01 * expected.max()


@pytest.mark.parametrize("samples", [400, 401])
def test_white_noise_gives_the_products_of_the_columns(samples):
    columns = np.random.default_rng(samples).normal(size=(3, samples))
    found = variance_of(columns, white({"a": 5.0}, DT)["a"])
    np.testing.assert_allclose(found, 25.0 * columns @ columns.T, rtol=1e-12, atol=1e-9)


@pytest.fixture(scope="module")
def bench() -> Bench:
    rigs = load_registry().rigs
    sweeps = rigs["hydropulser"](amplitudes=(0.5e-3, 3e-3), preloads=(4e-3,), duration=4.0, direction="up")
    return Bench(
        "coloured",
        (rigs["triangle"](depth=6e-3, speed=4e-3, loops=2), sweeps),
        Measuring(force_noise=NOISE, noise_memory=MEMORY),
    )


def test_what_is_foretold_is_what_noise_of_that_colour_does(bench):
    spec = parse_network(SPECIMEN, load_registry().elements, "specimen.yaml")
    seed = seed_of("test_noise_of_runs") % 2**24
    predicted = []
    for number in range(MEASUREMENTS):
        measured = virtual_test(spec, bench, seed + number)
        runs = [score_run(run) for run in measured]
        ranged = with_ranges(spec, natural_sizes(runs))
        objective, coordinates = Objective(compile_network(ranged), runs), search_coordinates(ranged)
        noise = noise_of_runs(measured, noise_floor(Dataset("d", tuple(measured))))
        predicted.append(list(identifiability(objective, coordinates, coordinates.start, noise).deviations.values()))
    _, jacobian = jacobian_of(objective, coordinates, coordinates.start)
    ends = np.cumsum([run.samples for run in runs])
    scores = sum(
        objective.factor(number) ** 2 * columns @ covariance(run.samples, run.drive.dt) @ columns.T
        for number, (run, columns) in enumerate(zip(runs, np.hsplit(jacobian, ends[:-1]), strict=True))
    )
    bread = np.linalg.inv(jacobian @ jacobian.T)
    exact = np.sqrt(np.diag(bread @ scores @ bread))
    as_if_white = np.sqrt(np.diag(bread)) * NOISE
    # few slow waves fit into a run: what is predicted scatters from one measurement to the next
    scatter = np.std(predicted, axis=0, ddof=1) / np.sqrt(MEASUREMENTS)
    assert (np.abs(np.mean(predicted, axis=0) - exact) < 0.15 * exact + 3.0 * scatter).all()
    assert np.abs(as_if_white / exact - 1.0).max() > 0.4


def test_without_any_room_for_noise_it_is_white_and_as_large_as_the_floor(bench):
    spec = parse_network(SPECIMEN, load_registry().elements, "specimen.yaml")
    slow = [run for run in virtual_test(spec, bench, 1) if run.kind == "quasi_static"]
    [found] = noise_of_runs(slow, UNKNOWN).values()
    assert found.deviation == pytest.approx(1.0)

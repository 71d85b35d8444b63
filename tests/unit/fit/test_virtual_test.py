"""A virtual rig writes down what the network's force and the errors of the sensors add up to."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import network

from dashpot import load_registry
from dashpot.contract.bench import Bench
from dashpot.contract.measuring import Measuring
from dashpot.data.dataset import read_dataset
from dashpot.data.writing import dataset_files
from dashpot.fit.virtual_test import coloured_noise, virtual_test
from dashpot.text.problem import InputError

RIGS = load_registry().rigs
SPRING = "rubber: {element: spring, stiffness: 2e5}"
SWEEP = RIGS["hydropulser"](amplitudes=(1e-3,), preloads=(5e-3,), duration=2.0, direction="up")


def measured(branches=SPRING, rigs=(SWEEP,), seed=0, **chain):
    return virtual_test(network(branches), Bench("b", rigs, Measuring(**chain)), seed)


def test_without_errors_the_load_cell_shows_the_force():
    [run] = measured()
    assert run.force == pytest.approx(2e5 * run.displacement, rel=1e-12)
    assert run.settings["preload"] == 5e-3 and not run.sensors


def test_a_damper_feels_the_velocity_of_the_prescribed_path():
    [run] = measured("oil: {element: damper, damping: 300}")
    assert run.force == pytest.approx(300.0 * SWEEP.runs()[0].motion[""].velocity, abs=1e-9)


@pytest.mark.parametrize("side, mass", [("platform", 3.0), ("hub", 0.0)])
def test_only_a_load_cell_at_the_platform_feels_its_mass(side, mass):
    [run] = measured(side=side, platform_mass=3.0)
    assert run.force == pytest.approx(2e5 * run.displacement + mass * SWEEP.runs()[0].motion[""].acceleration)


def test_gain_zero_and_delay_are_those_of_the_load_cell():
    [run] = measured(gain=1.01, zero=4.0, delay=2e-3)
    late = 1.01 * 2e5 * run.displacement[100:-2] + 4.0
    assert run.force[102:] == pytest.approx(late, rel=1e-9)


def test_noise_has_its_size_and_its_memory():
    runs = measured(
        force_noise=5.0,
        noise_memory=10e-3,
        displacement_noise=1e-6,
        seed=np.random.SeedSequence().entropy % 2**32,
        repeats=4,
    )
    noise = np.array([run.force - 2e5 * SWEEP.runs()[0].motion[""].displacement for run in runs])
    # 8000 samples, of which 20 in a row belong together: the root mean square scatters by 3 %
    assert np.sqrt(np.mean(noise**2)) == pytest.approx(5.0, rel=0.15)
    lagged = np.mean(noise[:, 10:] * noise[:, :-10]) / np.mean(noise**2)
    assert lagged == pytest.approx(0.5 * np.exp(-1.0), abs=0.08)
    assert [run.repeats for run in runs] == [None, *[runs[0].name] * 3]
    assert runs[0].sensors == {"displacement": {"noise": 1e-6}, "force": {"noise": 5.0}}


def test_noise_without_memory_is_white():
    noise = coloured_noise(np.random.default_rng(seed_of("test_virtual_test")), 40000, 1e-3, 0.0)
    assert abs(np.mean(noise[1:] * noise[:-1])) < 5.0 / np.sqrt(40000)


def test_the_same_seed_gives_the_same_bytes_and_another_other_ones():
    files = [dataset_files("d", measured(force_noise=5.0, seed=seed)) for seed in (1, 1, 2)]
    assert files[0] == files[1] != files[2]


def test_what_was_written_reads_back_alike(tmp_path):
    triangle = RIGS["triangle"](depth=5e-3, sampling=50.0)
    runs = measured(rigs=(triangle, SWEEP), force_noise=5.0, repeats=2)
    for name, text in dataset_files("on a rig (virtual)", runs).items():
        (tmp_path / name).write_text(text)
    dataset = read_dataset(tmp_path, {word: reader() for word, reader in load_registry().formats.items()})
    assert not dataset.problems
    assert [run.name for run in dataset.runs] == [run.name for run in runs]
    for written, read in zip(runs, dataset.runs, strict=True):
        assert (read.kind, read.repeats, read.sensors) == (written.kind, written.repeats, written.sensors)
        assert read.settings == pytest.approx(dict(written.settings))
        assert np.array_equal(read.force, written.force) and np.array_equal(read.displacement, written.displacement)


def test_a_network_without_the_driven_nodes_is_refused():
    with pytest.raises(InputError, match="it has motions of 'platform_left', 'platform_right'"):
        measured(rigs=(RIGS["axle_sweep"](duration=1.0),))

"""Small jitter is taken as even, strong unevenness is resampled and told, gaps and backward steps set a run aside."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.dataset import Dataset, read_dataset
from dashpot.text.problem import InputError
from dashpot_formats import dashpot_formats

READERS = {reader.word: reader() for reader in dashpot_formats()}
TEXT = """\
format: dashpot-dataset/1
runs:
  - name: run
    file: run.npz
    kind: random
    channels: {time: t, displacement: x, force: F}
"""


@pytest.fixture
def rng(request: pytest.FixtureRequest) -> np.random.Generator:
    seed = seed_of("test_dataset_clock")
    print(f"seed {seed}")
    return np.random.default_rng(seed)


def motion(time: np.ndarray) -> np.ndarray:
    return np.sin(2 * np.pi * 2 * time) + 0.5 * np.sin(2 * np.pi * 3.3 * time)


def read(folder: Path, time: np.ndarray, **more: str) -> Dataset:
    np.savez(folder / "run.npz", t=time, x=motion(time), F=10 * motion(time))
    text = TEXT + "".join(f"    {key}: {value}\n" for key, value in more.items())
    (folder / "dataset.yaml").write_text(text)
    return read_dataset(folder, READERS)


def why_set_aside(folder: Path, time: np.ndarray) -> str:
    with pytest.raises(InputError) as caught:
        read(folder, time)
    return str(caught.value)


def test_small_jitter_is_taken_as_even(tmp_path, rng):
    time = 5.0 + np.arange(2000) * 1e-3 + rng.normal(0, 5e-6, 2000)
    dataset = read(tmp_path, time)
    assert dataset.problems == ()
    run = dataset.run("run")
    assert run.sample_time == pytest.approx(1e-3, rel=1e-6)
    assert np.array_equal(run.force, 10 * motion(time))
    assert np.array_equal(np.diff(run.time) > 0, np.ones(1999, dtype=bool))


@pytest.mark.parametrize(("rate", "digits"), [(1024, 3), (1024, 4), (3000, 4), (300, 2), (1000, 2)])
def test_a_time_that_was_written_with_few_digits_is_even(tmp_path, rate, digits):
    time = np.arange(4000) / rate
    np.savez(tmp_path / "run.npz", t=np.round(time, digits), x=motion(time), F=motion(time))
    (tmp_path / "dataset.yaml").write_text(TEXT)
    dataset = read_dataset(tmp_path, READERS)
    assert dataset.problems == ()
    assert dataset.run("run").sample_time == pytest.approx(1 / rate, rel=1e-4)


def test_strongly_uneven_sampling_is_resampled_and_told(tmp_path, rng):
    steps = rng.choice([0.010, 0.011, 0.012, 0.028], 3000, p=[0.6, 0.2, 0.15, 0.05])
    time = np.concatenate([[0.0], np.cumsum(steps)])
    dataset = read(tmp_path, time)
    run = dataset.run("run")
    assert run.sample_time == pytest.approx(0.010)
    assert run.time[-1] == pytest.approx(time[-1], abs=0.011)
    # what linear interpolation over the longest step would miss at most
    curvature = 10 * ((2 * np.pi * 2) ** 2 + 0.5 * (2 * np.pi * 3.3) ** 2)
    assert np.abs(run.force - 10 * motion(run.time)).max() < 0.028**2 / 8 * curvature
    (problem,) = dataset.problems
    assert problem.severity == "warning"
    assert "its sample time varies from 10 to 28 ms" in problem.message
    assert "it was laid on an even grid of 10 ms" in problem.message


def test_a_missing_sample_is_no_jitter(tmp_path):
    time = np.delete(np.arange(40_000) * 1e-3, 20_000)
    dataset = read(tmp_path, time)
    assert "(longest at 19.999 s)" in dataset.problems[0].message
    run = dataset.run("run")
    assert run.time.size == 40_000
    assert np.abs(run.force - 10 * motion(run.time)).max() < 1e-3


def test_a_long_gap_is_told_with_its_time_and_the_longest_piece(tmp_path):
    time = np.arange(3000) * 1e-3
    time[1000:] += 0.5
    text = why_set_aside(tmp_path, time)
    assert "it has a gap from 0.999 s to 1.5 s, at row 1001. the longest piece without gaps is" in text
    assert "'start: 1.5 s, stop: 3.499 s'" in text
    piece = read(tmp_path, time, start="1.5 s", stop="3.499 s")
    assert piece.problems == () and piece.run("run").time.size == 2000


def test_a_time_that_runs_backwards_is_told(tmp_path):
    time = np.arange(3000) * 1e-3
    time[2000:] -= 1.0
    text = why_set_aside(tmp_path, time)
    assert "its time runs backwards at row 2001: from 1.999 s to 1 s. cut one piece out of the file with 'rows:" in text
    assert read(tmp_path, time, rows="[1, 2000]").run("run").time.size == 2000


def test_a_time_that_stands_still_is_told(tmp_path):
    time = np.arange(3000) * 1e-3
    time[1500:1600] = time[1500]
    assert "its time does not advance at row 1502: 1.5 s comes twice. say 'sampling:" in why_set_aside(tmp_path, time)


def test_a_constant_time_is_told(tmp_path):
    assert "its time does not advance at row 2" in why_set_aside(tmp_path, np.full(100, 3.0))


def test_a_jump_too_steep_for_a_number_sets_the_run_aside(tmp_path, rng):
    """On an uneven clock that is laid on an even grid; of a damaged file, mostly."""
    time = np.cumsum(rng.uniform(0.5e-3, 1.5e-3, 400))
    force = 10 * motion(time)
    force[200:] = 1.7e308
    np.savez(tmp_path / "run.npz", t=time, x=motion(time), F=force)
    (tmp_path / "dataset.yaml").write_text(TEXT)
    with pytest.raises(InputError, match="it jumps from .* to 1.7e\\+308 within"):
        read_dataset(tmp_path, READERS)

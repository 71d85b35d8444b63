"""Clipped channels set a run aside; what is flat for a good reason does not."""

from __future__ import annotations

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.clipping import clipped_channels
from dashpot.data.dataset import read_dataset
from dashpot.text.problem import InputError
from dashpot.text.quantity import pretty
from dashpot_formats import dashpot_formats

RATE = 1000
TIME = np.arange(10 * RATE) / RATE
SEEDS = np.random.default_rng(seed_of("test_dataset_clipping")).integers(0, 2**31, 4).tolist()


def told(force: np.ndarray, displacement: np.ndarray, kind: str = "harmonic") -> list[str]:
    channels = {"displacement": displacement, "force": force}
    return [str(trouble.message) for trouble in clipped_channels(channels, kind, lambda sample: f"row {sample + 1}")]


def sweep(start: float = 1.0, stop: float = 25.0) -> np.ndarray:
    return np.sin(2 * np.pi * (start * TIME + (stop - start) * TIME**2 / 20))


def rubber(displacement: np.ndarray) -> np.ndarray:
    return 900 * displacement + 2.0 * np.gradient(displacement, 1 / RATE)


@pytest.mark.parametrize("seed", SEEDS, ids=range(len(SEEDS)))
@pytest.mark.parametrize("noise", [0.0, 3.0])
@pytest.mark.parametrize("step", [0.0, 0.5])
@pytest.mark.parametrize(("stop", "share"), [(3.0, 0.97), (8.0, 0.95), (25.0, 0.8)])
def test_a_clipped_force_is_told(seed, noise, step, stop, share):
    rng = np.random.default_rng(seed)
    motion = sweep(1.0, stop)
    force = rubber(motion) + rng.normal(0, noise, motion.size) if noise else rubber(motion)
    force = np.round(force / step) * step if step else force
    limit = share * force.max()
    (text,) = told(np.minimum(force, limit), motion, "sweep")
    assert f"the force stays at exactly {pretty(limit, 'N')}, its maximum" in text and "it is clipped" in text
    (text,) = told(np.maximum(-force, -limit), motion, "sweep")
    assert "its minimum" in text


def test_a_clipped_displacement_of_a_moving_run_is_told():
    motion = 0.01 * sweep(2, 5)
    (text,) = told(rubber(motion), np.minimum(motion, 0.0095), "sweep")
    assert "the displacement stays at exactly 9.5 mm, its maximum, for up to" in text


@pytest.mark.parametrize("seed", SEEDS, ids=range(len(SEEDS)))
@pytest.mark.parametrize("frequency", [0.05, 0.3, 1.0, 5.0, 20.0])
@pytest.mark.parametrize("levels", [50, 500, 5000])
@pytest.mark.parametrize("noise", [0.0, 0.3, 2.0])
def test_the_digits_of_a_slow_signal_are_no_clipping(seed, frequency, levels, noise):
    rng = np.random.default_rng(seed)
    phase = rng.uniform(0, 2 * np.pi)
    motion = np.sin(2 * np.pi * frequency * TIME + phase)
    digital = np.round(levels * motion + rng.normal(0, 1, TIME.size) * noise) / levels
    assert told(digital, np.roll(digital, 7)) == []


@pytest.mark.parametrize("seed", SEEDS, ids=range(len(SEEDS)))
def test_a_digital_sweep_and_random_motion_are_no_clipping(seed):
    rng = np.random.default_rng(seed)
    noise = np.convolve(rng.normal(size=TIME.size + 100), np.hanning(100), "same")[: TIME.size]
    for motion in (sweep(rng.uniform(0.5, 2), rng.uniform(10, 30)), noise / np.abs(noise).max()):
        digital = np.round(rubber(motion) / 2.0) * 2.0
        assert told(digital, np.round(motion, 3), "sweep") == []


def test_a_friction_that_slides_up_to_the_reversal_is_no_clipping():
    motion = 0.01 * sweep(1, 4)
    force, stuck = np.zeros(TIME.size), 0.0
    for sample in range(1, TIME.size):
        stuck = np.clip(stuck + 1e5 * (motion[sample] - motion[sample - 1]), -50.0, 50.0)
        force[sample] = stuck
    assert told(force, motion, "sweep") == []


def test_a_lost_contact_is_no_clipping():
    motion = sweep(2, 6)
    assert told(np.maximum(rubber(motion), 0.0), motion, "sweep") == []


def test_a_motion_that_rests_is_no_clipping():
    motion = np.clip(3 * np.sin(2 * np.pi * 0.3 * TIME), -1, 1)
    assert told(500 * motion, motion, "hold") == []
    assert told(500 * motion, motion, "quasi_static") == []


def test_a_rest_before_the_test_is_no_clipping():
    motion = -np.cos(2 * np.pi * 2 * np.maximum(TIME - 1.5, 0.0))
    assert told(500 * motion + 1.0, motion) == []


def test_a_constant_channel_is_not_called_clipped():
    assert told(np.full(TIME.size, 4.0), sweep()) == []


def test_a_single_flat_top_of_a_few_samples_is_no_clipping():
    force = rubber(sweep())
    force[force.argmax() + np.arange(5)] = force.max()
    assert told(force, sweep()) == []


def test_a_clipped_run_is_set_aside_unless_it_is_accepted(tmp_path):
    motion = sweep()
    np.savez(tmp_path / "a.npz", x=motion, F=np.clip(rubber(motion), -700, 700))
    text = (
        "format: dashpot-dataset/1\ndefaults: {kind: sweep, sampling: 1 kHz, channels: {displacement: x, force: F}}\n"
        "runs:\n  - {file: a.npz}\n"
    )
    (tmp_path / "dataset.yaml").write_text(text)
    readers = {reader.word: reader() for reader in dashpot_formats()}
    with pytest.raises(InputError) as caught:
        read_dataset(tmp_path, readers)
    assert "stays at exactly 700 N, its maximum" in str(caught.value)
    assert "stays at exactly -700 N, its minimum" in str(caught.value)
    (tmp_path / "dataset.yaml").write_text(text.replace("a.npz}", "a.npz, accept: [clipping]}"))
    assert len(read_dataset(tmp_path, readers).runs) == 1

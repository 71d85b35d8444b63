"""The noise floor comes from repeats that are some, and says so where declared ones are none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of

from dashpot.data.dataset import Dataset
from dashpot.data.run import Run
from dashpot.fit.floor import false_repeats, noise_floor

TIME = 1e-3 * np.arange(8000)
NOISE = 5.0


def run(name: str, amplitude: float, rng: np.random.Generator, repeats: str | None = None) -> Run:
    displacement = amplitude * np.sin(4.0 * np.pi * TIME)
    force = 1e5 * displacement + NOISE * rng.standard_normal(TIME.size)
    return Run(name, "harmonic", TIME, {"displacement": displacement, "force": force}, {}, repeats, repeats or name)


def test_repeats_give_the_noise_they_were_made_with():
    seed = int(np.random.default_rng(seed_of("test_floor")).integers(2**32))
    print(f"seed {seed}")
    rng = np.random.default_rng(seed)
    dataset = Dataset("two of one kind", (run("a", 1e-3, rng), run("b", 1e-3, rng, "a")))
    floor = noise_floor(dataset)
    assert floor.source == "repeats" and floor.value == pytest.approx(NOISE, rel=0.1)
    assert false_repeats(dataset) == []


def test_declared_repeats_of_another_amplitude_are_told_of_and_left_out():
    rng = np.random.default_rng(1)
    dataset = Dataset("wrong", (run("a", 1e-3, rng), run("b", 2e-3, rng, "a"), run("c", 3e-3, rng)))
    (told,) = false_repeats(dataset)
    assert "a, b cannot be compared as repeats" in told and "repeats:" in told
    assert noise_floor(dataset).source == "residual"


def test_repeats_that_are_too_short_to_be_compared_are_told_of_and_left_out():
    rng = np.random.default_rng(2)
    short = [replace(one, **cut(one, 66)) for one in (run("a", 1e-3, rng), run("b", 1e-3, rng, "a"))]
    dataset = Dataset("short", (*short, run("c", 1e-3, rng)))
    (told,) = false_repeats(dataset)
    assert "a, b cannot be compared as repeats" in told and "66 samples" in told and "measure longer" in told
    assert noise_floor(dataset).source == "residual"


def cut(run: Run, samples: int) -> dict[str, object]:
    """The first samples of a run."""
    return {"time": run.time[:samples], "channels": {key: each[:samples] for key, each in run.channels.items()}}


def test_repeats_of_a_prescribed_force_tell_no_noise_of_it():
    """The force comes again to the last digit, noise included; only the sensors of the motion scatter."""
    rng = np.random.default_rng(3)
    first = run("a", 1e-3, rng)
    moved = first.displacement + 1e-6 * rng.standard_normal(TIME.size)
    again = Run("b", "harmonic", TIME, {"displacement": moved, "force": first.force}, {}, "a", "a")
    floor = noise_floor(Dataset("prescribed", (first, again)))
    assert floor.source == "residual" and 0.5 * NOISE < floor.value < 1.5 * NOISE

"""Runs that move a thousandfold from what their settings say."""

from dataclasses import replace

import numpy as np
import pytest

from dashpot.data.run import Run
from dashpot.triage.declared import moved_otherwise

TIME = 1e-3 * np.arange(8000)


def sine(amplitude=2e-3, frequency=5.0, preload=0.0, **settings):
    """A sine in m about a preload, reached in 0.8 s from zero."""
    x = preload * np.minimum(TIME / 0.8, 1.0) + amplitude * np.sin(2.0 * np.pi * frequency * TIME)
    return Run("a", "harmonic", TIME, {"displacement": x, "force": 1e5 * x}, settings)


@pytest.mark.parametrize("preload", [0.0, 0.1])
def test_runs_as_they_were_set_are_not_remarked_on(preload):
    run = sine(preload=preload, amplitude=2e-3)
    assert moved_otherwise([replace(run, settings={"amplitude": 2e-3, "frequency": 5.0, "stop": 20.0})]) == []


@pytest.mark.parametrize("kind", ["hold", "transient"])
def test_of_a_step_the_way_is_the_motion(kind):
    """It ends at its median, behind which nothing moves."""
    x = 6e-3 * np.clip((TIME - 0.5) / 0.05, 0.0, 1.0) + 1e-6 * np.random.default_rng(1).standard_normal(TIME.size)
    step = Run("a", kind, TIME, {"displacement": x, "force": 1e5 * x}, {"amplitude": 6e-3})
    assert moved_otherwise([step]) == []


def test_millimetres_told_as_metres_are_remarked_on_once():
    runs = [replace(sine(amplitude=2.0), name=f"r{k}", settings={"amplitude": 2e-3}) for k in range(5)]
    (said,) = moved_otherwise(runs)
    assert said.startswith(
        "Run 'r0' (and 4 of 4 others) moves otherwise than declared: with 2000 mm where its setting "
    )
    assert said.endswith("'amplitude' is 2 mm; check the unit of its displacement")


def test_milliseconds_told_as_seconds_are_remarked_on():
    slow = replace(sine(), time=1e3 * TIME, settings={"frequency": 5.0})
    (said,) = moved_otherwise([slow])
    assert "'frequency' is 5 Hz; check the unit of its time" in said

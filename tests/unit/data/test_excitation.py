"""What a run does to a specimen, made once for each run and gone with it."""

import gc
import weakref

import numpy as np
import pytest

from dashpot.data.excitation import Excitation
from dashpot.data.run import Run

STEP = 1e-3
TIME = STEP * np.arange(500)


def run_of(amplitude):
    """A run of a sine of 5 Hz."""
    x = amplitude * np.sin(10.0 * np.pi * TIME)
    return Run("a", "harmonic", TIME, {"displacement": x, "force": 2e5 * x})


def test_the_motions_of_a_run_are_made_once():
    run, other = run_of(1e-3), run_of(2e-3)
    found = Excitation.of_run(run)
    assert Excitation.of_run(run) is found
    speed = 2e-3 * 10.0 * np.pi * np.cos(10.0 * np.pi * TIME)
    assert Excitation.of_run(other).motions[""].velocity == pytest.approx(speed, abs=1e-6)


def test_they_go_with_the_run():
    run = run_of(1e-3)
    kept = weakref.ref(Excitation.of_run(run))
    del run
    gc.collect()
    assert kept() is None

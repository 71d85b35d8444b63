"""A cause that no held-out run shows is judged by runs that do, in turns."""

import numpy as np
import pytest
from unit.assess.rig import REGISTRY, fitted, sweep

from dashpot.assess.contest import Bench, try_finding
from dashpot.assess.suspicion import look_at
from dashpot.assess.turns import gain_in_turns, runs_that_show
from dashpot.data.dataset import Dataset
from dashpot.fit.api import prepare

SPRING = """\
format: dashpot-network/1
name: spring
branches:
  stiffness: {element: spring, stiffness: 200 N/mm}
  damping: {element: damper, damping: {start: 200 N*s/m}}
"""
FAR = ("far", "far_too")


@pytest.fixture
def rng():
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print(f"seed {seed}")
    return np.random.default_rng(seed)


def stopped(x, v):
    """A spring and a damper that meet a buffer of 20 N/mm beyond 18 mm."""
    return 200e3 * x + 250.0 * v + 20e3 * np.maximum(x - 18e-3, 0.0)


def bench_with_a_stop(rng):
    places = {"near": (4e-3, 10e-3), "small": (2e-3, 8e-3), "far": (6e-3, 16e-3), "far_too": (5e-3, 17e-3)}
    runs = [sweep(name, a, p, rng, stopped) for name, (a, p) in places.items()]
    judge = sweep("judge", 3e-3, 10e-3, rng, stopped, held_out=True)
    setting = prepare(Dataset("made", (*runs, judge)))
    return Bench(setting.train, REGISTRY.elements, {}, unseen=setting.held_out)


def test_runs_that_reach_a_stop_judge_it_in_turns(rng):
    bench = bench_with_a_stop(rng)
    look = look_at(bench, fitted(bench, SPRING), [REGISTRY.causes["end_stop"]], None, 0)
    trial = try_finding(bench, look.model, look.screen.best, look.noise, look.screen.samples)
    shown = runs_that_show(look.model, trial.model, bench)
    assert set(shown[:2]) == set(FAR)
    gain = gain_in_turns(bench, look.model, trial.model, FAR, {}, 0)
    assert gain.value > 0.1
    assert gain.interval[0] > 0.0
    together = dict.fromkeys(FAR, "far")
    assert gain_in_turns(bench, look.model, trial.model, FAR, together, 0) is None

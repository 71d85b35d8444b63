"""A cause that no held-out run shows is judged by runs that do, in turns."""

from unit.assess.rig import REGISTRY, STOPPED_AT, fitted, stopped, sweep

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


def bench_with_a_stop(rng):
    runs = [sweep(name, a, p, rng, stopped) for name, (a, p) in STOPPED_AT.items()]
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

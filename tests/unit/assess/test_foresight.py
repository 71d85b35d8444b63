"""What a finding is said to be worth on unseen runs, before the refit, against what the refit gains there."""

import pytest
from unit.assess.rig import REGISTRY, STOPPED_AT, fitted, stopped, sweep

from dashpot.assess.contest import Bench, try_finding
from dashpot.assess.foresight import foreseen_gain
from dashpot.assess.gain import measure_gain
from dashpot.assess.misfits import misfits_of
from dashpot.assess.suspicion import expected_gain, look_at
from dashpot.data.dataset import Dataset
from dashpot.fit.api import prepare

SPRING = """\
format: dashpot-network/1
name: spring
branches:
  stiffness: {element: spring, stiffness: 200 N/mm}
  damping: {element: damper, damping: {start: 200 N*s/m}}
"""


def foreseen_and_realised(rng, judge):
    """By the best finding of a look, and by the model that was refitted with it."""
    runs = [sweep(name, a, p, rng, stopped) for name, (a, p) in STOPPED_AT.items()]
    setting = prepare(Dataset("made", (*runs, sweep("judge", *judge, rng, stopped, held_out=True))))
    bench = Bench(setting.train, REGISTRY.elements, {}, unseen=setting.held_out)
    look = look_at(bench, fitted(bench, SPRING), [REGISTRY.causes["end_stop"]], None, 0)
    finding = look.screen.best
    trial = try_finding(bench, look.model, finding, look.noise, look.screen.samples)
    before, after = (misfits_of(model, setting.held_out) for model in (look.model, trial.model))
    realised = measure_gain(before, after, [run.drive.dt for run in setting.held_out]).value
    return foreseen_gain(bench, setting.held_out, finding, look), realised, expected_gain(look.columns, finding)


def test_the_gain_on_an_unseen_run_that_meets_the_stop_is_foreseen(rng):
    foreseen, realised, _ = foreseen_and_realised(rng, (5.5e-3, 16.5e-3))
    assert realised > 0.3
    assert foreseen == pytest.approx(realised, abs=0.15)


def test_nothing_is_foreseen_on_an_unseen_run_that_keeps_away_from_the_stop(rng):
    foreseen, realised, on_training = foreseen_and_realised(rng, (3e-3, 10e-3))
    assert on_training > 0.3
    assert foreseen == pytest.approx(realised, abs=0.05)


def test_without_unseen_runs_the_training_runs_are_foreseen(rng):
    runs = [sweep(name, 5e-3, p, rng, stopped) for name, p in (("a", 10e-3), ("b", 16e-3))]
    bench = Bench(prepare(Dataset("made", tuple(runs))).train, REGISTRY.elements, {})
    look = look_at(bench, fitted(bench, SPRING), [REGISTRY.causes["end_stop"]], None, 0)
    finding = look.screen.best
    assert foreseen_gain(bench, (), finding, look) == expected_gain(look.columns, finding)


def test_beside_sensors_that_may_err_the_training_runs_are_foreseen(rng):
    runs = [sweep(name, 5e-3, p, rng, stopped, name == "c") for name, p in (("a", 10e-3), ("b", 16e-3), ("c", 15e-3))]
    setting = prepare(Dataset("made", tuple(runs)))
    sheet = {run.name: {"zero": 1.0} for run in (*setting.train, *setting.held_out)}
    forces = {run.name: 200e3 * run.drive.displacement for run in setting.train}
    bench = Bench(setting.train, REGISTRY.elements, sheet, unseen=setting.held_out, forces=forces)
    look = look_at(bench, fitted(bench, SPRING), [REGISTRY.causes["end_stop"]], None, 0)
    finding = look.screen.best
    assert foreseen_gain(bench, setting.held_out, finding, look) == expected_gain(look.columns, finding)

"""The explainable error on runs whose law is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.compare.specimens import DT, NOISE, SAMPLES, slide, sweeps, with_forces, with_friction

from dashpot.compare import boosting
from dashpot.compare.explainable import explainable_error
from dashpot.compare.motion import relaxing, stops
from dashpot.data.dataset import Dataset
from dashpot.fit.api import prepare


@pytest.fixture(autouse=True)
def _ridge_only(monkeypatch):
    # whether scikit-learn is installed must not decide these tests
    monkeypatch.setattr(boosting, "find_spec", lambda name: None)


def test_a_stop_is_a_slider_integrated_sample_by_sample():
    rng = np.random.default_rng(1)
    path = np.cumsum(rng.standard_normal(2000)) * 1e-4
    yields = np.array([2e-4, 1e-3])
    expected = np.column_stack([slide(path, limit=travel, travel=travel) for travel in yields])
    assert stops(path, yields) == pytest.approx(expected, abs=1e-15)


def test_a_relaxing_state_follows_the_closed_form_on_a_ramp():
    speed, time = 0.02, 0.3
    at = DT * np.arange(1000)
    steps = np.full(at.size, speed * DT)
    steps[0] = 0.0
    assert relaxing(steps, DT, time) == pytest.approx(speed * time * (1.0 - np.exp(-at / time)), rel=1e-12)


def test_a_damper_with_friction_is_explained_down_to_its_noise():
    told = explainable_error(prepare(sweeps()))
    assert told.by == "ridge"
    assert 0.9 * NOISE < told.held_out < 1.3 * NOISE
    assert told.held_out == told.unseen
    assert set(told.per_run) == {run.name for run in sweeps().runs}


def test_what_no_motion_tells_is_not_explained():
    noise = sweeps(lambda x, settings: np.zeros(x.size), noise=50.0)
    told = explainable_error(prepare(noise))
    assert 48.0 < told.held_out < 54.0
    assert told.train > 45.0


def test_held_out_runs_take_no_part():
    dataset = sweeps()
    setting = prepare(dataset)
    rng = np.random.default_rng(5)
    others = {name: 1e3 * rng.standard_normal(SAMPLES) for name in setting.split.held_out}
    first, second = explainable_error(setting), explainable_error(prepare(with_forces(dataset, others)))
    assert (second.train, second.cross_validated, second.by) == (first.train, first.cross_validated, first.by)
    assert second.held_out > 10.0 * first.held_out


def test_the_same_runs_and_seed_give_the_same_numbers():
    assert explainable_error(prepare(sweeps()), 4) == explainable_error(prepare(sweeps()), 4)


def test_a_setting_explains_what_the_motion_does_not():
    pressures = (0.0, 2.0, 5.0)
    dataset = sweeps(pressures=pressures)
    silent = Dataset(
        "silent",
        tuple(
            replace(run, settings={name: value for name, value in run.settings.items() if name != "pressure"})
            for run in dataset.runs
        ),
    )
    known, unknown = (explainable_error(prepare(each)) for each in (dataset, silent))
    assert known.held_out < 3.0 * NOISE
    assert unknown.held_out > 3.0 * known.held_out


def test_a_second_force_tells_its_level_and_not_its_course():
    """A normal force sets a friction as a setting does; a second load cell would answer in place of the model."""
    dataset = sweeps(pressures=(0.0, 2.0, 5.0))
    rng = np.random.default_rng(3)

    def beside(signal_of):
        runs = [
            replace(run, settings={}, channels={**run.channels, "normal_force": signal_of(run)}) for run in dataset.runs
        ]
        return explainable_error(prepare(Dataset("beside", tuple(runs))))

    level = beside(lambda run: 40.0 * (1.0 + run.settings["pressure"]) + rng.normal(0.0, 2.0, run.force.size))
    course = beside(lambda run: run.force - np.mean(run.force) + 40.0)
    assert level.held_out < 3.0 * NOISE
    assert course.held_out > 3.0 * level.held_out


def test_without_held_out_runs_training_runs_are_left_out_in_turn():
    runs = tuple(replace(run, held_out=False) for run in sweeps().runs)
    told = explainable_error(prepare(Dataset("all", runs)))
    assert told.held_out is None
    assert told.unseen == told.cross_validated
    assert NOISE < told.cross_validated < 3.0 * NOISE
    assert told.train < told.left_out < told.cross_validated


def test_a_single_run_says_how_little_it_tells():
    told = explainable_error(prepare(Dataset("one", sweeps().runs[:1])))
    assert "Only 1 independent training run:" in told.remarks[0]
    assert told.as_dict()["held_out"] is None


def test_several_driven_nodes_have_a_reason_instead_of_numbers():
    run = sweeps().runs[0]
    x, force = run.displacement, run.force
    channels = {
        f"{what}@{node}": values
        for node in ("left", "right")
        for what, values in (("displacement", x), ("force", force))
    }
    told = explainable_error(prepare(Dataset("axle", (replace(run, channels=channels),))))
    assert (told.train, told.held_out, told.by) == (None, None, None)
    assert "several nodes" in told.reason


def test_trees_add_what_the_columns_lack(monkeypatch):
    pytest.importorskip("sklearn", reason="scikit-learn is not installed (pip install 'dashpot[boosting]')")
    monkeypatch.undo()

    def notched(x, settings):
        fast = np.abs(np.gradient(x, DT)) > 0.05
        return with_friction(x, settings) + 400.0 * (fast & (x > 4.8e-3) & (x < 15.2e-3))

    told = explainable_error(prepare(sweeps(notched)))
    monkeypatch.setattr(boosting, "find_spec", lambda name: None)
    plain = explainable_error(prepare(sweeps(notched)))
    assert (plain.by, told.by) == ("ridge", "boosting")
    assert told.held_out < 0.8 * plain.held_out

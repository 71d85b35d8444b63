"""A look at runs, from the samples to the page."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from unit.compare.specimens import DAMPING, DT, NOISE, STIFFNESS, run, slide, sweep, sweeps

import dashpot as dp
from dashpot.compare import boosting
from dashpot.compare.look import described, look, spectra
from dashpot.compare.strokes import see
from dashpot.data.dataset import Dataset
from dashpot.report.json_text import json_text
from dashpot.report.look import look_figures, look_headline
from dashpot.triage.work import work_of_cycles


@pytest.fixture(autouse=True)
def _ridge_only(monkeypatch):
    monkeypatch.setattr(boosting, "find_spec", lambda name: None)


def with_repeat() -> Dataset:
    """Sweeps, the last of them measured again with other noise."""
    dataset = sweeps()
    last = dataset.runs[-1]
    law = STIFFNESS * last.displacement + DAMPING * np.gradient(last.displacement, DT) + slide(last.displacement)
    force = law + NOISE * np.random.default_rng(9).standard_normal(law.size)
    again = replace(run("again", last.displacement, force, repeats=last.name, order=9), settings=last.settings)
    return Dataset("with a repeat", (*dataset.runs, again))


def test_repeats_tell_the_noise_floor():
    seen = look(with_repeat())
    [group] = seen.repeats()
    assert group["runs"] == ["a3_p15", "again"]
    assert group["rms"] == pytest.approx(NOISE, rel=0.05)
    assert seen.as_dict()["noise_floor"]["value"] == pytest.approx(group["rms"], rel=1e-9)


def test_a_run_with_the_wrong_sign_gives_back_work():
    dataset = sweeps()
    wrong = [
        replace(each, channels={**each.channels, "force": -each.force}) if each.name == "a1_p10" else each
        for each in dataset.runs
    ]
    told = look(Dataset("wrong", tuple(wrong))).as_dict()
    assert [each["run"] for each in told["runs"] if each["gives_back"]] == ["a1_p10"]
    assert [(each["run"], each["kind"]) for each in told["faults"]] == [("a1_p10", "polarity")]
    assert look_headline(told).startswith("Run 'a1_p10': it gives back")


def test_a_run_a_thousand_times_off_is_named_before_any_model():
    dataset = sweeps()
    wrong = [
        replace(each, channels={**each.channels, "force": 1e3 * each.force}) if each.name == "a1_p10" else each
        for each in dataset.runs
    ]
    seen = look(Dataset("wrong", tuple(wrong)))
    assert [(each["run"], each["kind"]) for each in seen.as_dict()["faults"]] == [("a1_p10", "unit")]
    assert "kN written as N" in look_headline(seen.as_dict())
    assert any("'a1_p10'" in warning and "Correct the 'unit'" in warning for warning in seen.evidence()["warnings"])
    assert look(dataset).as_dict()["faults"] == []


def test_the_spectrum_has_the_amplitude_of_a_sine():
    time = DT * np.arange(4000)
    x = 2e-3 * np.sin(2.0 * np.pi * 8.0 * time)
    told = {each["of"]: each for each in spectra(see(run("r", x, STIFFNESS * x, "harmonic")))}
    assert told["force"]["y"].max() == pytest.approx(400.0, rel=1e-3)
    assert told["force"]["x"][told["force"]["y"].argmax()] == pytest.approx(8.0, abs=0.3)


def test_look_json_is_plain_and_the_same_twice():
    first, second = (json_text(look(with_repeat(), 3).as_dict()) for _ in range(2))
    assert first == second
    told = json.loads(first)
    assert told["format"] == "dashpot-look/1"
    assert all(each["energy_per_cycle"] > 0.0 for each in told["runs"])
    assert told["explainable"]["held_out"] < 1.5 * NOISE


@pytest.mark.parametrize(("kind", "seed"), [("random", 1), ("random", 2), ("sweep", 3)])
def test_the_energy_of_a_cycle_is_the_one_that_triage_judges_by(kind, seed):
    """A damper takes up its constant times the squared velocity over the time, in cycles about the middle."""
    noise = np.random.default_rng(seed).standard_normal(12_000)
    smooth = np.hanning(80) / np.hanning(80).sum()
    x = 4e-3 * np.convolve(np.convolve(noise, smooth, "same"), smooth, "same") if kind == "random" else sweep(2e-3, 0.0)
    v = np.gradient(x, DT)
    made = run("r", x, STIFFNESS * x + DAMPING * v, kind)
    told = described(see(made), False)
    assert told["energy_per_cycle"] == pytest.approx(work_of_cycles(made).mean)
    assert told["energy_per_cycle"] * told["cycles"] == pytest.approx(DAMPING * DT * np.sum(v**2), rel=0.1)


def test_every_picture_is_drawn():
    titles = [figure.title for figure in look_figures(look(with_repeat()).evidence())]
    assert titles == [
        "Force over displacement and velocity",
        "Force over velocity at mid stroke",
        "Force over deflection at low speed",
        "Force minus a linear spring",
        "Stiffness after reversals",
        "By amplitude, preload, setting and order",
        "Loss stiffness over time",
        "Amplitude spectrum of the force",
        "Amplitude spectrum of the displacement",
        "Repeats against each other",
    ]


def test_a_slow_run_alone_can_be_looked_at():
    x = 5e-3 * (1.0 - np.abs(np.linspace(-1.0, 1.0, 2001)))
    seen = look(Dataset("slow", (run("qs", x, STIFFNESS * x + slide(x), "quasi_static"),)))
    assert seen.as_dict()["runs"][0]["cycles"] == 1
    assert len(look_figures(seen.evidence())) >= 6


def test_a_random_motion_can_be_looked_at():
    x = 1e-3 * np.convolve(np.random.default_rng(4).standard_normal(4000), np.hanning(60), "same") / 5.0
    seen = look(Dataset("random", (run("noise", x, STIFFNESS * x + slide(x), "random"),)))
    assert not seen.as_dict()["runs"][0]["gives_back"]
    assert sweep(1e-3, 0.0).size and len(look_figures(seen.evidence())) >= 6


@pytest.mark.parametrize(("duration", "samples"), [(20.0, 10_000), (200.0, 10_000)])
def test_a_force_that_is_explained_to_the_last_digit_leaves_a_number(duration, samples):
    time = np.linspace(0.0, duration, samples)
    x = 2e-3 * np.sin(2.0 * np.pi * time / 5.0)
    told = dp.look(dp.Data.from_arrays(time, x, 3e5 * x, name="spring")).as_dict()["explainable"]
    assert 0.0 <= told["left_out"] < 0.01

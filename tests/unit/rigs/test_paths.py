"""The motions of the built-in procedures: where they go, and rates that are those of the displacement."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from dashpot import load_registry
from dashpot.contract.rig import PORT

RIGS = load_registry().rigs


def rates_of(path, dt):
    """Velocity and acceleration by an interpolating spline of degree seven."""
    spline = make_interp_spline(dt * np.arange(path.displacement.size), path.displacement, k=7)
    time = dt * np.arange(path.displacement.size)
    return spline(time, 1), spline(time, 2)


@pytest.mark.parametrize("spacing", ["linear", "log"])
def test_the_rates_of_a_sweep_are_those_of_its_displacement(spacing):
    rig = RIGS["hydropulser"](amplitudes=(2e-3,), preloads=(1e-2,), duration=4.0, spacing=spacing, sampling=2000.0)
    for run in rig.runs():
        path = run.motion[PORT]
        velocity, acceleration = rates_of(path, run.sample_time)
        inner = slice(20, -20)
        assert path.velocity[inner] == pytest.approx(velocity[inner], abs=1e-8 * np.ptp(velocity))
        assert path.acceleration[inner] == pytest.approx(acceleration[inner], abs=1e-5 * np.ptp(acceleration))


@pytest.mark.parametrize("direction, first, last", [("up", 2.0, 16.0), ("down", 16.0, 2.0)])
@pytest.mark.parametrize("spacing", ["linear", "log"])
def test_a_sweep_begins_and_ends_at_its_frequencies(spacing, direction, first, last):
    rig = RIGS["hydropulser"](start=2.0, stop=16.0, spacing=spacing, direction=direction, duration=8.0)
    run = rig.runs()[0]
    path = run.motion[PORT]
    # at a turn of a sine of constant amplitude acceleration over deflection is the square of the angular frequency
    swing = path.displacement - run.settings["preload"]
    top = (np.abs(swing) > 0.99 * run.settings["amplitude"]) & (run.time > 0.5)
    frequency = np.sqrt(-path.acceleration[top] / swing[top]) / (2.0 * np.pi)
    share = run.time[top] / 8.0
    expected = first + (last - first) * share if spacing == "linear" else first * (last / first) ** share
    assert share[0] < 0.15 and share[-1] > 0.93
    assert frequency == pytest.approx(expected, rel=0.02)
    assert [run.settings["start"], run.settings["stop"]] == [first, last]


def test_the_middle_of_a_logarithmic_sweep_is_the_geometric_mean():
    rig = RIGS["hydropulser"](start=1.0, stop=16.0, spacing="log", direction="up", duration=60.0)
    phase, turn, _ = rig.sweeps["up"].turning()
    assert turn[turn.size // 2] == pytest.approx(2.0 * np.pi * 4.0, rel=1e-3)
    # the cycles of an exponential of frequency: duration (stop - start) / ln(stop / start)
    assert phase[-1] / (2.0 * np.pi) == pytest.approx(60.0 * 15.0 / np.log(16.0), rel=1e-12)


def test_every_amplitude_meets_every_preload_in_both_directions():
    runs = RIGS["hydropulser"](amplitudes=(1e-3, 3e-3), preloads=(0.01, 0.02, 0.03)).runs()
    assert len({run.name for run in runs}) == 12
    for run in runs:
        away = np.abs(run.motion[PORT].displacement - run.settings["preload"]).max()
        assert away == pytest.approx(run.settings["amplitude"], rel=1e-3)


def test_the_triangle_runs_at_its_speed_between_its_ends():
    [run] = RIGS["triangle"](depth=5e-3, speed=2e-3, loops=2, corner=0.1, sampling=5000.0).runs()
    path = run.motion[PORT]
    assert path.displacement.min() == pytest.approx(0.0, abs=1e-9)
    assert path.displacement.max() == pytest.approx(5e-3, abs=1e-9)
    assert path.displacement[-1] == pytest.approx(0.0, abs=1e-7)
    assert np.abs(path.velocity).max() == pytest.approx(2e-3)
    # a climb at full speed, and a quarter of two corners more
    assert run.time[-1] == pytest.approx(4.0 * (5e-3 / 2e-3 + 0.75 * 0.1), abs=2e-3)
    travelled = np.concatenate([[0.0], np.cumsum(0.5 * 2e-4 * (path.velocity[1:] + path.velocity[:-1]))])
    assert path.displacement == pytest.approx(travelled, abs=2e-9)
    sped = np.concatenate([[0.0], np.cumsum(0.5 * 2e-4 * (path.acceleration[1:] + path.acceleration[:-1]))])
    assert path.velocity == pytest.approx(sped, abs=1e-6)


def test_the_wheels_of_an_axle_move_alike_or_against_each_other():
    runs = {run.name: run for run in RIGS["axle_sweep"](duration=2.0, added_masses=(0.0, 7.5)).runs()}
    assert set(runs) == {"in_phase_m0", "anti_phase_m0", "in_phase_m7p5", "anti_phase_m7p5"}
    for name, run in runs.items():
        left, right = run.motion["platform_left"], run.motion["platform_right"]
        sign = 1.0 if run.notes["phase"] == "in_phase" else -1.0
        for rate in ("displacement", "velocity", "acceleration"):
            assert getattr(right, rate) == pytest.approx(sign * getattr(left, rate), abs=0.0)
        assert run.settings["added_mass"] == (7.5 if name.endswith("7p5") else 0.0)
        assert np.abs(left.displacement).max() == pytest.approx(3e-3, rel=1e-3)


@pytest.mark.parametrize(
    "word, options, said",
    [
        ("hydropulser", {"spacing": "even"}, "linear or log"),
        ("hydropulser", {"direction": "left"}, "up, down or both"),
        ("hydropulser", {"stop": 100.0}, "20 samples a cycle"),
        ("hydropulser", {"start": 0.0}, "more than 0"),
        ("hydropulser", {"amplitudes": (0.0,)}, "amplitudes"),
        ("triangle", {"loops": 0}, "more than 0"),
        ("triangle", {"corner": 31.0}, "at most the 30 s"),
        ("axle_sweep", {"phases": "out"}, "in_phase, anti_phase or both"),
        ("axle_sweep", {"left": "a", "right": "a"}, "two different nodes"),
    ],
)
def test_an_impossible_procedure_is_refused(word, options, said):
    with pytest.raises(ValueError, match=said):
        RIGS[word](**options)

"""Shapes of forces whose law is written down here."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.compare.specimens import DT, run, slide, sweep

from dashpot.compare.residual_map import residual_maps
from dashpot.compare.shapes import after_reversals, conditions_of, less_spring, low_speed, mid_stroke, shapes_of
from dashpot.compare.strokes import see, work
from dashpot.report.figures.conditions import over_conditions

STIFFNESS, DAMPING = 200e3, 900.0
TIME = DT * np.arange(6000)


def sine(amplitude: float, frequency: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacement and velocity (n,)."""
    omega = 2.0 * np.pi * frequency
    return amplitude * np.sin(omega * TIME), amplitude * omega * np.cos(omega * TIME)


def test_a_cycle_of_a_viscous_damper_takes_up_pi_c_omega_amplitude_squared():
    amplitude, frequency = 2e-3, 3.0
    x, v = sine(amplitude, frequency)
    values = see(run("r", x, STIFFNESS * x + DAMPING * v, "harmonic")).cycle_values["measured"]
    expected = np.pi * DAMPING * 2.0 * np.pi * frequency * amplitude**2
    assert values.energy == pytest.approx(np.full(values.energy.size, expected), rel=2e-3)
    assert values.stiffness == pytest.approx(np.full(values.energy.size, STIFFNESS), rel=2e-3)
    assert values.loss == pytest.approx(np.full(values.energy.size, DAMPING * 2.0 * np.pi * frequency), rel=2e-3)
    assert values.time.size >= 15


def test_an_ideal_slider_takes_up_four_limits_times_the_slid_way():
    amplitude, limit, travel = 2e-3, 50.0, 0.2e-3
    x, _ = sine(amplitude, 2.0)
    values = see(run("r", x, slide(x, limit, travel), "harmonic")).cycle_values["measured"]
    assert values.energy == pytest.approx(np.full(values.energy.size, 4.0 * limit * (amplitude - travel)), rel=2e-3)


def test_a_single_slow_loop_counts_as_a_cycle():
    x = 5e-3 * (1.0 - np.abs(np.linspace(-1.0, 1.0, 2001)))
    values = see(run("qs", x, slide(x, 40.0, 0.1e-3), "quasi_static")).cycle_values["measured"]
    assert values.time.size == 1
    assert values.energy[0] > 0.0


def test_the_work_of_an_open_path_is_closed_by_a_straight_line():
    x = np.linspace(0.0, 1e-3, 50)
    assert work(x, STIFFNESS * x) == pytest.approx(0.0, abs=1e-12)


def test_force_at_mid_stroke_is_damping_and_friction_without_the_spring():
    x = sweep(3e-3, 8e-3)
    v = np.gradient(x, DT)
    seen = see(run("r", x, STIFFNESS * x + DAMPING * v + slide(x, 60.0, 0.1e-3)))
    [curve] = mid_stroke(seen)
    expected = DAMPING * curve["x"] + 60.0 * np.sign(curve["x"])
    assert curve["x"].size > 40
    # the middle of a stroke is found to a sample, in which a fast stroke travels a little
    assert curve["y"] == pytest.approx(expected, abs=12.0)


def test_the_low_speed_loop_has_the_width_of_the_friction():
    x = 5e-3 * (1.0 - np.abs(np.linspace(-1.0, 1.0, 4001)))
    [curve] = less_spring(low_speed(see(run("qs", x, STIFFNESS * x + slide(x, 40.0, 0.1e-3), "quasi_static"))))
    gap = int(np.flatnonzero(np.isnan(curve["x"]))[0])
    middle = slice(gap // 4, 3 * gap // 4)
    width = curve["y"][:gap][middle] - curve["y"][gap + 1 :][middle]
    assert width == pytest.approx(np.full(width.size, 80.0), rel=0.02)


def test_stiffness_after_reversals_falls_from_both_springs_to_one():
    limit, travel = 40.0, 0.4e-3
    x, _ = sine(4e-3, 1.0)
    [curve] = after_reversals(see(run("r", x, STIFFNESS * x + slide(x, limit, travel), "harmonic")))
    expected = STIFFNESS + np.minimum(limit / travel, 2.0 * limit / curve["x"])
    assert curve["y"] == pytest.approx(expected, rel=0.01)


def test_conditions_have_the_settings_and_the_order():
    x, v = sine(1e-3, 4.0)
    [row] = conditions_of(see(run("r", x, DAMPING * v, "harmonic", order=6, pressure=2e5, amplitude=1e-3)))
    assert row["conditions"] == {
        "amplitude": pytest.approx(1e-3, rel=1e-3),
        "preload": pytest.approx(0.0, abs=1e-6),
        "pressure": 2e5,
        "order of tests": 7.0,
    }


def shown(amplitudes, **settings):
    """The conditions of sines of some amplitudes, as the report gets them."""
    runs = []
    for k, amplitude in enumerate(amplitudes):
        x, _ = sine(amplitude, 4.0)
        told = {key: each[k] for key, each in settings.items()}
        runs.append(run(f"r{k}", 10e-3 + x, STIFFNESS * x, "harmonic", order=k, **told))
    return shapes_of(runs)["conditions"]


def test_amplitudes_that_a_rig_does_not_tell_apart_are_one_condition():
    """Three of each, by up to 1.7 % apart: two levels, not six, and none where all are of one."""
    rows = shown([1.000e-3, 1.009e-3, 1.017e-3, 2.00e-3, 2.015e-3, 2.034e-3])
    found = [row["conditions"]["amplitude"] for row in rows]
    assert found == pytest.approx([1.009e-3] * 3 + [2.015e-3] * 3, rel=1e-3)
    assert len(set(found)) == 2
    (panel,) = panels(shown([1.000e-3, 1.009e-3, 1.017e-3]))
    assert panel == "order of tests"
    assert panels(rows) == ["amplitude (mm)", "order of tests"]
    assert panels(shown([1e-3] * 3, frequency=(1.0, 2.0, 3.0))) == ["frequency (Hz)", "order of tests"]


def test_levels_that_are_farther_apart_stay_as_they_are():
    rows = shown([1.00e-3, 1.05e-3, 1.10e-3], pressure=(2.0e5, 2.02e5, 2.5e5))
    assert [row["conditions"]["amplitude"] for row in rows] == pytest.approx([1.00e-3, 1.05e-3, 1.10e-3], rel=1e-3)
    assert [row["conditions"]["pressure"] for row in rows] == [2.0e5, 2.0e5, 2.5e5]


def panels(rows):
    figure = over_conditions(rows)
    axes = figure.plot["layout"]
    return [axes[key]["title"]["text"] for key in axes if key.startswith("xaxis") and axes[key]["title"]["text"]]


def test_the_residual_is_shown_over_the_variables_that_made_it():
    runs = [run(f"r{k}", sweep(2e-3, 0.0), np.zeros(3000), order=k, pressure=float(k % 3)) for k in range(6)]
    rng = np.random.default_rng(2)
    seen = []
    for each in runs:
        v = np.gradient(each.displacement, DT)
        missing = 300.0 * np.tanh(v / 0.05) * each.settings["pressure"] + 5.0 * rng.standard_normal(v.size)
        seen.append(
            see(
                run(each.name, each.displacement, missing, order=each.order, **each.settings),
                {"model": {each.name: np.zeros(v.size)}},
            )
        )
    [told] = residual_maps(seen)
    assert {told["x"]["name"], told["y"]["name"]} == {"velocity", "pressure"}
    assert told["explained"] > 0.95
    assert max(told["singles"], key=told["singles"].get) == "velocity"


def test_a_force_that_is_too_small_at_one_setting_is_shown_over_the_simulated_force():
    rng = np.random.default_rng(2)
    seen = []
    for k in range(6):
        x, pressure = sweep(2e-3, 0.0), float(k % 3)
        force = STIFFNESS * x + slide(x, 100.0)
        measured = (1.0 + 0.1 * pressure) * force + 2.0 * rng.standard_normal(x.size)
        seen.append(see(run(f"r{k}", x, measured, order=k, pressure=pressure), {"model": {f"r{k}": force}}))
    [told] = residual_maps(seen)
    assert {told["x"]["name"], told["y"]["name"]} == {"simulated force", "pressure"}
    assert told["explained"] > 0.95


def test_missing_hysteresis_is_shown_over_the_travel_since_the_reversal():
    rng = np.random.default_rng(2)
    seen = []
    for k, amplitude in enumerate((1e-3, 2e-3, 4e-3)):
        x = sweep(amplitude, 0.0)
        force = STIFFNESS * x
        measured = force + slide(x, 100.0, 1.5e-3) + 2.0 * rng.standard_normal(x.size)
        seen.append(see(run(f"r{k}", x, measured, order=k), {"model": {f"r{k}": force}}))
    [told] = residual_maps(seen)
    assert "travel since reversal" in {told["x"]["name"], told["y"]["name"]}
    assert told["explained"] > 0.9


def varied(key, values, unit="", preload=0.0):
    """The variables over which the residual of runs with one amplitude may be shown that have a setting alone."""
    rng = np.random.default_rng(4)
    seen = []
    for k, value in enumerate(values):
        x = sweep(2e-3 * (value if key == "amplitude" else 1.0), value if key == "preload" else preload)
        settings = {} if key in ("amplitude", "preload") else {key: value}
        made = replace(run(f"r{k}", x, rng.standard_normal(x.size), order=k, **settings), units={key: unit})
        seen.append(see(made, {"model": {made.name: np.zeros(x.size)}}))
    return residual_maps(seen)[0]["singles"]


@pytest.mark.parametrize(
    ("key", "alike", "apart", "unit"),
    [
        ("amplitude", (1.0, 1.015), (1.0, 1.04), "m"),
        ("preload", (0.0, 0.05e-3), (0.0, 0.2e-3), "m"),
        ("pressure", (3.0e5, 3.04e5), (3.0e5, 3.2e5), "bar"),
        ("temperature", (293.15, 293.15), (293.15, 298.15), "degC"),
    ],
)
def test_a_condition_that_a_rig_repeats_is_no_variable(key, alike, apart, unit):
    assert key not in varied(key, alike, unit)
    assert key in varied(key, apart, unit)


def test_a_small_motion_about_a_large_preload_is_a_variable():
    assert {"deflection", "place of the last reversal"} <= set(varied("pressure", (1.0, 2.0), preload=0.5))


@pytest.mark.parametrize(
    ("key", "values", "unit", "edges"),
    [
        ("frequency", (2.0, 4.0), "Hz", (1.0, 3.0, 5.0)),
        ("temperature", (293.15, 303.15), "degC", (15.0, 25.0, 35.0)),
        ("pressure", (2e5, 4e5), "bar", (1.0, 3.0, 5.0)),
        ("grade", (1.0, 3.0), "", (0.0, 2.0, 4.0)),
    ],
)
def test_a_setting_is_told_in_the_unit_of_its_file(key, values, unit, edges):
    """The edges of two levels are in the middle of them and as far beyond; of 30 runs the order tells less."""
    seen = []
    for k, value in enumerate(values * 15):
        x = sweep(2e-3, 0.0)
        told = {key: unit} if key != "frequency" else {}
        made = replace(run(f"r{k}", x, (k % 2) * x / 2e-3, order=k, **{key: value}), units=told)
        seen.append(see(made, {"model": {made.name: np.zeros(x.size)}}))
    [told] = residual_maps(seen)
    axis = next(told[which] for which in ("x", "y") if told[which]["name"] == key)
    assert axis["unit"] == unit and axis["edges"] == pytest.approx(edges)


def test_held_out_runs_take_no_part_in_the_map():
    """They are wrong by far more; of the others the residual follows the velocity alone."""
    runs, forces = [], {}
    for k in range(6):
        x = sweep((1.0 + k) * 1e-3, 0.0)
        missing = 100.0 * np.sign(np.gradient(x, DT)) if k < 4 else np.full(x.size, 2000.0 * (k - 4.5))
        runs.append(run(f"r{k}", x, missing, order=k))
        forces[f"r{k}"] = np.zeros(x.size)
    [told] = shapes_of(runs, {"model": forces}, ("r4", "r5"))["residual_maps"]
    assert max(told["singles"], key=told["singles"].get) in ("velocity", "travel since reversal")
    assert np.nanmax(np.abs(told["mean"])) == pytest.approx(100.0, rel=1e-6)


def test_noise_is_explained_by_nothing():
    rng = np.random.default_rng(3)
    x = sweep(2e-3, 0.0)
    seen = [
        see(run(f"r{k}", x, rng.standard_normal(x.size), order=k), {"model": {f"r{k}": np.zeros(x.size)}})
        for k in range(4)
    ]
    [told] = residual_maps(seen)
    assert told["explained"] < 0.03


def test_simulated_forces_go_through_the_same_evaluation():
    x = sweep(2e-3, 5e-3)
    force = STIFFNESS * x + DAMPING * np.gradient(x, DT)
    shapes = shapes_of([run("r", x, force)], {"model": {"r": force}})
    for way in ("mid_stroke", "low_speed", "less_spring", "after_reversals", "cycles"):
        measured, simulated = shapes[way]
        assert (measured["label"], simulated["label"]) == ("measured", "model")
        assert np.array_equal(measured["y"], simulated["y"], equal_nan=True)

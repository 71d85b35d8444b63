"""Figures show SI data in rig units, few enough points for a page, and nothing that was not measured."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from unit.report.report_samples import evidence, friction, model, relaxation

from dashpot.report import figures
from dashpot.report.figures import excerpt
from dashpot.report.parts import Figure
from dashpot.report.plot_json import column_json, compact, plot_json, plotly_figure
from dashpot.report.theme import DARK, LIGHT

EVIDENCE = evidence()
HOSTILE = "</script><img src=x onerror=alert(1)><b>%{x}"


def signals(time: np.ndarray, displacement: np.ndarray, force: np.ndarray) -> dict[str, np.ndarray]:
    velocity = np.gradient(displacement, time)
    return {"time": time, "displacement": displacement, "velocity": velocity, "force": force}


def every_figure(run: str = "run 1", label: str = "before") -> list[Figure]:
    time = np.linspace(0.0, 1.0, 50)
    response = {"stiffness": np.array([2e5, 3e5]), "loss_angle": np.array([0.1, np.pi / 4])}
    curve = {"run": run, "frequency": np.array([1.0, 2.0]), "measured": response, "simulated": {label: response}}
    return [
        figures.loops({run: signals(time, 1e-3 * time, time)}, {label: {run: time}}),
        figures.dynamic_stiffness([curve | {"amplitude": 1e-3, "preload": 0.01}, curve]),
        figures.steady_stiffness([steady(run, 1e-3, 2.0, label), steady(run, 2e-3, 2.0, label)]),
        figures.residual_traces({run: time}, {label: {run: time}}),
        figures.harmonic_bars({label: {run: [3.0, 2.0, 1.0]}}),
        figures.misfit_map([{"run": run, "band": (1.0, 3.0), "rmse": {label: 5.0}}]),
        figures.rmse_bars([{"name": label, "train": 4.0, "held_out": None}], 1.0),
        figures.gain_intervals([friction(title=label), relaxation(gain=None, gain_interval=None)]),
        figures.convergence_history({label: {"evaluations": [1, 2], "best": [9.0, 3.0]}}),
        figures.contact_response([contact(run, label, 0.0), contact(run, label, 5.0)]),
        figures.contact_models([contact(run, label, 0.0), contact(run, label, 5.0)]),
        figures.velocity_curves({label: DAMPER}, {run: DAMPER}),
        figures.slow_curves({"measured": SLOW, label: SLOW}),
    ]


DAMPER = {
    "curve": "a.b",
    "velocity": [-1.0, -0.5, 0.0, 0.5],
    "force": [-90.0, -50.0, 0.0, 40.0],
    "low": [-99.0, -55.0, 0.0, 38.0],
    "high": [-80.0, -45.0, 0.0, 42.0],
    "reached": [-0.75, 0.25],
}
SLOW = {
    part: {key: np.array([1.0, 2.0, 4.0]) for key in ("deflection", "force", "half_width")}
    for part in ("left", "right", "roll")
}


def contact(run: str, label: str, added: float) -> dict[str, Any]:
    force = np.array([300.0, 900.0])
    return {
        "run": run,
        "wheel": "left",
        "added_mass": added,
        "frequency": np.array([5.0, 9.0]),
        "measured": force,
        "simulated": {label: force + 1.0},
    }


def steady(run: str, amplitude: float, frequency: float, label: str = "before") -> dict[str, Any]:
    response = {"stiffness": np.array([1e2 / amplitude]), "loss_angle": np.array([np.pi / 4])}
    curve = {"run": run, "frequency": np.array([frequency]), "measured": response, "simulated": {label: response}}
    return curve | {"amplitude": amplitude}


def strings(item: object) -> Iterator[str]:
    if isinstance(item, str):
        yield item
    elif isinstance(item, dict):
        for key, value in item.items():
            yield from strings(value) if key not in ("meta", "columns", "column") else ()
    elif isinstance(item, list):
        for value in item:
            yield from strings(value)


@pytest.mark.parametrize("figure", every_figure(), ids=lambda figure: figure.title)
def test_plotly_accepts_every_figure(figure):
    assert len(plotly_figure(figure).data) == len(figure.plot["data"])


@pytest.mark.parametrize("figure", every_figure(), ids=lambda figure: figure.title)
def test_every_colour_is_known_in_light_and_dark(figure):
    named = {text[1:] for text in strings(plot_json(figure)) if re.fullmatch(r"@[a-z]+(-[a-z0-9]+)?", text)}
    assert named
    assert named <= LIGHT.keys() & DARK.keys()


@pytest.mark.parametrize("figure", every_figure(HOSTILE, HOSTILE), ids=lambda figure: figure.title)
def test_a_hostile_name_is_neither_tag_nor_template(figure):
    shown = [text for text in strings(plot_json(figure)) if "onerror" in text]
    assert shown
    assert not any("<img" in text or "</script" in text for text in shown)
    assert not any("onerror" in trace.get("hovertemplate", "") for trace in figure.plot["data"])


@pytest.mark.parametrize("figure", every_figure(), ids=lambda figure: figure.title)
def test_every_axis_with_a_quantity_names_its_unit(figure):
    titles = [axis["title"]["text"] for key, axis in figure.plot["layout"].items() if "axis" in key and "title" in axis]
    assert all(
        re.search(r"\((mm|N|N/mm|m/s|deg|Hz|s|% of the RMSE)\)|^$|^N$|evaluations|band", title) for title in titles
    )


def test_a_damper_curve_ends_where_the_runs_did():
    band, line = plotly_figure(figures.velocity_curves({"model": DAMPER})).data
    assert np.allclose(line.x, [-0.75, -0.5, 0.0, 0.25])
    assert np.allclose(line.y, [-70.0, -50.0, 0.0, 20.0])
    assert np.allclose(band.y[:4], [-62.5, -45.0, 0.0, 21.0])
    assert np.allclose(band.y[4:], [19.0, 0.0, -55.0, -77.0])


def test_contact_forces_stand_in_a_panel_for_each_wheel_and_a_colour_for_each_mass():
    curves = [contact("a", "m", 0.0), contact("b", "m", 5.0), contact("a", "m", 0.0) | {"wheel": "right"}]
    plot = figures.contact_response(curves).plot
    assert {"xaxis", "xaxis2"} <= plot["layout"].keys()
    assert [trace["meta"]["mass"] for trace in plot["data"]] == ["0 kg"] * 2 + ["5 kg"] * 2 + ["0 kg"] * 2
    assert plot["data"][0]["marker"]["color"] != plot["data"][2]["marker"]["color"]


def test_of_two_runs_with_one_mass_the_first_is_drawn_at_first():
    plot = figures.contact_response([contact("a", "m", 0.0), contact("anti", "m", 0.0), contact("b", "m", 5.0)]).plot
    shown = {trace["meta"]["run"] for trace in plot["data"] if trace["visible"] is True}
    assert shown == {"a", "b"} and len(plot["data"]) == 6


def test_models_stand_side_by_side_on_the_runs_with_the_least_mass():
    curves = [contact("a", "m", 5.0), contact("b", "m", 0.0), contact("c", "m", 0.0)]
    figure = figures.contact_models(
        [{**curve, "simulated": {"n": curve["measured"], "m": curve["measured"]}} for curve in curves]
    )
    assert {trace["meta"]["run"] for trace in figure.plot["data"]} == {"b", "c"}
    shown = [trace for trace in figure.plot["data"] if trace["visible"] is True]
    assert [trace["meta"]["series"] for trace in shown] == ["measured", "n", "m"]
    assert shown[1]["line"]["color"] != shown[2]["line"]["color"] and "0 kg added" in figure.caption


def test_a_measured_damper_curve_stands_as_points_over_the_identified_one():
    measured = {"velocity": [-1.0, 0.5], "force": [-95.0, 41.0]}
    *_, points = plotly_figure(figures.velocity_curves({"model": DAMPER}, {"damper test rig": measured})).data
    assert (points.mode, points.name) == ("markers", "damper test rig")
    assert np.allclose(points.x, [-1.0, 0.5]) and np.allclose(points.y, [-95.0, 41.0])


def test_loops_are_drawn_in_millimetres_and_newtons():
    time = np.array([0.0, 0.1, 0.2])
    figure = figures.loops({"a": signals(time, np.array([1e-3, 2e-3, 3e-3]), np.array([5.0, 6.0, 7.0]))}, {})
    measured = plotly_figure(figure).data[0]
    assert np.allclose(measured.x, [1.0, 2.0, 3.0])
    assert np.allclose(measured.y, [5.0, 6.0, 7.0])


def test_loops_over_velocity_show_a_damper_as_a_line():
    time = np.linspace(0.0, 1.0, 501)
    x, v = 1e-3 * np.sin(20.0 * time), 2e-2 * np.cos(20.0 * time)
    figure = figures.loops({"a": {"time": time, "displacement": x, "velocity": v, "force": 500.0 * v}}, {})
    over_displacement, over_velocity = plotly_figure(figure).data
    assert (over_displacement.xaxis, over_velocity.xaxis) == ("x", "x2")
    assert np.asarray(over_velocity.y) == pytest.approx(500.0 * np.asarray(over_velocity.x), abs=1e-3)


def test_branches_are_drawn_beside_the_measured_force():
    time = np.linspace(0.0, 1.0, 50)
    measured = {
        "a": signals(time, time, time),
        "b": signals(time, np.sin(9.0 * time), 3.0 * time),
    }
    forces = {"rubber": 90.0 * time, "oil": time, "friction": 0.5 * time}
    figure = figures.branch_loops(measured, {name: {"a": force, "b": force} for name, force in forces.items()})
    shown = [trace for trace in figure.plot["data"] if trace["visible"] is True]
    assert {trace["meta"]["run"] for trace in shown} == {"b"}
    assert [trace["meta"]["series"] for trace in shown] == ["oil"] * 2 + ["friction"] * 2
    assert {trace["meta"]["series"] for trace in figure.plot["data"]} == {"measured", *forces}


def test_identified_curves_are_drawn_in_rig_units_with_their_bands():
    curve = {
        "over": "deflection",
        "over_unit": "m",
        "told": "slope",
        "unit": "N/m",
        "at": np.array([0.0, 2e-3, 4e-3]),
        "value": np.array([1e5, 2e5, 3e5]),
        "low": np.array([0.9e5, np.nan, 2.9e5]),
        "high": np.array([1.1e5, np.nan, 3.1e5]),
    }
    figure = figures.identified_curves({"rubber.stiffness": curve, "oil.scale": {**curve, "unit": "1"}})
    band, line, _, factor = plotly_figure(figure).data
    assert list(line.x) == [0.0, 2.0, 4.0] and list(line.y) == [100.0, 200.0, 300.0]
    assert list(band.x) == [0.0, 4.0, 4.0, 0.0] and list(band.y) == [110.0, 310.0, 290.0, 90.0]
    assert list(factor.y) == [1e5, 2e5, 3e5]
    titles = [figure.plot["layout"][key]["title"]["text"] for key in ("xaxis", "yaxis", "yaxis2")]
    assert titles == ["deflection (mm)", "slope (N/mm)", "factor"]


def test_dynamic_stiffness_is_drawn_in_newtons_a_millimetre_and_degrees():
    figure = every_figure()[1]
    stiffness, angle = plotly_figure(figure).data[:2]
    assert np.allclose(stiffness.y, [200.0, 300.0])
    assert np.allclose(angle.y[1], 45.0)


def test_runs_without_amplitude_and_preload_stand_in_a_panel_of_their_own():
    layout = every_figure()[1].plot["layout"]
    assert {"yaxis", "yaxis2", "yaxis3", "yaxis4"} <= layout.keys()


def test_a_long_run_is_thinned_and_every_point_is_a_sample():
    measured = EVIDENCE["loops"]["measured"]
    figure = figures.loops(measured, EVIDENCE["loops"]["simulated"])
    for trace in plotly_figure(figure).data:
        signals = measured[trace.meta["run"]]
        drawn = np.array(trace.x, dtype=float)
        assert drawn.size <= 2000
        if trace.xaxis == "x":
            assert np.isin(np.round(drawn[~np.isnan(drawn)], 9), np.round(1e3 * signals["displacement"], 9)).all()
        if trace.meta["series"] == "measured":
            assert np.isin(np.array(trace.y)[~np.isnan(drawn)], signals["force"]).all()


def test_the_drawn_cycles_reach_from_the_slowest_to_the_fastest():
    signals = EVIDENCE["loops"]["measured"]["a1_p10"]
    pieces = excerpt.cycle_excerpts(signals["time"], signals["displacement"], 2000)
    durations = [np.ptp(signals["time"][piece]) for piece in pieces]
    assert len(pieces) > 3
    assert durations[0] > 0.2 and durations[-1] < 0.06
    for piece in pieces:
        assert np.ptp(signals["displacement"][piece]) > 1.9e-3


def test_a_single_loop_is_drawn_whole():
    time = np.linspace(0.0, 60.0, 9001)
    x = 0.02 * (1.0 - np.abs(time / 30.0 - 1.0))
    (piece,) = excerpt.cycle_excerpts(time, x, 1000)
    assert piece.size == 1000 and piece[0] == 0 and piece[-1] == 9000


@given(st.lists(st.floats(-1e6, 1e6), min_size=60, max_size=400), st.integers(10, 50))
def test_thinning_a_trace_keeps_its_extremes(values, points):
    signal = np.array(values)
    kept = excerpt.envelope([signal], points)
    assert kept.size <= points
    assert signal[kept].max() == signal.max() and signal[kept].min() == signal.min()


def test_the_run_with_the_largest_error_is_shown_first():
    time = np.linspace(0.0, 1.0, 20)
    measured = {name: signals(time, time, 0.0 * time) for name in "abc"}
    figure = figures.loops(measured, {"before": {"a": time, "b": 9.0 * time, "c": 2.0 * time}})
    assert {trace["meta"]["run"] for trace in figure.plot["data"] if trace["visible"] is True} == {"b"}


def test_the_floor_is_drawn_and_named():
    figure = figures.rmse_bars([{"name": "spring", "train": 20.0, "held_out": 21.0}], 14.5)
    line = figure.plot["data"][-1]
    assert line["y"] == [14.5, 14.5] and "14.5 N" in line["name"]


def test_a_floor_above_the_explainable_error_is_not_called_a_bound():
    bars = [{"name": "spring", "train": 20.0, "held_out": 21.0}]
    assert "No model can be below the noise floor." in figures.rmse_bars(bars, 14.5, 15.0).caption
    caption = figures.rmse_bars(bars, 14.5, 3.0).caption
    assert "No model" not in caption and "A general model is below the noise floor" in caption


def test_gains_carry_their_intervals():
    (gains,) = figures.gain_intervals([friction()]).plot["data"]
    assert np.allclose(gains["error_x"]["array"], [4.0])
    assert np.allclose(gains["error_x"]["arrayminus"], [5.0])


def test_the_misfit_map_puts_each_error_into_its_cell():
    rows = [
        {"run": "a", "band": (1.0, 3.0), "rmse": {"before": 1.0}},
        {"run": "b", "band": (3.0, 25.0), "rmse": {"before": 2.0}},
    ]
    (panel,) = figures.misfit_map(rows).plot["data"]
    assert panel["x"] == ["1–3 Hz", "3–25 Hz"]
    assert np.array_equal(panel["z"], [[1.0, np.nan], [np.nan, 2.0]], equal_nan=True)


def test_edges_of_a_residual_map_that_read_alike_have_one_tick():
    """Half of the samples of a motion lie near its reversals."""
    edges = np.array([-4.0, -3.99, -3.98, -1.0, 0.0, 1.0, 3.98, 3.99, 4.0]) * 1e-3
    steps = {"name": "frequency", "unit": "Hz", "edges": np.array([0.02, 0.17, 0.75, 2.0, 6.0])}
    told = {"label": "before", "x": {"name": "deflection", "unit": "m", "edges": edges}, "y": steps}
    figure = figures.residual_map(told | {"mean": np.ones((4, 8)), "explained": 0.5, "singles": {"velocity": 0.4}})
    axes = figure.plot["layout"]
    assert axes["xaxis"]["ticktext"] == ["-4.0", "-1.0", "0", "1.0", "4.0"]
    assert list(axes["xaxis"]["tickvals"]) == [0, 3, 4, 5, 6]
    assert axes["yaxis"]["ticktext"] == ["0.020", "0.17", "0.75", "2.0", "6.0"]
    assert axes["yaxis"]["title"]["text"] == "frequency (Hz)"


def test_simulations_of_one_band_stand_side_by_side():
    rows = [{"run": run, "band": "whole run", "rmse": {"spring": 1.0, "gehmann": 2.0}} for run in "ab"]
    (panel,) = figures.misfit_map(rows).plot["data"]
    assert panel["x"] == ["spring", "gehmann"] and np.array_equal(panel["z"], [[1.0, 2.0]] * 2)


def test_bands_stand_in_the_order_of_frequency_whatever_run_comes_first():
    bands = ["whole run", (5.0, 10.0), (0.0, 5.0)]
    rows = [{"run": run, "band": band, "rmse": {"before": 1.0}} for run, band in zip("abc", bands, strict=True)]
    assert figures.misfit_map(rows).plot["data"][0]["x"] == ["0–5 Hz", "5–10 Hz", "whole run"]


def test_many_models_are_mapped_in_rows_of_three():
    rmse = {f"model {k}": 1.0 for k in range(7)}
    layout = figures.misfit_map([{"run": "a", "band": (k, k + 1.0), "rmse": rmse} for k in (0.0, 1.0)]).plot["layout"]
    assert len({tuple(axis["domain"]) for key, axis in layout.items() if key.startswith("yaxis")}) == 3


def test_steady_runs_are_drawn_over_what_they_differ_in():
    ladder = figures.steady_stiffness([steady("a", 1e-3, 2.0), steady("b", 2e-3, 2.001)])
    assert ladder.title.endswith("over amplitude")
    assert list(plotly_figure(ladder).data[0].x) == pytest.approx([1.0, 2.0])
    assert list(plotly_figure(ladder).data[0].y) == pytest.approx([100.0, 50.0])
    swept = figures.steady_stiffness([steady("a", 1e-3, 0.1), steady("b", 1e-3, 5.0)])
    assert swept.title.endswith("over frequency") and swept.plot["layout"]["xaxis"]["type"] == "log"


def test_sweeps_are_curves_and_steady_runs_are_points():
    sweep = every_figure()[1]
    both = figures.stiffness_figures([*EVIDENCE["dynamic_stiffness"], steady("s", 1e-3, 2.0)])
    assert [figure.title for figure in both] == [sweep.title, "Dynamic stiffness and loss angle over frequency"]


@pytest.mark.parametrize("make", ["loops", "harmonics", "stiffness", "residuals"])
def test_the_series_asked_for_is_drawn_at_first(make):
    made = {
        "loops": lambda: figures.loops(**EVIDENCE["loops"], series=["after"]),
        "harmonics": lambda: figures.harmonic_bars(EVIDENCE["harmonics"], ["after"]),
        "stiffness": lambda: figures.dynamic_stiffness(EVIDENCE["dynamic_stiffness"], ["after"]),
        "residuals": lambda: figures.residual_traces(**EVIDENCE["residuals"], series=["after"]),
    }[make]()
    visible = {trace["meta"]["series"] for trace in made.plot["data"] if trace["visible"] is True}
    assert visible - {"measured"} == {"after"}


def test_missing_numbers_are_null_and_never_nan():
    text = json.dumps(compact({"a": np.array([1.0, np.nan]), "b": np.inf, "c": [None, 2]}), allow_nan=False)
    assert json.loads(text) == {"a": [1, None], "b": None, "c": [None, 2]}


@given(st.floats(-1e12, 1e12))
def test_numbers_of_a_plot_are_right_to_six_digits(value):
    assert compact(value) == pytest.approx(value, rel=5e-6)


def test_repeated_texts_of_a_column_are_counted():
    assert column_json(["a", "a", "b"]) == {"repeat": [["a", 2], ["b", 1]]}
    assert column_json(np.array([1.0, 1.0])) == [1, 1]


def test_the_table_behind_a_figure_says_where_each_number_belongs():
    figure = figures.residual_traces({"a": np.arange(3.0)}, {"before": {"a": np.ones(3)}, "after": {"a": np.zeros(3)}})
    assert list(figure.columns) == ["run", "time (s)", "residual simulated before (N)", "residual simulated after (N)"]
    assert list(figure.columns["run"]) == ["a"] * 3


def test_all_models_of_a_comparison_fit_on_the_bars():
    figure = figures.rmse_bars([{"name": name, **model(name, 9.0)["rmse"]} for name in ("spring", "gehmann")])
    assert [trace["name"] for trace in figure.plot["data"]] == ["training runs", "held-out runs"]


def test_a_model_keeps_its_dash_where_another_is_missing():
    response = {"stiffness": np.ones(2), "loss_angle": np.ones(2)}
    curve = {"run": "a", "frequency": np.arange(2.0), "measured": response}
    both, one = (
        curve | {"simulated": {"spring": response, "gehmann": response}},
        curve | {"simulated": {"gehmann": response}},
    )
    traces = figures.dynamic_stiffness([both, one]).plot["data"]
    assert len({trace["line"]["dash"] for trace in traces if trace["meta"]["series"] == "gehmann"}) == 1


@pytest.mark.parametrize("models", [1, 2, 10])
def test_many_models_do_not_make_the_page_larger(models):
    time = np.linspace(0.0, 30.0, 30001)
    x = 0.02 + 0.005 * np.sin(2.0 * np.pi * (time + 0.4 * time**2))
    measured = {f"run {i}": signals(time, x, 1e4 * x) for i in range(17)}
    simulated = {f"model {k}": {run: 1.01e4 * x for run in measured} for k in range(models)}
    assert len(json.dumps(plot_json(figures.loops(measured, simulated)))) < 1.1e6

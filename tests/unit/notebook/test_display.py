"""What a notebook shows of models, data, fits, comparisons and diagnoses."""

from __future__ import annotations

import subprocess
import sys
from types import SimpleNamespace

import pytest

import dashpot as dp
from dashpot.notebook.cell import cell
from dashpot.notebook.plots import PLOTS
from dashpot.report.parts import Code, Column, Grid, Notice, Picture
from dashpot.text.problem import InputError

MODEL = """\
format: dashpot-network/1
name: mount
about: Rubber <b>between</b> steel.
branches:
  rubber: {element: spring, stiffness: {start: 150 N/mm, bounds: [10 N/mm, 1 kN/mm]}}
  damping: {element: damper, damping: {start: 0.5 N*s/mm}}
"""
TRUTH = """\
format: dashpot-network/1
name: truth
branches:
  rubber: {element: spring, stiffness: 200 N/mm}
  damping: {element: damper, damping: 0.4 N*s/mm}
"""
SWEEP = {"amplitudes": "1 mm", "preloads": "2 mm, 4 mm", "duration": "2 s", "sampling": "500 Hz"}


@pytest.fixture(scope="module")
def data():
    return dp.measure(dp.declare(TRUTH), "hydropulser", **SWEEP)


@pytest.fixture(scope="module")
def fit(data):
    return dp.fit(dp.declare(MODEL), data)


# --- cells ---------------------------------------------------------------------------------------------------------


def test_texts_are_escaped_and_numbers_rounded():
    grid = Grid("A <table>", [Column("a", "a"), Column("b", "b", "N", 3)], [{"a": "<i>", "b": 1234.567}, {"a": None}])
    html = cell("<h>", "one & two", Notice("warning", "mind <it>"), grid, Code("code", "+new\n-old", "diff"))
    assert "<i>" not in html and "&lt;i&gt;" in html and "mind &lt;it&gt;" in html and "one &amp; two" in html
    assert "b (N)" in html and ">1235<" in html and ">–<" in html
    assert '<span class="added">+new' in html and '<span class="removed">-old' in html


def test_a_drawing_cannot_reach_the_page():
    html = cell(Picture("drawing", "<svg><script>alert(1)</script></svg>"))
    assert "<script" not in html and "data:image/svg+xml;base64," in html


def test_what_a_cell_cannot_show_is_told():
    with pytest.raises(TypeError, match="expected a text, grid, picture, code or notice, got int"):
        cell("heading", 3)


# --- results -------------------------------------------------------------------------------------------------------


def test_a_model_shows_its_schematic_its_numbers_and_its_weaknesses():
    twins = MODEL + "  second: {element: damper, damping: {start: 0.3 N*s/mm}}\n"
    html = dp.declare(twins)._repr_html_()
    assert "data:image/svg+xml" in html and "&lt;b&gt;between" in html
    assert "rubber.stiffness" in html and ">free<" in html and 'class="warning"' in html


def test_the_parameters_of_a_model_have_meanings_rig_units_and_ranges():
    [rubber, damping] = dp.declare(MODEL).table().rows
    assert (rubber["value"], rubber["unit"], rubber["lower"], rubber["upper"]) == (150.0, "N/mm", 10.0, 1000.0)
    assert (damping["value"], damping["unit"], damping["lower"]) == (0.5, "N*s/mm", pytest.approx(1e-7))


def test_a_dataset_shows_its_runs_and_channels(data):
    html = data._repr_html_()
    assert "amplitude 1 mm, preload 2 mm" in html and "displacement" in html
    [displacement, force] = data.channels().rows
    assert displacement["unit"] == "mm" and displacement["high"] == pytest.approx(5.0, abs=0.02)
    assert force["runs"] == len(data.runs)


def test_all_samples_become_one_frame(data):
    frame = data.to_pandas()
    assert list(frame) == ["run", "time (s)", "displacement (m)", "force (N)"]
    assert len(frame) == sum(run.time.size for run in data.runs)
    run = data.runs[1]
    assert (frame[frame["run"] == run.name]["force (N)"].to_numpy() == run.force).all()


def test_a_fit_shows_found_numbers_with_intervals(fit):
    rows = {row["number"]: row for row in fit.table().rows}
    assert rows["rubber.stiffness"]["value"] == pytest.approx(200.0, rel=1e-3)
    assert rows["rubber.stiffness"]["low"] <= rows["rubber.stiffness"]["value"] <= rows["rubber.stiffness"]["high"]
    assert rows["damping.damping"]["role"] == "identified"
    assert "Ended because: converged" in fit._repr_html_()


def test_numbers_to_mind_are_remarked(fit):
    from dataclasses import replace

    rows = replace(fit, at_bound=("rubber.stiffness",), idle=("damping.damping",)).table().rows
    assert [row["role"] for row in rows] == ["identified at the end of its range", "without influence on these data"]


def test_a_fitted_model_goes_on(fit, data, tmp_path):
    again = dp.load(fit.save(tmp_path / "found.yaml"))
    assert [slot.value.number for slot in again.slots()] == pytest.approx(
        [slot.value.number for slot in fit.fitted.slots()], rel=1e-4
    )
    forces = dp.simulate(again, data)
    assert list(forces) == [run.name for run in data.runs]
    assert forces[data.runs[0].name] == pytest.approx(data.runs[0].force, abs=0.1)


def test_a_comparison_shows_the_table_of_errors(data):
    found = dp.compare([dp.declare(MODEL), dp.declare(MODEL.replace("name: mount", "name: other"))], data)
    assert found.headline in found._repr_html_().replace("&#x27;", "'")
    assert [row["name"] for row in found.table().rows][:2] == ["mount", "other"]
    assert list(found.to_pandas()["model"])[:2] == ["mount", "other"]
    assert {trace.name for trace in found.plot().data} >= {"training runs"}


def test_a_look_shows_its_runs_and_draws_every_picture(data, tmp_path):
    seen = dp.look(data)
    assert seen.headline in seen._repr_html_()
    assert [row["run"] for row in seen.table().rows] == [run.name for run in data.runs]
    assert list(seen.to_pandas()["run"]) == [run.name for run in data.runs]
    for title in seen.pictures:
        assert not [color for color in _colors(seen.plot(title).to_plotly_json()) if color.startswith("@")]
    assert seen.report(tmp_path / "look.html").is_file()
    with pytest.raises(ValueError, match="expected a picture out of Force over displacement"):
        seen.plot("nothing")


# --- plots ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("what", PLOTS)
def test_every_plot_of_the_report_is_drawn(fit, what):
    drawn = fit.plot(what)
    assert drawn.data and drawn.layout.title.text
    assert not [color for color in _colors(drawn.to_plotly_json()) if color.startswith("@")]


def test_the_legend_names_every_trace_once(fit):
    shown = [trace.name for trace in fit.plot("stiffness").data if trace.showlegend]
    assert len(shown) == len(set(shown)) > 0


def test_an_unknown_plot_is_told_with_what_there_is(fit, data):
    with pytest.raises(ValueError, match="expected a plot out of stiffness, loops.*got 'lopes'; did you mean 'loops'"):
        fit.plot("lopes")
    with pytest.raises(ValueError, match="out of stiffness, loops, got 'residuals'"):
        data.plot("residuals")


def test_a_stiffness_needs_an_oscillation():
    loop = dp.measure(dp.declare(TRUTH), "triangle", depth="2 mm", loops=1)
    with pytest.raises(ValueError, match="expected runs with an oscillation for 'stiffness'"):
        loop.plot("stiffness")


def _colors(item):
    if isinstance(item, dict):
        for key, value in item.items():
            if isinstance(value, str) and key.endswith("color"):
                yield value
            yield from _colors(value)
    elif isinstance(item, list | tuple):
        for value in item:
            yield from _colors(value)


# --- the package ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("first", ["dashpot.fit.api", "dashpot.fit.study.run", "dashpot.fit", "dashpot.cli.fit"])
def test_the_layer_fit_can_be_called_whoever_imported_it_first(first):
    program = f"import {first} as layer, dashpot; from inspect import signature; print(signature(dashpot.fit))"
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    assert said.startswith("(model: 'AnyModel', data: 'AnyData'")


@pytest.mark.parametrize("first", ["dashpot.compare.explainable", "dashpot.compare"])
def test_the_layer_compare_can_be_called_whoever_imported_it_first(first):
    program = f"import {first} as layer, dashpot; from inspect import signature; print(signature(dashpot.compare))"
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    assert said.startswith("(models: 'Sequence[AnyModel]', data: 'AnyData'")


def test_without_pandas_the_way_out_is_told(monkeypatch, fit):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"pip install 'dashpot\[pandas\]'"):
        fit.to_pandas()


def test_a_wrong_text_and_unknown_rig_are_input_errors():
    with pytest.raises(InputError, match="there is no element 'sprng'"):
        dp.declare(MODEL.replace("spring", "sprng"))
    with pytest.raises(InputError, match="did you mean 'triangle'"):
        dp.measure(dp.declare(TRUTH), "triangel")


def test_a_registry_of_ones_own_is_used():
    own = SimpleNamespace(elements={})
    with pytest.raises(InputError, match="there is no element 'spring'"):
        dp.declare(MODEL, registry=own)


def test_a_result_is_one_line_by_itself_and_its_answer_where_it_is_printed(data, fit):
    comparison = dp.compare(["spring", fit.model], data)
    model, seen = dp.declare(MODEL), dp.look(data)
    for result in (data, model, fit, comparison, seen):
        assert repr(result).startswith(f"<{type(result).__name__}: ") and "\n" not in repr(result)
        assert "array(" not in str(result) and len(str(result).splitlines()) < 40
    assert repr(data) == f"<Data: {data.name}, {len(data.runs)} runs>"
    assert repr(model) == "<Model: mount: rubber (spring), damping (damper)>"
    assert str(fit) == fit.summary()
    assert str(comparison).rstrip().endswith(comparison.headline) and "RMSE train (N)" in str(comparison)
    assert "bounds" not in repr(model) and "150" in str(model)

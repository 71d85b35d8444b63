"""Runs out of arrays, frames of pandas and datasets of xarray."""

from __future__ import annotations

import numpy as np
import pytest

import dashpot as dp
from dashpot.text.problem import InputError

TIME = np.arange(0.0, 4.0, 1e-3)
X = 1e-3 * np.sin(2.0 * np.pi * 5.0 * TIME) + 3e-3
FORCE = 2e5 * X + 40.0 * np.cos(2.0 * np.pi * 5.0 * TIME)


def sine(name="sine", **keys):
    return dp.Data.from_arrays(TIME, X, FORCE, name=name, **keys)


def test_arrays_are_the_same_run_as_their_file(tmp_path):
    made = sine(kind="harmonic", settings={"amplitude": "1 mm", "preload": 3e-3, "rubber": "black"}, held_out=True)
    lines = "\n".join(f"{t!r},{x!r},{f!r}" for t, x, f in zip(*map(np.ndarray.tolist, (TIME, X, FORCE)), strict=True))
    (tmp_path / "sine.csv").write_text(f"t,x,F\n{lines}\n")
    (tmp_path / "dataset.yaml").write_text("""
format: dashpot-dataset/1
name: sine
runs:
  - name: sine
    file: sine.csv
    kind: harmonic
    held_out: true
    settings: {amplitude: 1 mm, preload: 3 mm, rubber: black}
    channels:
      time: {column: t, unit: s}
      displacement: {column: x, unit: m}
      force: {column: F, unit: N}
""")
    assert made.digest == dp.load_dataset(tmp_path).digest


def test_units_are_brought_to_si_and_the_arrays_are_copied():
    depth = X * 1e3
    data = dp.Data.from_arrays(
        TIME * 1e3, depth, FORCE / 1e3, units={"time": "ms", "displacement": "mm", "force": "kN"}
    )
    depth[:] = 0.0
    run = data.runs[0]
    assert run.displacement == pytest.approx(X, rel=1e-12) and run.force == pytest.approx(FORCE, rel=1e-12)
    assert run.sample_time == pytest.approx(1e-3, rel=1e-9)
    with pytest.raises(ValueError, match="read-only"):
        run.force[0] = 1.0


def test_a_sampling_rate_replaces_the_time_and_the_kind_is_found():
    assert dp.Data.from_arrays(None, X, FORCE, sampling="1 kHz").digest == dp.Data.from_arrays(TIME, X, FORCE).digest
    assert sine().runs[0].kind == "harmonic"
    slow = np.interp(TIME, [0.0, 2.0, 4.0], [0.0, 4e-3, 0.0])
    assert dp.Data.from_arrays(10.0 * TIME, slow, 2e5 * slow).runs[0].kind == "quasi_static"


@pytest.mark.parametrize(
    "keys, told",
    [
        ({"kind": "swep"}, "did you mean 'sweep'"),
        ({"settings": {"amplitude": "3 N"}}, "'amplitude': expected a quantity in m"),
        ({"units": {"force": "mm"}}, "the channel 'force': expected a quantity in N"),
        ({"units": {"forc": "N"}}, "which is no channel of the run. did you mean 'force'"),
        ({"sampling": 1000.0}, "expected either a time .* or a sampling rate"),
        ({"channels": {"temperature": np.ones(3)}}, "as many samples of each channel, got .*temperature 3"),
        ({"channels": {"temperature": np.ones((4000, 1))}}, r"expected samples \(n,\), got an array of shape"),
        ({"channels": {"temperature": ["warm"] * 4000}}, "the temperature: expected numbers"),
    ],
)
def test_what_is_wrong_with_arrays_is_told(keys, told):
    with pytest.raises(InputError, match=told):
        sine(**keys)


def test_a_hole_is_told_with_its_row():
    holed = FORCE.copy()
    holed[7] = np.nan
    with pytest.raises(InputError, match="run 'holed': the force has no number .* in row 8"):
        dp.Data.from_arrays(TIME, X, holed, name="holed")


def test_joined_runs_know_their_repeats():
    first = sine("a", settings={"preload": "3 mm"})
    data = dp.Data.join([sine("c", repeats="b"), first, sine("b", repeats="a")], "all")
    assert [(run.name, run.repeats, run.group, run.order) for run in data.runs] == [
        ("c", "a", "a", 0),
        ("a", None, "a", 1),
        ("b", "a", "a", 2),
    ]
    assert data.groups == ["a", "a", "a"] and data.run("c").settings == {"preload": 3e-3} and data.name == "all"


def test_what_cannot_be_joined_is_told():
    with pytest.raises(InputError, match="2 runs are called 'a'"):
        dp.Data.join([sine("a"), sine("a")])
    with pytest.raises(InputError, match="run 'a' repeats 'first', which is no run here"):
        dp.Data.join([sine("a", repeats="first"), sine("b")])
    with pytest.raises(InputError, match="has no runs"):
        dp.Data.join([])


def test_a_frame_gives_back_the_runs_it_was_made_of():
    data = dp.Data.join([sine("a", settings={"preload": "3 mm"}), sine("b", repeats="a")])
    runs = {"a": {"settings": {"preload": 3e-3}}, "b": {"repeats": "a"}}
    assert dp.Data.from_pandas(data.to_pandas(), runs=runs).digest == data.digest
    again = dp.Data.from_pandas(data.to_pandas().set_index("time (s)"), runs=runs)
    assert again.digest == data.digest


def test_columns_of_any_name_state_their_units_and_time_may_be_instants():
    pandas = pytest.importorskip("pandas")
    clock = pandas.Timestamp("2024-05-06") + pandas.to_timedelta(TIME, "s")
    frame = pandas.DataFrame({"Weg [mm]": X * 1e3, "Kraft [kN]": FORCE / 1e3, "clock": clock})
    columns = {"time": "clock", "displacement": "Weg [mm]", "force": "Kraft [kN]"}
    run = dp.Data.from_pandas(frame, columns, kind="harmonic", name="press").runs[0]
    assert (run.name, run.kind) == ("press", "harmonic")
    assert run.force == pytest.approx(FORCE, rel=1e-12) and run.time[-1] == pytest.approx(TIME[-1])
    with pytest.raises(InputError, match=r"'displacement': there is no column 'Weg'. columns are Weg \[mm\], Kraft"):
        dp.Data.from_pandas(frame, {**columns, "displacement": "Weg"})


def test_a_run_with_a_fault_is_set_aside_and_the_others_go_on():
    frame = dp.Data.join([sine("a"), sine("b", repeats="a")]).to_pandas()
    frame.loc[100, "force (N)"] = np.nan
    data = dp.Data.from_pandas(frame, runs={"b": {"repeats": "a"}})
    assert [(run.name, run.repeats) for run in data.runs] == [("b", None)]
    assert "run 'a': the force has no number" in str(data.problems[0])


def test_runs_along_a_dimension_of_xarray_may_be_filled_up():
    xarray = pytest.importorskip("xarray")
    short = np.where(TIME < 3.0, 1.0, np.nan)
    made = xarray.Dataset(
        {
            "displacement": (("run", "time"), 1e3 * np.array([X, X * short]), {"units": "mm"}),
            "force": (("run", "time"), np.array([FORCE, FORCE * short])),
        },
        coords={"time": TIME, "run": ["long", "short"]},
    )
    long, cut = dp.Data.from_xarray(made, runs={"short": {"repeats": "long"}}).runs
    assert (long.name, cut.name, cut.repeats) == ("long", "short", "long")
    assert long.displacement == pytest.approx(X) and cut.force == pytest.approx(FORCE[TIME < 3.0])


def test_dynamic_stiffness_of_data_is_that_of_the_sine():
    [found] = sine().dynamic_stiffness().values()
    assert repr(found).startswith("DynamicStiffness: ") and len(repr(found)) < 100
    assert found.storage == pytest.approx(2e5, rel=1e-6) and found.loss == pytest.approx(4e4, rel=1e-6)
    assert found.amplitude == pytest.approx(1e-3, rel=1e-6) and found.frequency == pytest.approx(5.0, rel=1e-6)


def test_runs_in_memory_are_fitted_compared_and_simulated():
    time, frequencies = np.arange(0.0, 2.0, 2e-3), (2.0, 4.0, 8.0, 16.0)
    phases = [2.0 * np.pi * f * time for f in frequencies]
    parts = [
        dp.Data.from_arrays(
            time, 1e-3 * np.sin(p), 200.0 * np.sin(p) + 0.5 * 2.0 * np.pi * f * np.cos(p), name=f"f{f:g}"
        )
        for f, p in zip(frequencies, phases, strict=True)
    ]
    data = dp.Data.join(parts, "sines")
    model = dp.Network(
        "voigt",
        {
            "rubber": {"element": "spring", "stiffness": {"start": 1e5}},
            "loss": {"element": "damper", "damping": {"start": 100.0}},
        },
    )
    found = dp.fit(model, data)
    assert found.model["rubber"].stiffness == pytest.approx(2e5, rel=1e-4)
    assert found.model["loss"].damping == pytest.approx(500.0, rel=1e-4)
    assert dp.simulate(found.model, data)["f8"] == pytest.approx(data.run("f8").force, abs=0.1)
    assert len(dp.compare([model], data).fits) == 1


def test_settings_are_taken_as_arguments_too():
    run = sine(settings={"preload": "2 mm"}, amplitude="1 mm", pressure="2 bar").runs[0]
    assert run.settings == {"preload": 2e-3, "amplitude": 1e-3, "pressure": 2e5}


def test_an_argument_with_a_slip_does_not_become_a_setting():
    with pytest.raises(TypeError, match="no argument 'setings', did you mean 'settings'"):
        sine(setings={"amplitude": "1 mm"})

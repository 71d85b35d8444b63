"""What measured files alone tell: channels, units, clock, signs, kinds, settings, repeats; each from made signals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from unit.data.tables import Tables

from dashpot.data.dataset import read_dataset
from dashpot.data.importing.files import find_files, run_names
from dashpot.data.importing.finding import find_all
from dashpot.data.importing.imported import import_files
from dashpot.data.importing.motion import find_motion
from dashpot.data.importing.names import conditions_of
from dashpot.data.importing.roles import named_roles
from dashpot.data.importing.signs import find_signs
from dashpot.data.importing.text import dataset_text, quoted
from dashpot.data.importing.timing import find_timing, pieces
from dashpot.data.importing.units import find_unit
from dashpot.data.table import Table
from dashpot.text.document import Document
from dashpot.text.problem import InputError

STEP = 0.002
TIME = STEP * np.arange(5000)


def chirp(start, stop, amplitude=1.0):
    """A linear sweep, its phase the integral of the frequency."""
    return amplitude * np.sin(2 * np.pi * (start * TIME + (stop - start) * TIME**2 / (2 * TIME[-1])))


def imported(folder, tables, **more):
    for name in tables:
        (folder / name).write_text("")
    return import_files([folder], {"tab": Tables(tables)}, **more)


def kelvin_voigt(motion, noise=0.0, stiffness=200e3, damping=500.0):
    """Force in N of a spring and a dashpot over a motion in mm."""
    x = motion * 1e-3
    return stiffness * x + damping * np.gradient(x, STEP) + noise * np.random.default_rng(1).normal(size=x.size)


# --- roles and units -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("columns", "units", "found"),
    [
        (["Zeit", "Weg", "Kraft"], {}, ["Zeit", "Weg", "Kraft"]),
        (["Time [s]", "Axial Displacement", "Axial Force"], {}, ["Time [s]", "Axial Displacement", "Axial Force"]),
        (["t", "x", "F"], {"t": "s", "x": "mm", "F": "kN"}, ["t", "x", "F"]),
        (["Running Time", "AI 1", "AI 2"], {"AI 1": "mm", "AI 2": "N"}, ["Running Time", "AI 1", "AI 2"]),
        (["x", "Weg Soll", "Weg Ist", "Last"], {"x": "s", "Weg Ist": "mm", "Weg Soll": "mm"}, ["x", "Weg Ist", "Last"]),
        (["Zeit_s", "Kolbenweg_mm", "Kraft_kN"], {}, ["Zeit_s", "Kolbenweg_mm", "Kraft_kN"]),
        (["t", "Load", "Load cell"], {"Load": "V", "Load cell": "N"}, ["t", None, "Load cell"]),
        (["Sample Number", "position", "load"], {}, [None, "position", "load"]),
        (
            ["RUNTIME", "DISTGRND", "FZW"],
            {"RUNTIME": "s", "DISTGRND": "mm", "FZW": "N"},
            ["RUNTIME", "DISTGRND", "FZW"],
        ),
        (["sec", "mm", "kN"], {}, ["sec", "mm", "kN"]),
        (["m(1)", "m(2)"], {}, [None, None, None]),
    ],
)
def test_channels_are_known_by_name_and_unit(columns, units, found):
    roles = named_roles(columns, units)
    names = [roles[channel].column if channel in roles else None for channel in ("time", "displacement", "force")]
    assert names == found


@pytest.mark.parametrize("order", [(0, 1, 2, 3), (3, 1, 0, 2), (0, 3, 2, 1), (2, 0, 3, 1)])
def test_nameless_columns_are_known_by_how_they_move(order):
    way = chirp(1, 10)
    signals = [TIME, way, np.gradient(way, STEP), kelvin_voigt(way, noise=2)]
    found = find_all(Table({str(place + 1): signals[index] for place, index in enumerate(order)}))
    assert found.timing.column == str(order.index(0) + 1)
    assert found.channels["displacement"].role.column == str(order.index(1) + 1)
    assert found.channels["force"].role.column == str(order.index(3) + 1)
    assert any("how it moves" in remark for remark in found.confirm)


def test_a_raw_voltage_beside_its_signal_is_passed_over():
    way = chirp(1, 10, 8.0)
    force = kelvin_voigt(way, noise=2)
    found = find_all(Table({"1": TIME, "2": way / 50 + 1, "3": force / 1e4, "4": way, "5": force}))
    assert [found.channels[name].role.column for name in ("displacement", "force")] == ["4", "5"]


@pytest.mark.parametrize(
    ("channel", "column", "stated", "values", "unit", "by"),
    [
        ("displacement", "Weg", "um", [0, 1], "um", "stated in the file"),
        ("displacement", "Weg_um", "", [0, 1], "um", "in the name"),
        ("displacement", "Weg", "V", [0.0, 12.0], "mm", "guessed"),
        ("displacement", "Weg", "", [0.0, 0.012], "m", "guessed"),
        ("force", "Load.kN", "", [0, 1], "kN", "in the name"),
        ("force", "kN", "", [0, 1], "kN", "in the name"),
        ("force", "Kraft/kN", "", [0, 1], "kN", "in the name"),
        ("displacement", "s/um", "", [0, 1], "um", "in the name"),
        ("velocity", "v/m/s", "", [0, 1], "m/s", "in the name"),
        ("acceleration", "accel_g", "", [0, 1], "g0", "in the name"),
        ("acceleration", "a", "g", [0, 1], "g0", "stated in the file"),
        ("acceleration", "Beschl. G", "", [0, 1], "g0", "in the name"),
        ("acceleration", "accel", "", [0, 1], "m/s^2", "guessed"),
        ("force", "F", "", [0, 1], "N", "guessed"),
        ("time", "t", "", [0.0, 10.0, 20.0], "ms", "guessed"),
    ],
)
def test_a_unit_is_stated_named_or_guessed(channel, column, stated, values, unit, by):
    found = find_unit(channel, column, stated, np.array(values))
    assert (found.unit, found.by) == (unit, by)


# --- clock ---------------------------------------------------------------------------------------------------------


def test_a_clock_that_repeats_its_stamps_gives_its_mean_rate():
    coarse = np.floor(TIME * 100) / 100
    timing = find_timing({"t": coarse}, {"t": "s"}, None, named_roles(["t"], {})["time"])
    assert timing.column is None and timing.sampling == pytest.approx(500, rel=2e-3)
    assert "repeats its stamps" in timing.confirm[0]


def test_without_clock_the_stated_rate_is_used_or_nothing():
    assert find_timing({"F": TIME % 1}, {}, 500.0, None).sampling == 500.0
    timing = find_timing({"Sample Number": np.arange(100.0)}, {}, None, None)
    assert timing.sampling is None and timing.column is None and "no sampling rate" in timing.confirm[0]


def test_pieces_lie_between_gaps():
    time = np.concatenate([[0.0], 5 + TIME[:1000], 60 + TIME[:500]])
    assert pieces(time) == [(1, 1001), (1001, 1501)]
    assert pieces(TIME) == [(0, TIME.size)]


def test_pieces_lie_between_restarts_and_lines_of_text():
    assert pieces(np.concatenate([TIME, TIME[:900]])) == [(0, 5000), (5000, 5900)]
    assert pieces(np.concatenate([TIME[:900], [np.nan] * 3, TIME[:900]])) == [(0, 900), (903, 1803)]
    assert pieces(np.where(np.arange(5000) == 7, np.nan, TIME)) == [(0, 5000)]


# --- signs ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("first", "second"), [(1, 1), (1, -1), (-1, 1), (-1, -1)])
def test_signs_make_a_pressed_specimen_take_up_work(first, second):
    way = 8 + chirp(1, 10)
    signs = find_signs(first * way, second * kelvin_voigt(way))
    assert signs[:2] == (first, second)
    assert bool(signs[2]) is (signs[:2] != (1, 1))


@pytest.mark.parametrize("begin", [0.0, -1.0, 3.0])
@pytest.mark.parametrize("damping", [0.0, 500.0, 20e3])
def test_a_ramp_that_is_held_has_the_sign_of_its_stiffness(begin, damping):
    """It is squeezed while its force is below the mean, which is no work given back."""
    way = begin + 5.0 * np.clip(TIME / 0.5, 0.0, 1.0) + 1e-3 * np.random.default_rng(3).standard_normal(TIME.size)
    force = kelvin_voigt(way - 1e-3, noise=10.0, damping=damping)
    assert find_signs(way, force)[:2] == (1, 1)
    assert find_signs(way, -force)[0] * find_signs(way, -force)[1] == -1
    assert find_signs(way, force, (1, 1)) == (1, 1, "")


def test_a_damper_around_zero_has_the_sign_of_its_losses():
    way = chirp(1, 10)
    force = 300 * np.tanh(np.gradient(way, STEP))
    assert find_signs(way, force)[:2] == (1, 1)
    assert find_signs(way, -force)[:2] == (1, -1)


# --- motion --------------------------------------------------------------------------------------------------------


def noise_motion():
    """Band-limited noise."""
    spectrum = np.fft.rfft(np.random.default_rng(3).normal(size=TIME.size))
    spectrum[np.fft.rfftfreq(TIME.size, STEP) > 8] = 0
    return 1e-3 * np.fft.irfft(spectrum, TIME.size)


SLOW = 4 * STEP * np.arange(5000)
RAMPED = np.minimum(1, np.minimum(TIME, TIME[-1] - TIME))


@pytest.mark.parametrize(
    ("motion", "step", "kind", "settings"),
    [
        (0.02 + chirp(1, 20, 1e-3), STEP, "sweep", {"start": 1, "stop": 20, "amplitude": 1e-3, "preload": 0.02}),
        (chirp(20, 1, 1e-3), STEP, "sweep", {"start": 20, "stop": 1, "amplitude": 1e-3}),
        (2e-3 * np.sin(2 * np.pi * np.geomspace(1, 12, 5000) / np.log(12) * 10), STEP, "sweep", {"stop": 12}),
        (0.01 + 5e-3 * np.sin(2 * np.pi * 3.3 * TIME), STEP, "harmonic", {"frequency": 3.3, "amplitude": 5e-3}),
        (RAMPED * 5e-3 * np.sin(2 * np.pi * 2 * TIME), STEP, "harmonic", {"frequency": 2, "amplitude": 5e-3}),
        (5e-3 * np.sin(2 * np.pi * 4 * TIME[:500]), STEP, "harmonic", {"frequency": 4, "amplitude": 5e-3}),
        (0.01 - 5e-3 * np.cos(2 * np.pi * 2 * TIME[:500]), STEP, "harmonic", {"frequency": 2, "preload": 0.01}),
        (5e-3 * np.exp(-TIME[:500]) * np.sin(2 * np.pi * 3 * TIME[:500]), STEP, "transient", {}),
        (noise_motion(), STEP, "random", {}),
        (0.01 * np.abs((TIME / 10 * 2) % 2 - 1), 4 * STEP, "quasi_static", {}),
        (5e-3 * np.sin(2 * np.pi * SLOW / 20), 4 * STEP, "quasi_static", {}),
        (0.01 * np.minimum(1, TIME / 0.1), STEP, "hold", {"preload": 0.01}),
        (0.01 * np.exp(-0.5 * ((TIME[:500] - 0.5) / 0.1) ** 2), STEP, "transient", {}),
    ],
)
def test_a_motion_tells_its_kind_and_settings(motion, step, kind, settings):
    noisy = motion + 1e-6 * np.random.default_rng(5).normal(size=motion.size)
    found = find_motion(noisy, step)
    assert found.kind == kind
    for key, value in settings.items():
        assert found.settings[key] == pytest.approx(value, rel=0.03)


def triangle(amplitude, period, middle=0.0):
    """From the middle up, at constant speed; in m, of 10 s."""
    phase = TIME / period + 0.25
    return middle + amplitude * (1.0 - 4.0 * np.abs(phase % 1.0 - 0.5))


@pytest.mark.parametrize("cycles", [1.25, 2.0, 5.0, 12.0])
@pytest.mark.parametrize(("slowness", "kind"), [(1.0, "transient"), (10.0, "quasi_static")])
def test_a_triangle_is_no_sine_and_has_its_own_amplitude(cycles, slowness, kind):
    """Of 0.8 s to 8 s a cycle, and of ten times as long."""
    scatter = 1e-5 * np.random.default_rng(7).standard_normal(TIME.size)
    found = find_motion(triangle(4e-3, 10.0 / cycles, 0.01) + scatter, slowness * STEP)
    assert found.kind == (kind if cycles > 2.0 else "quasi_static")
    assert found.settings == {"amplitude": pytest.approx(4e-3, rel=0.01), "preload": pytest.approx(0.01, rel=0.01)}


def test_a_triangle_of_growing_strokes_has_no_amplitude():
    turns = np.arange(21)
    found = find_motion(np.interp(TIME, 0.5 * turns, 1e-3 * turns * (-1.0) ** turns), 10 * STEP)
    assert (found.kind, dict(found.settings)) == ("quasi_static", {})


@pytest.mark.parametrize("cycles", [1.5, 2.0, 2.5, 4.0, 5.0])
def test_the_cycles_of_a_short_sine_are_all_counted(cycles):
    found = find_motion(2e-3 * np.sin(2 * np.pi * cycles / 5.0 * TIME[:2500]), STEP)
    assert found.kind == "harmonic"
    assert found.settings["frequency"] == pytest.approx(cycles / 5.0, rel=0.01)


# --- whole folders -------------------------------------------------------------------------------------------------


def table(motion, noise=0.5, seed=0, units=True, **more):
    chance = np.random.default_rng(seed)
    force = kelvin_voigt(motion) + noise * chance.normal(size=motion.size)
    return Table({"t": TIME, "x": motion, "F": force}, {"t": "s", "x": "mm", "F": "N"} if units else {}, **more)


def test_repeats_are_found_and_other_forces_are_none(tmp_path):
    motion = 10 + chirp(1, 20)
    soft = Table({"t": TIME, "x": motion, "F": 0.8 * kelvin_voigt(motion)}, {"t": "s", "x": "mm", "F": "N"})
    runs = imported(tmp_path, {"a.tab": table(motion), "a_2.tab": table(motion, seed=1), "b.tab": soft}).runs
    assert [(run.name, run.repeats) for run in runs] == [("a", None), ("a_2", "a"), ("b", None)]


def test_a_copy_is_told_and_is_no_repeat(tmp_path):
    found = imported(tmp_path, {"a.tab": table(chirp(1, 20)), "b.tab": table(chirp(1, 20))})
    assert [run.repeats for run in found.runs] == [None, None]
    [remark] = [text for text in found.confirm if "copy" in text]
    assert found.confirm[remark] == ("b",)


def test_a_prescribed_force_that_comes_again_is_a_repeat_and_no_copy(tmp_path):
    motion, force = 10 + chirp(1, 20), kelvin_voigt(10 + chirp(1, 20), 1.0)
    ways = {name: motion + 1e-3 * np.random.default_rng(seed).normal(size=TIME.size) for seed, name in enumerate("ab")}
    found = imported(tmp_path, {f"{name}.tab": record(way, force) for name, way in ways.items()})
    assert [run.repeats for run in found.runs] == [None, "a"]
    assert not any("copy" in remark for remark in found.confirm)


def test_units_and_signs_are_those_of_most_files(tmp_path):
    tables = {f"a{size}.tab": table(chirp(1, 20, size), units=False) for size in (0.2, 3.0, 5.0)}
    found = imported(tmp_path, tables)
    assert {run.finding.channels["displacement"].unit.unit for run in found.runs} == {"mm"}
    assert found.runs[0].finding.settings["amplitude"] == pytest.approx(0.2e-3, rel=0.03)


def test_a_file_with_pauses_becomes_several_runs(tmp_path):
    time = np.concatenate([TIME, 30 + TIME])
    motion = np.concatenate([chirp(1, 20), 2 * chirp(1, 20)])
    force = np.concatenate([kelvin_voigt(chirp(1, 20)), kelvin_voigt(2 * chirp(1, 20))])
    found = imported(tmp_path, {"long.tab": Table({"t": time, "x": motion, "F": force})})
    assert [(run.name, run.rows) for run in found.runs] == [("long_1", (1, 5000)), ("long_2", (5001, 10000))]


def test_a_piece_called_as_another_file_is_kept(tmp_path):
    time = np.concatenate([TIME, 30 + TIME])
    twice = {"t": time, "x": np.tile(chirp(1, 20), 2), "F": np.tile(kelvin_voigt(chirp(1, 20)), 2)}
    found = imported(tmp_path, {"long.tab": Table(twice), "long_2.tab": table(2 * chirp(1, 20))})
    assert [run.name for run in found.runs] == ["long_1", "long_2", "long_2_2"]


def test_lines_of_text_at_the_ends_are_cut_off(tmp_path):
    whole = table(chirp(1, 20))
    columns = {name: np.array([np.nan, *values, "end"], dtype=object) for name, values in whole.columns.items()}
    [run] = imported(tmp_path, {"a.tab": Table(columns, whole.units)}).runs
    assert run.rows == (2, 5001) and run.finding.kind == "sweep"


def test_a_rate_given_by_hand_overrules_the_clock(tmp_path):
    [run] = imported(tmp_path, {"a.tab": table(chirp(1, 20))}, sampling=1000.0).runs
    assert run.finding.timing.sampling == 1000.0
    assert run.finding.settings["stop"] == pytest.approx(40, rel=0.03)


def test_a_broken_file_is_left_out_and_told(tmp_path):
    (tmp_path / "broken.tab").write_text("")
    found = imported(tmp_path, {"a.tab": table(chirp(1, 20))})
    assert [run.name for run in found.runs] == ["a"]
    assert str(found.problems[0]) == f"{tmp_path / 'broken.tab'}:3: it is broken. mend it"


def test_what_holds_nothing_is_an_error(tmp_path):
    with pytest.raises(InputError, match="no measured files were found"):
        import_files([tmp_path], {"tab": Tables({})})
    with pytest.raises(InputError, match="there is no such file or folder"):
        import_files([tmp_path / "nothing.tab"], {"tab": Tables({})})
    with pytest.raises(InputError, match="it holds no column of numbers of at least 16 samples"):
        imported(tmp_path, {"a.tab": Table({"t": np.array(["a", "b"], dtype=object)})})


# --- names and text ------------------------------------------------------------------------------------------------


def test_files_come_in_the_order_of_their_numbers_and_patterns_are_understood(tmp_path):
    for name in ("a10.tab", "a2.tab", "notes.md", "dataset.yaml"):
        (tmp_path / name).write_text("")
    readers = {"tab": Tables({})}
    assert [file.name for file in find_files([tmp_path], readers)] == ["a2.tab", "a10.tab"]
    assert [file.name for file in find_files([tmp_path / "a1*.tab"], readers)] == ["a10.tab"]


def test_names_of_runs_are_distinct_and_safe():
    files = [Path("one/a.5.tab"), Path("two/a.5.tab"), Path("two/x?y.tab"), Path("two/a.5.csv")]
    assert list(run_names(files).values()) == ["a.5", "two_a.5", "x_y", "a.5_2"]


@pytest.mark.parametrize(
    "name", ["t", "Weg [mm]", "null", "true", "1", "007", "a: b", "#", "Größe", "x\ny", "-", "1e3"]
)
def test_any_name_survives_the_text(tmp_path, name):
    node = Document.parse(f"key: {quoted(name)}\n").root.entries["key"]
    assert str(node.value) == name


def test_a_name_that_cannot_be_written_is_a_number(tmp_path):
    found = find_all(Table({"t": TIME, "x\x07": chirp(1, 20), "F": kelvin_voigt(chirp(1, 20))}))
    assert (found.column("x\x07"), found.column("F")) == (2, "F")


def test_what_most_runs_have_stands_once(tmp_path):
    motion = chirp(1, 20)
    other = Table({"Zeit": TIME, "Weg": 2 * motion, "Kraft": kelvin_voigt(2 * motion)}, {"Zeit": "s", "Kraft": "N"})
    found = imported(tmp_path, {"a.tab": table(motion), "b.tab": table(3 * motion), "c.tab": other})
    text = dataset_text(found, tmp_path, "rig")
    assert text.count("column: x") == 1 and text.index("column: x") < text.index("\nruns:") < text.index("column: Weg")
    runs = read_dataset_of(tmp_path, text, found)
    assert [np.ptp(run.displacement) for run in runs] == pytest.approx([2e-3, 6e-3, 4e-3], rel=1e-3)


@pytest.mark.parametrize(("column", "units"), [("accel_g", {}), ("accel", {"accel": "g"}), ("ch 4", {"ch 4": "g"})])
def test_an_acceleration_in_g_is_read_in_metres(tmp_path, column, units):
    """Two standard gravities, by what the file says and by what the dataset says."""
    whole = {**table(chirp(1, 20)).columns, column: np.full(TIME.size, 2.0)}
    tables = {"a.tab": Table(whole, {"t": "s", "x": "mm", "F": "N", **units})}
    text = dataset_text(imported(tmp_path, tables), tmp_path, "rig")
    assert "unit: g0}" in text
    (tmp_path / "dataset.yaml").write_text(text)
    (run,) = read_dataset(tmp_path, {"tab": Tables(tables)}).runs
    assert run.channels["acceleration"] == pytest.approx(np.full(TIME.size, 2.0 * 9.80665))


def test_a_sign_is_not_inherited_by_files_of_another_kind(tmp_path):
    motion = 10 + chirp(1, 20)
    turned = [Table({"t": TIME, "x": k * motion, "F": -kelvin_voigt(k * motion)}, {"t": "s", "F": "N"}) for k in (1, 2)]
    other = Table({"Zeit": TIME, "Weg": motion, "Kraft": kelvin_voigt(motion)}, {"Zeit": "s", "Kraft": "N"})
    text = dataset_text(imported(tmp_path, {"a.tab": turned[0], "b.tab": turned[1], "c.tab": other}), tmp_path, "rig")
    assert "defaults" not in text and text.count("sign: -1}") == 2


def read_dataset_of(folder, text, found):
    """The runs of a dataset with this text, over the tables that were imported."""
    (folder / "dataset.yaml").write_text(text)
    tables = {}
    for run in found.runs:
        columns = {"t": TIME, "x": run.finding.signals["displacement"] * 1e3, "F": run.finding.signals["force"]}
        named = dict(zip(run.finding.columns, columns.values(), strict=True))
        tables[run.file.name] = Table(named)
    return read_dataset(folder, {"tab": Tables(tables)}).runs


def test_the_text_tells_what_to_confirm(tmp_path):
    found = imported(tmp_path, {"a.tab": table(10 + chirp(1, 20), units=False), "b.tab": table(10 + chirp(1, 9))})
    text = dataset_text(found, tmp_path, "my rig")
    assert text.startswith(
        "# A first dataset, written by `dashpot import`. Confirm before you trust a result:\n# - CONFIRM "
    )
    assert "displacement: {column: x, unit: mm}   # CONFIRM: the unit, which is not stated" in text
    assert "# - CONFIRM the force is taken to be in N: no unit is stated (a)" in text
    assert "time: {column: t, unit: s}   # CONFIRM: see above" in text
    assert "settings: {amplitude: 1 mm, preload: 10 mm, start: " in text


# --- pairs, conditions, rates --------------------------------------------------------------------------------------


def friction(motion, limit=20.0, holder=4e4):
    """Force in N of a slider of 20 N behind a spring, over a motion in mm: the return mapping of an elastic slider."""
    x, force = motion * 1e-3, np.zeros(motion.size)
    for number in range(1, x.size):
        trial = force[number - 1] + holder * (x[number] - x[number - 1])
        force[number] = min(max(trial, -limit), limit)
    return force


def record(motion, force):
    """Time in s, motion in mm and force in N."""
    return Table({"t": TIME, "x": motion, "F": force}, {"t": "s", "x": "mm", "F": "N"})


def noisy(signal, seed, share=0.01):
    return signal + share * np.std(signal) * np.random.default_rng(seed).standard_normal(signal.size)


def channels(found, number=0):
    return {name: (channel.role.column, channel.sign) for name, channel in found.runs[number].finding.channels.items()}


def test_the_friction_force_is_told_from_the_normal_force(tmp_path):
    """Both have a unit of force; only one is explained by the motion."""
    motion = 5 * np.sin(2 * np.pi * 0.5 * TIME)
    normal = 50 + np.random.default_rng(3).standard_normal(TIME.size)
    columns = {"t": TIME, "ch 1": normal, "ch 2": motion, "ch 3": noisy(friction(motion), 4)}
    found = imported(tmp_path, {"a.tab": Table(columns, {"t": "s", "ch 1": "N", "ch 2": "mm", "ch 3": "N"})})
    assert channels(found)["force"][0] == "ch 3"
    assert not any("about as well" in remark for remark in found.confirm)


def test_columns_with_the_same_names_mean_the_same_in_all_files(tmp_path):
    """Under load a normal force that breathes with the stroke is smoother than the friction it causes, unloaded not."""
    motion = 5 * np.sin(2 * np.pi * 0.5 * TIME)
    units = {"t": "s", "Position": "mm", "Normal Force": "N", "Friction Force": "N"}
    tables = {}
    for load in (10, 20, 400):
        normal = load * (1 + 0.02 * np.sin(2 * np.pi * 0.5 * TIME + 0.4))
        normal += np.random.default_rng(load).normal(0, 0.3, TIME.size)
        sensors = TIME, motion, normal, noisy(friction(motion), load, 0.05)
        tables[f"N{load}.tab"] = Table(dict(zip(units, sensors, strict=True)), units)
    found = imported(tmp_path, tables)
    assert [channels(found, k)["force"][0] for k in range(3)] == ["Friction Force"] * 3
    (about,) = [runs for remark, runs in found.confirm.items() if "'Normal Force' about as well" in remark]
    assert about == ("N400",)


def test_newtons_are_taken_and_not_their_volts(tmp_path):
    """Two columns of one signal, without names: the larger numbers are the force, and that is to be confirmed."""
    motion = 5 * np.sin(2 * np.pi * 0.5 * TIME)
    force = noisy(friction(motion), 5)
    found = imported(
        tmp_path, {"a.tab": Table({"1": TIME, "2": motion / 10, "3": force / 50, "4": motion, "5": force})}
    )
    assert {name: column for name, (column, _) in channels(found).items()} == {"displacement": "4", "force": "5"}
    assert "CONFIRM: the column and the unit" in dataset_text(found, tmp_path, "rig")


def test_columns_as_good_as_the_force_are_to_be_confirmed(tmp_path):
    motion = 5 * np.sin(2 * np.pi * 0.5 * TIME)
    other = noisy(friction(motion, 18.0, 3e4), 7, 0.15)
    found = imported(
        tmp_path, {"a.tab": Table({"t": TIME, "x": motion, "1": noisy(friction(motion), 6, 0.1), "2": other})}
    )
    assert channels(found)["force"][0] == "1"
    assert any("the motion explains '2' about as well as the force '1'" in remark for remark in found.confirm)
    assert "force: {column: 1, unit: N}   # CONFIRM: the column" in dataset_text(found, tmp_path, "rig").replace(
        '"', ""
    )


def test_a_force_that_goes_with_the_rate_is_no_velocity(tmp_path):
    """The force of a damper beside three more columns: its numbers are not those of the rate of change."""
    motion = 5 * np.sin(2 * np.pi * 0.5 * TIME)
    force, hum = noisy(37.0 * np.gradient(motion, STEP), 8, 0.02), noisy(np.sin(99 * TIME), 9)
    table_of = {"1": TIME, "2": motion, "3": force, "4": hum}
    assert channels(imported(tmp_path, {"a.tab": Table(table_of)}))["force"][0] == "3"


def test_files_plugged_the_other_way_round_keep_their_own_columns(tmp_path):
    motion = 5 * np.sin(2 * np.pi * 0.5 * TIME)
    force = noisy(friction(motion), 10)
    ways = {"a.tab": (motion, force), "b.tab": (1.5 * motion, force), "c.tab": (force, motion)}
    ways = {name: Table({"t": TIME, "CH0": first, "CH1": second}) for name, (first, second) in ways.items()}
    found = imported(tmp_path, ways)
    assert [channels(found, k)["force"][0] for k in range(3)] == ["CH1", "CH1", "CH0"]


def test_a_run_with_the_force_turned_gets_its_own_sign_where_it_stands(tmp_path):
    motions = {k: k * chirp(1, 9) for k in (1, 2, 3)}
    forces = {k: (-1 if k == 2 else 1) * kelvin_voigt(motion, damping=3e3) for k, motion in motions.items()}
    tables = {f"r{k}.tab": record(motions[k], forces[k]) for k in motions}
    found = imported(tmp_path, tables)
    assert [channels(found, k)["force"][1] for k in range(3)] == [1, -1, 1]
    (about,) = [runs for remark, runs in found.confirm.items() if "sign is turned" in remark]
    assert about == ("r2",)
    text = dataset_text(found, tmp_path, "rig")
    assert text.count("sign: -1") == 2 and text.index("name: r2") < text.index("sign: -1}") < text.index("name: r3")


def test_a_stiff_run_with_the_force_turned_gets_its_own_sign(tmp_path):
    """Its losses are a fourteenth of its force: it falls, and work would be given back."""
    motions = {k: k * np.sin(2 * np.pi * 1.5 * TIME) for k in (1, 2, 3)}
    forces = {k: (-1 if k == 2 else 1) * noisy(kelvin_voigt(motion, damping=1.5e3), k) for k, motion in motions.items()}
    found = imported(tmp_path, {f"r{k}.tab": record(motions[k], forces[k]) for k in motions})
    assert [channels(found, k)["force"][1] for k in range(3)] == [1, -1, 1]
    assert [runs for remark, runs in found.confirm.items() if "sign is turned" in remark] == [("r2",)]
    text = dataset_text(found, tmp_path, "rig")
    assert text.count("unit: N, sign: -1}   # CONFIRM: the sign") == 1


@pytest.mark.parametrize("mass", [0.0, 2000.0])
def test_a_force_that_falls_in_one_run_alone_is_to_be_confirmed(tmp_path, mass):
    """A run without losses may be turned; one whose mass outweighs the spring falls with its losses as they are."""
    motions = {k: k * np.sin(2 * np.pi * (3 if k == 2 else 1) * TIME) for k in (1, 2, 3)}
    forces = {k: kelvin_voigt(motion, damping=20.0 if mass else 0.0) for k, motion in motions.items()}
    forces[2] = forces[2] - (mass * 2e-3 * (6 * np.pi) ** 2 * np.sin(6 * np.pi * TIME) if mass else 2 * forces[2])
    found = imported(tmp_path, {f"r{k}.tab": record(motions[k], forces[k]) for k in motions})
    assert [channels(found, k)["force"][1] for k in range(3)] == [1, 1, 1]
    told = [runs for remark, runs in found.confirm.items() if "falls where the deflection grows, other than" in remark]
    assert told == [("r2",)]


@pytest.mark.parametrize(
    ("name", "stated"),
    [
        ("25mm0x5Hz0x25A", {"current": "0.25 A"}),
        ("bush_-20degC_2", {"temperature": "-20 degC"}),
        ("seal 3bar", {"pressure": "3 bar"}),
        ("O-ring257_1bar", {"pressure": "1 bar"}),
        ("valve_2,5V", {"voltage": "2.5 V"}),
        ("damper_click5", {"clicks": "5"}),
        ("12 Klicks 50mm", {"clicks": "12"}),
        ("Ventil_2_1", {"valve_position": "2"}),
        ("valves3", {}),
        ("12clickstop", {}),
        ("a1_p2_up", {}),
        ("run12_1Hz_5mm", {}),
        ("2Apr", {}),
    ],
)
def test_conditions_in_names(name, stated):
    assert conditions_of(name) == stated


def test_runs_under_other_conditions_are_no_repeats(tmp_path):
    motion = 10 + chirp(1, 20)
    tables = {f"bush_{t}degC.tab": record(motion, kelvin_voigt(motion, 1.0) + t * 1e-3) for t in (20, 40)}
    found = imported(tmp_path, tables)
    assert [run.repeats for run in found.runs] == [None, None]
    text = dataset_text(found, tmp_path, "rig")
    assert "temperature: 20 degC" in text and "temperature: 40 degC" in text
    found = imported(tmp_path, {f"bush_{t}.tab": part for t, part in zip("ab", tables.values(), strict=True)})
    assert [run.repeats for run in found.runs if run.name == "bush_b"] == ["bush_a"]


def test_clicks_of_a_valve_in_the_names_are_settings_and_no_repeats(tmp_path):
    motion = 10 + chirp(1, 20)
    tables = {f"damper_click{k}.tab": record(motion, kelvin_voigt(motion, 1.0) + 1e-3 * k) for k in (1, 5)}
    found = imported(tmp_path, tables)
    assert [run.repeats for run in found.runs] == [None, None]
    assert "clicks: 5}" in dataset_text(found, tmp_path, "rig")


@pytest.mark.parametrize(("second", "repeats"), [(20.5, "a"), (60.0, None)])
def test_runs_at_other_measured_temperatures_are_no_repeats(tmp_path, second, repeats):
    """Half a kelvin is the room, forty are another test; the thermometer scatters by a tenth."""
    motion, noise = 10 + chirp(1, 20), 0.1 * np.random.default_rng(2).normal(size=TIME.size)
    tables = {}
    for name, celsius in (("a", 20.0), ("b", second)):
        force = kelvin_voigt(motion, 1.0) + celsius * 1e-3
        tables[f"{name}.tab"] = Table(
            {"t": TIME, "x": motion, "F": force, "temp": celsius + noise},
            {"t": "s", "x": "mm", "F": "N", "temp": "degC"},
        )
    assert imported(tmp_path, tables).runs[1].repeats == repeats


def test_a_stated_unit_that_is_no_force_asks_for_its_gain(tmp_path):
    motion = 10 + chirp(1, 9)
    columns = {"t": TIME, "Weg": motion, "Kraft": kelvin_voigt(motion) / 500.0}
    table = Table(columns, {"t": "s", "Weg": "mm", "Kraft": "V"})
    found = imported(tmp_path, {"a.tab": table})
    (remark,) = [remark for remark in found.confirm if "is in V" in remark]
    assert "'Kraft'" in remark and "'gain'" in remark
    assert "# CONFIRM: the column and the gain, as the file states V" in dataset_text(found, tmp_path, "rig")


def test_of_runs_at_other_rates_only_the_slowest_is_quasi_static(tmp_path):
    """Two triangles each, of 64, 16 and 4 s."""
    tables = {}
    for rate in (1, 4, 16):
        time = np.linspace(0.0, 128.0 / rate, 4000)
        motion = 10.0 * np.abs((time * rate / 32.0) % 2.0 - 1.0)
        tables[f"v{rate}.tab"] = Table(
            {"t": time, "x": motion, "F": 200.0 * motion + 5.0 * np.gradient(motion, time)},
            {"t": "s", "x": "mm", "F": "N"},
        )
    found = imported(tmp_path, tables)
    assert {run.name: run.finding.kind for run in found.runs} == {
        "v1": "quasi_static",
        "v4": "transient",
        "v16": "transient",
    }


def test_the_noise_of_a_sensor_makes_no_run_fast(tmp_path):
    """Two sines of 20 s, one of a thirteenth of the stroke: from sample to sample its sensor goes farther than it."""
    tables = {}
    for name, amplitude in (("large", 4.0), ("small", 0.3)):
        motion = amplitude * np.sin(2 * np.pi * 0.1 * TIME)
        scatter = 1.5e-3 * np.random.default_rng(11).standard_normal(TIME.size)
        columns = {"t": 2.0 * TIME, "x": motion + scatter, "F": kelvin_voigt(motion)}
        tables[f"{name}.tab"] = Table(columns, {"t": "s", "x": "mm", "F": "N"})
        assert np.mean(np.abs(np.diff(scatter))) > 2.0 * 0.3 * np.mean(np.abs(np.diff(motion / amplitude)))
    assert [run.finding.kind for run in imported(tmp_path, tables).runs] == ["quasi_static", "quasi_static"]


def beside(column, level, unit="", noise=0.0, seed=0):
    """A run of the same spring and dashpot with a further column about a level."""
    motion = 10 + chirp(1, 20)
    chance = np.random.default_rng(seed + 1)
    columns = {"t": TIME, "x": motion, "F": kelvin_voigt(motion, 0.5) + chance.normal(size=TIME.size)}
    further = np.full(TIME.size, level) + noise * chance.standard_normal(TIME.size)
    units = {"t": "s", "x": "mm", "F": "N"} | ({column: unit} if unit else {})
    return Table({**columns, column: further}, units)


@pytest.mark.parametrize(
    ("column", "unit", "levels", "noise", "repeats"),
    [
        ("current", "A", (0.5, 1.125), 0.0, None),
        ("valve opening", "%", (20.0, 45.0), 0.2, None),
        ("AI 7", "", (20.0, 45.0), 0.2, None),
        ("AI 7", "", (20.0, 20.8), 0.0, "a"),  # a thermometer without its unit
        ("oil", "degC", (20.0, 24.0), 0.0, "a"),
        ("AI 7", "V", (0.0, 0.01), 0.02, "a"),  # the scatter of a channel without a sensor
        ("run no", "", (1.0, 2.0), 0.0, "a"),
    ],
)
def test_any_column_at_another_level_says_that_two_runs_are_no_repeats(tmp_path, column, unit, levels, noise, repeats):
    tables = {
        f"{name}.tab": beside(column, level, unit, noise, seed)
        for seed, (name, level) in enumerate(zip("ab", levels, strict=True))
    }
    found = imported(tmp_path, tables)
    assert found.runs[1].repeats == repeats
    told = [runs for remark, runs in found.confirm.items() if "has the motion and force of an earlier one" in remark]
    assert told == ([] if repeats else [("b",)])


def test_a_column_that_goes_on_from_run_to_run_is_no_condition(tmp_path):
    tables = {}
    for number, name in enumerate("ab"):
        table = beside("clock of the rig", 0.0, seed=number)
        tables[f"{name}.tab"] = Table(
            {**table.columns, "clock of the rig": 2 * number * TIME[-1] + np.floor(TIME)}, table.units
        )
    assert imported(tmp_path, tables).runs[1].repeats == "a"


@pytest.mark.parametrize(
    ("column", "unit", "found"),
    [
        ("current", "A", ["current"]),
        ("Strom", "mA", ["Strom"]),
        ("Kraft", "mA", []),  # 4 to 20 mA
        ("current position", "mm", []),
        ("current", "", []),
    ],
)
def test_a_current_is_known_by_name_and_unit(column, unit, found):
    roles = named_roles([column], {column: unit} if unit else {})
    assert [role.column for channel, role in roles.items() if channel == "current"] == found

"""A dataset is read as its file declares it: units, signs, groups, pieces, delays; everything SI."""

from __future__ import annotations

import textwrap
from pathlib import Path

import numpy as np
import pytest

from dashpot.data.dataset import Dataset, read_dataset
from dashpot.text.problem import InputError
from dashpot_formats import dashpot_formats

READERS = {reader.word: reader() for reader in dashpot_formats()}
COUNT = 400
TIME = np.arange(COUNT) / 1000
MOTION = 3.0 * np.sin(2 * np.pi * 5 * TIME)
FORCE = 100 * MOTION + 7.0 * np.cos(2 * np.pi * 5 * TIME)

HEAD = """\
format: dashpot-dataset/1
name: test
defaults:
  kind: sweep
  channels:
    time: {column: t, unit: s}
    displacement: {column: x, unit: mm}
    force: {column: F, unit: N}
"""


def write_run(folder: Path, name: str, **columns: np.ndarray) -> None:
    np.savez(folder / name, **({"t": TIME, "x": MOTION, "F": FORCE} | columns))


def read(folder: Path, runs: str, head: str = HEAD) -> Dataset:
    (folder / "dataset.yaml").write_text(head + "runs:\n" + textwrap.indent(textwrap.dedent(runs), "  "))
    return read_dataset(folder, READERS)


def test_channels_come_in_si_on_a_time_that_starts_at_zero(tmp_path):
    write_run(tmp_path, "a.npz", t=TIME + 5.0)
    dataset = read(tmp_path, "- {name: a, file: a.npz}")
    run = dataset.run("a")
    assert dataset.problems == ()
    assert (run.name, run.kind, run.group, run.source, run.order) == ("a", "sweep", "a", "a.npz", 0)
    assert run.sample_time == 0.001 and run.time[0] == 0.0
    assert np.allclose(run.time, TIME, atol=1e-12)
    assert np.allclose(run.displacement, MOTION / 1000, rtol=1e-15)
    assert np.array_equal(run.force, FORCE)


def test_a_run_cannot_be_changed(tmp_path):
    write_run(tmp_path, "a.npz")
    run = read(tmp_path, "- {name: a, file: a.npz}").run("a")
    for values in (run.time, run.force, run.displacement):
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 1.0


def test_a_value_is_sign_times_gain_times_raw_minus_offset(tmp_path):
    write_run(tmp_path, "a.npz")
    runs = "- {file: a.npz, channels: {force: {unit: kN, sign: -1, gain: 102 %, offset: 30 N}}}"
    assert np.allclose(read(tmp_path, runs).run("a").force, -1.02 * FORCE * 1000 - 30, rtol=1e-14)


def test_a_run_overrules_the_defaults_key_by_key(tmp_path):
    write_run(tmp_path, "a.npz", G=2 * FORCE)
    run = read(tmp_path, "- {file: a.npz, kind: random, channels: {force: {column: G}}}").run("a")
    assert run.kind == "random"
    assert np.array_equal(run.force, 2 * FORCE)
    assert np.allclose(run.displacement, MOTION / 1000)


@pytest.mark.parametrize("place", ["sampling: 500 Hz", "sampling: 500", "channels: {sampling: 0.5 kHz}"])
def test_a_sampling_rate_stands_in_for_the_time_channel(tmp_path, place):
    write_run(tmp_path, "a.npz")
    run = read(tmp_path, f"- {{file: a.npz, {place}}}").run("a")
    assert run.sample_time == 0.002 and run.time.size == COUNT


def test_a_run_with_a_time_channel_does_not_inherit_the_sampling_rate(tmp_path):
    write_run(tmp_path, "a.npz")
    head = HEAD.replace("    time: {column: t, unit: s}\n", "    sampling: 500 Hz\n")
    assert read(tmp_path, "- {file: a.npz, channels: {time: {column: t, unit: s}}}", head).run("a").sample_time == 0.001
    assert read(tmp_path, "- {file: a.npz}", head).run("a").sample_time == 0.002


def test_columns_are_named_or_counted(tmp_path):
    write_run(tmp_path, "a.npz")
    runs = "- {file: a.npz, channels: {time: 1, displacement: {column: 2}, force: F}}"
    run = read(tmp_path, runs, "format: dashpot-dataset/1\ndefaults: {kind: sweep}\n").run("a")
    assert np.array_equal(run.displacement, MOTION)


def test_the_unit_of_the_file_counts_where_the_dataset_is_silent(tmp_path):
    rows = "".join(f"{t};{x};{f}\n" for t, x, f in zip(TIME, MOTION, FORCE, strict=True))
    (tmp_path / "a.csv").write_text("t;x;F\ns;mm;kN\n" + rows)
    head = "format: dashpot-dataset/1\ndefaults: {kind: sweep, channels: {time: t, displacement: x, force: F}}\n"
    run = read(tmp_path, "- {file: a.csv}", head).run("a")
    assert np.allclose(run.force, FORCE * 1000) and np.allclose(run.displacement, MOTION / 1000)


def test_a_celsius_channel_becomes_kelvin(tmp_path):
    write_run(tmp_path, "a.npz", T=np.linspace(20, 30, COUNT))
    run = read(tmp_path, "- {file: a.npz, channels: {temperature: {column: T, unit: degC}}}").run("a")
    assert np.allclose(run.channels["temperature"], np.linspace(293.15, 303.15, COUNT))


def test_a_channel_of_any_other_kind_is_kept_in_base_units(tmp_path):
    write_run(tmp_path, "a.npz", Q=np.linspace(0, 1, COUNT))
    run = read(tmp_path, "- {file: a.npz, channels: {torque: {column: Q, unit: kN*mm, offset: 1 Nm}}}").run("a")
    assert np.allclose(run.channels["torque"], np.linspace(-1, 0, COUNT))


def test_channels_at_nodes_need_no_displacement_or_force(tmp_path):
    write_run(tmp_path, "a.npz")
    runs = """\
    - file: a.npz
      kind: sweep
      channels:
        time: {column: t}
        displacement@platform_left: {column: x, unit: mm}
        force@platform_left: {column: F, unit: N}
    """
    run = read(tmp_path, runs, "format: dashpot-dataset/1\n").run("a")
    assert set(run.channels) == {"displacement@platform_left", "force@platform_left"}
    with pytest.raises(KeyError):
        _ = run.force


def test_settings_are_si_and_words_are_notes(tmp_path):
    write_run(tmp_path, "a.npz")
    settings = "amplitude: 1 mm, preload: 15 mm, start: 1 Hz, stop: 25, pressure: 2.5 bar, lap: 3, surface: dry"
    run = read(tmp_path, f"- {{file: a.npz, settings: {{{settings}}}}}").run("a")
    expected = {"amplitude": 1e-3, "preload": 0.015, "start": 1.0, "stop": 25.0, "pressure": 2.5e5, "lap": 3.0}
    assert dict(run.settings) == pytest.approx(expected)
    assert dict(run.notes) == {"surface": "dry"}


def test_sensors_are_inherited_and_si(tmp_path):
    write_run(tmp_path, "a.npz")
    head = HEAD + "sensors:\n  force: {gain: 0.2 %, zero: 3 N, delay: 50 us, noise: 0.005 kN, compliance: 2 nm/N}\n"
    run = read(tmp_path, "- {file: a.npz, sensors: {force: {noise: 6 N}, displacement: {zero: 1 um}}}", head).run("a")
    expected = {"gain": 0.002, "zero": 3.0, "delay": 50e-6, "noise": 6.0, "compliance": 2e-9}
    assert run.sensors["force"] == pytest.approx(expected)
    assert run.sensors["displacement"] == {"zero": 1e-6}


def test_repeats_share_group_settings_and_hold_out(tmp_path):
    for name in "abcd":
        write_run(tmp_path, f"{name}.npz")
    dataset = read(
        tmp_path,
        """\
        - {file: a.npz, settings: {amplitude: 1 mm, preload: 9 mm}, held_out: true}
        - {file: b.npz, repeats: a, settings: {preload: 8 mm}}
        - {file: c.npz, repeats: b}
        - {file: d.npz}
        """,
    )
    assert [(run.name, run.group, run.repeats, run.held_out) for run in dataset.runs] == [
        ("a", "a", None, True),
        ("b", "a", "a", True),
        ("c", "a", "a", True),
        ("d", "d", None, None),
    ]
    assert dict(dataset.run("b").settings) == pytest.approx({"amplitude": 1e-3, "preload": 8e-3})


def test_pieces_of_one_file_by_rows_and_by_time(tmp_path):
    write_run(tmp_path, "a.npz")
    dataset = read(
        tmp_path,
        """\
        - {name: rows, file: a.npz, rows: [101, 200]}
        - {name: rest, file: a.npz, rows: [301, null]}
        - {name: time, file: a.npz, start: 100 ms, stop: 0.199 s}
        - {name: counted, file: a.npz, sampling: 100 Hz, start: 1 s, stop: 1.99 s}
        """,
    )
    assert np.array_equal(dataset.run("rows").force, FORCE[100:200])
    assert np.array_equal(dataset.run("rest").force, FORCE[300:])
    assert np.array_equal(dataset.run("time").force, FORCE[100:200])
    assert np.array_equal(dataset.run("counted").force, FORCE[100:200])
    assert all(run.time[0] == 0.0 for run in dataset.runs)


@pytest.mark.parametrize("lag", [0.0004, 0.0023, -0.0017])
def test_a_delay_is_taken_out_between_the_samples(tmp_path, lag):
    def true_force(time):
        return 400 * np.cos(2 * np.pi * 5 * time) + 50 * np.sin(2 * np.pi * 20 * time + 1)

    write_run(tmp_path, "a.npz", F=true_force(TIME - lag))
    run = read(tmp_path, f"- {{file: a.npz, channels: {{force: {{delay: {lag} s}}}}}}").run("a")
    lost = int(np.ceil(abs(lag) * 1000))
    kept = slice(0, COUNT - lost) if lag > 0 else slice(lost, COUNT)
    assert run.time.size == COUNT - lost
    assert np.allclose(run.displacement, MOTION[kept] / 1000)
    # without correction the error would be above 25 N
    assert np.abs(run.force - true_force(TIME[kept])).max() < 0.02


def test_decimation_keeps_the_band_and_its_phase_and_removes_what_would_alias(tmp_path):
    time = np.arange(4000) / 1000
    slow, fast = np.sin(2 * np.pi * 12 * time + 0.3), np.sin(2 * np.pi * 240 * time)
    np.savez(tmp_path / "a.npz", t=time, x=slow, F=slow + fast)
    run = read(tmp_path, "- {file: a.npz, decimate: 5}").run("a")
    inner = slice(100, -100)
    assert run.sample_time == pytest.approx(0.005) and run.time.size == 800
    assert np.abs(run.force - slow[::5])[inner].max() < 2e-4
    assert np.abs(run.force - slow[::5]).max() < 0.2


def test_a_single_file_with_a_sidecar_is_a_dataset(tmp_path):
    write_run(tmp_path, "loop.npz")
    (tmp_path / "loop.npz.yaml").write_text(
        "format: dashpot-dataset/1\nkind: sweep\nsampling: 1 kHz\nsensors: {force: {zero: 2 N}}\n"
        "channels: {displacement: {column: x, unit: mm}, force: {column: F, unit: N}}\n"
    )
    for path in (tmp_path / "loop.npz", tmp_path / "loop.npz.yaml"):
        dataset = read_dataset(path, READERS)
        assert dataset.name == "loop" and [run.name for run in dataset.runs] == ["loop"]
        assert dataset.runs[0].sensors == {"force": {"zero": 2.0}}


def test_a_reader_may_be_named_and_given_options(tmp_path):
    np.savez(tmp_path / "a.npz", m=np.column_stack([TIME, MOTION, FORCE]))
    (tmp_path / "a.npz").rename(tmp_path / "a.bin")
    runs = "- {file: a.bin, reader: npz, file_options: {variable: m}, channels: {displacement: 2, force: 3}}"
    run = read(tmp_path, runs, "format: dashpot-dataset/1\ndefaults: {kind: sweep, sampling: 1 kHz}\n").run("a")
    assert np.array_equal(run.force, FORCE)


def test_the_digest_tells_measurements_apart_and_knows_no_paths(tmp_path):
    digests = []
    for folder, force in (("one", FORCE), ("two", FORCE), ("three", np.nextafter(FORCE, np.inf))):
        (tmp_path / folder).mkdir()
        write_run(tmp_path / folder, f"{folder}.npz", F=force)
        digests.append(read(tmp_path / folder, f"- {{name: a, file: {folder}.npz}}").digest)
    assert digests[0] == digests[1] != digests[2]
    assert len(digests[0]) == 64
    again = read(tmp_path / "one", "- {name: a, file: one.npz, settings: {amplitude: 1 mm}}")
    assert again.digest not in digests


def test_runs_are_chosen_by_name_and_by_kind(tmp_path):
    write_run(tmp_path, "a.npz")
    kinds = ("quasi_static", "sweep", "hold", "harmonic")
    dataset = read(tmp_path, "".join(f"- {{name: {kind}, file: a.npz, kind: {kind}}}\n" for kind in kinds))
    assert [run.name for run in dataset.dynamic()] == ["sweep", "harmonic"]
    assert [run.name for run in dataset.quasi_static()] == ["quasi_static"]
    chosen = dataset.select(["harmonic", "sweep"])
    assert [run.name for run in chosen.runs] == ["sweep", "harmonic"]
    assert chosen.digest != dataset.digest
    with pytest.raises(InputError, match="the dataset 'test' has no run 'swep'. did you mean 'sweep'?"):
        dataset.run("swep")
    with pytest.raises(InputError, match="no run 'x'"):
        dataset.select(["x"])


def test_a_file_that_several_runs_are_cut_from_is_read_once(tmp_path):
    write_run(tmp_path, "a.npz")
    calls = []

    class Counting(type(READERS["npz"])):
        def read(self, path, options):
            calls.append(path)
            return super().read(path, options)

    text = HEAD + "runs:\n  - {name: a, file: a.npz, rows: [1, 99]}\n  - {name: b, file: a.npz, rows: [100, 200]}\n"
    (tmp_path / "dataset.yaml").write_text(text)
    read_dataset(tmp_path, {"npz": Counting()})
    assert len(calls) == 1

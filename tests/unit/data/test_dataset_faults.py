"""Every fault of a dataset is told with its place and what to do; the run is set aside, the others go on."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from dashpot.data.dataset import Dataset, read_dataset
from dashpot.text.problem import InputError
from dashpot_formats import dashpot_formats

READERS = {reader.word: reader() for reader in dashpot_formats()}
COUNT = 200
TIME = np.arange(COUNT) / 1000
MOTION = 3.0 * np.sin(2 * np.pi * 5 * TIME)
FORCE = 100 * MOTION + 7.0 * np.cos(2 * np.pi * 5 * TIME)

HEAD = """\
format: dashpot-dataset/1
defaults:
  kind: sweep
  channels:
    time: {column: t, unit: s}
    displacement: {column: x, unit: mm}
    force: {column: F, unit: N}
runs:
  - {name: good, file: good.npz}
"""
LINE = HEAD.count("\n") + 1


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_run(tmp_path, "good.npz")
    return tmp_path


def write_run(folder: Path, name: str, **columns: np.ndarray) -> None:
    np.savez(folder / name, **({"t": TIME, "x": MOTION, "F": FORCE} | columns))


def write_csv(folder: Path, name: str, rows: list[str], head: str = "t;x;F\n") -> None:
    (folder / name).write_text(head + "".join(row + "\n" for row in rows))


def csv_rows() -> list[str]:
    return [f"{t};{x};{f}" for t, x, f in zip(TIME, MOTION, FORCE, strict=True)]


def read(folder: Path, text: str) -> Dataset:
    (folder / "dataset.yaml").write_text(text)
    return read_dataset(folder, READERS)


def told(folder: Path, run: str) -> str:
    """The problems when `run` is added to a dataset whose other run is sound."""
    dataset = read(folder, HEAD + f"  - {{{run}}}\n")
    assert [run.name for run in dataset.runs] == ["good"]
    assert all(problem.severity == "error" for problem in dataset.problems)
    return "\n".join(str(problem) for problem in dataset.problems)


# the place that has to be told is the one behind the sign ^
@pytest.mark.parametrize(
    ("run", "message"),
    [
        ("file: ^zzz", "run 'zzz' (zzz) is set aside: there is no such file. check the name and the folder"),
        ("file: ^god.npz", "there is no such file. did you mean 'good.npz'?"),
        ("name: ^good, file: good.npz", "run 'good' is set aside: a run in line 9 has the same name. rename one"),
        ("name: b, file: good.npz, repeats: ^gooood", "repeats 'gooood', which is no run here. did you mean 'good'?"),
        ("name: b, file: good.npz, repeats: ^b", "it repeats 'b', which repeats it again. name the first"),
        ("name: b, file: good.npz, kind: ^swep", "'kind': expected one of quasi_static, sweep, harmonic"),
        ("name: b, file: good.npz, kind: ^Sine", "got 'Sine'; did you mean 'harmonic'?"),
        ("name: b, file: good.npz, ^setings: {}", "the run 'b' has no key 'setings'. did you mean 'settings'?"),
        ("name: b, file: good.npz, settings: {amplitude: ^3 N}", "'amplitude': expected a quantity in m, got 'N'"),
        ("name: b, file: good.npz, settings: ^[1]", "expected the run 'b', 'settings' as 'key: value' lines"),
        ("name: b, file: good.npz, held_out: ^on", "'held_out': expected true or false, got the text 'on'"),
        ("name: b, file: good.npz, rows: ^[5]", "'rows': expected [first, last], got a list of 1"),
        ("name: b, file: good.npz, rows: ^[5, 4]", "'rows': expected [first, last] counted from 1, got [5, 4]"),
        ("name: b, file: good.npz, rows: ^[1, 999]", "it has 200 rows, 'rows' asks for 1 to 999. rows count from 1"),
        ("name: b, file: ^good.npz, rows: [1, 15]", "it has 15 samples, expected at least 16. check 'rows'"),
        ("name: b, file: good.npz, start: ^9 s", "'start' and 'stop' leave nothing of its 0 to 0.199 s"),
        ("name: b, file: good.npz, decimate: ^2.5", "'decimate': expected a whole number, got the number '2.5'"),
        ("name: b, file: good.npz, decimate: ^0", "'decimate': expected a whole number from 1 to 1000, got 0"),
        ("name: b, file: ^good.npz, decimate: 20", "it has 10 samples, expected at least 16"),
        ("name: b, file: good.npz, accept: ^[noise]", "expected some of clipping, units, triage, got 'noise'"),
        ("name: b, file: good.npz, reader: ^npy", "there is no reader 'npy'. did you mean 'npz'?"),
        ("name: b, file: ^dataset.yaml", "no reader takes files ending in '.yaml'. say 'reader: ...'; there are: csv"),
        (
            "name: b, file: ^good.npz, file_options: {variabel: x}",
            "no file option 'variabel'. did you mean 'variable'",
        ),
        ("name: b, file: good.npz, file_options: ^3", "'file_options': expected options as 'key: value'"),
        ("name: ^a/b, file: good.npz", "'a/b' cannot be the name of a run. leave out"),
        ("name: ^.b, file: good.npz", "'.b' cannot be the name of a run. leave out"),
        ("name: b, file: ^../good.npz", "it lies outside the folder of the dataset. move it there, or say"),
        ('name: b, file: ^"a\\0b"', "'file': expected a text without control characters, got 'a\\x00b'"),
        (f"name: b, file: ^{'x' * 300}.csv", "this cannot be a file"),
        ("name: b, file: ^/etc/passwd", "it lies outside the folder of the dataset"),
        ("name: b, file: good.npz, sampling: ^0", "expected a sampling rate above 0, got 0 Hz"),
        ("name: b, file: good.npz, sampling: ^1 ms", "'sampling': expected a quantity in Hz, got 'ms'"),
        ("name: b, file: good.npz, sampling: 9, channels: ^{time: t}", "has a time channel and a sampling rate"),
        ("name: b, file: good.npz, sensors: {force: {^gian: 1}}", "has no key 'gian'. did you mean 'gain'?"),
        ("name: b, file: good.npz, channels: {force: {column: ^G}}", "no column 'G'. its columns are 't', 'x', 'F'"),
        ("name: b, file: good.npz, channels: {force: ^4}", "3 columns, there is no column 4. columns count from 1"),
        ("name: b, file: good.npz, channels: {force: {unit: ^mm}}", "'force': expected a quantity in N, got 'mm'"),
        ("name: b, file: good.npz, channels: {force: {unit: ^Nn}}", "the channel 'force': unknown unit 'Nn'"),
        ("name: b, file: good.npz, channels: {force: {sign: ^2}}", "expected 1 or -1, got 2; any other factor is"),
        ("name: b, file: good.npz, channels: {force: {^sgin: -1}}", "the channel 'force' has no key 'sgin'. did you"),
        ("name: b, file: good.npz, channels: {force: {delay: ^3 mm}}", "expected a quantity in s, got 'mm'"),
        ("name: b, file: ^good.npz, channels: {force: {delay: 150 ms}}", "a delay of 150 samples leaves too little"),
        ("name: b, file: good.npz, channels: {Q: {column: 1, unit: ^blub}}", "the channel 'Q': unknown unit 'blub'"),
    ],
)
def test_what_is_wrong_with_a_declaration_is_told(folder, run, message):
    text = told(folder, run.replace("^", ""))
    assert message in text
    assert f"dataset.yaml:{LINE}:{run.index('^') + 6}: " in text
    assert text.count("\n") == 0


def test_a_run_without_a_file_is_told(folder):
    assert f"dataset.yaml:{LINE}:5: the run 'b' lacks 'file'. add a line 'file: ...'" in told(folder, "name: b")


def test_all_mistakes_of_a_run_are_told_at_once(folder):
    text = told(
        folder, "file: good.npz, name: b, kind: x, setings: 1, decimate: x, channels: {force: {unit: s, gain: q}}"
    )
    for key in ("'kind'", "'setings'", "'decimate'", "got 's'", "'gain'"):
        assert key in text


def test_all_columns_that_are_missing_are_told_at_once(folder):
    text = told(folder, "name: b, file: good.npz, channels: {force: G, displacement: y}")
    assert "no column 'G'" in text and "no column 'y'" in text


def test_a_mistake_in_the_defaults_is_told_once(folder):
    with pytest.raises(InputError) as caught:
        read(folder, HEAD.replace("unit: N", "unit: Nm") + "  - {name: b, file: good.npz}\n")
    assert len(caught.value.problems) == 1
    assert "dataset.yaml:7:30: the channel 'force': expected a quantity in N, got 'Nm'" in str(caught.value)


@pytest.mark.parametrize("channel", ["displacement", "force"])
def test_displacement_and_force_are_needed(folder, channel):
    with pytest.raises(InputError) as caught:
        read(folder, HEAD.replace(f"    {channel}:", f"    {channel[:-1]}:"))
    assert f"has no channel '{channel}'. add '{channel}: {{column: ..., unit: " in str(caught.value)
    assert f"declared here: 'time', '{channel[:-1]}'" in str(caught.value) or f"'{channel[:-1]}'" in str(caught.value)


def test_neither_time_nor_sampling_is_told(folder):
    with pytest.raises(InputError, match="it has no time: no time channel, no sampling rate. add 'time:"):
        read(folder, HEAD.replace("    time: {column: t, unit: s}\n", ""))


def test_a_number_that_cannot_be_read_is_told_with_its_line(folder):
    rows = csv_rows()
    rows[57] = "0.057;1,2,3;4"
    rows[99] = "0.099;oops;4"
    write_csv(folder, "b.csv", rows)
    text = told(folder, "file: b.csv")
    assert "expected a number in column 'x', got '1,2,3' in line 59 (row 58), and 1 more. cut it off" in text


def test_a_text_in_a_column_that_nobody_asks_for_does_no_harm(folder):
    write_csv(folder, "b.csv", [row + ";12:00:01" for row in csv_rows()], "t;x;F;clock\n")
    dataset = read(folder, HEAD + "  - {file: b.csv}\n")
    assert [run.name for run in dataset.runs] == ["good", "b"]


def test_a_bad_line_may_be_cut_off(folder):
    write_csv(folder, "b.csv", csv_rows() + ["End of test, operator Meier"])
    assert "got 'End of test, operator Meier' in line 202" in told(folder, "file: b.csv")
    dataset = read(folder, HEAD + "  - {file: b.csv, rows: [1, 200]}\n")
    assert np.allclose(dataset.run("b").force, FORCE)


def test_a_time_of_day_is_a_clock(folder):
    write_csv(folder, "b.csv", [f"12:00:{t:06.3f};{x};{f}" for t, x, f in zip(TIME, MOTION, FORCE, strict=True)])
    dataset = read(folder, HEAD + "  - {file: b.csv}\n")
    assert not dataset.problems
    assert dataset.run("b").sample_time == pytest.approx(TIME[1] - TIME[0], rel=1e-6)


@pytest.mark.parametrize(("channel", "bad"), [("x", np.nan), ("F", np.inf), ("t", np.nan)])
def test_holes_are_told_with_their_row(folder, channel, bad):
    values = {"t": TIME, "x": MOTION, "F": FORCE}[channel].copy()
    values[[70, 90]] = bad
    write_run(folder, "b.npz", **{channel: values})
    assert "has no number (empty, NaN or infinite) in row 71, and 1 more. cut a whole piece" in told(
        folder, "file: b.npz"
    )


def test_a_hole_outside_the_chosen_piece_does_no_harm(folder):
    force = FORCE.copy()
    force[:10] = np.nan
    write_run(folder, "b.npz", F=force)
    assert len(read(folder, HEAD + "  - {file: b.npz, rows: [11, 200]}\n").runs) == 2
    assert len(read(folder, HEAD + "  - {file: b.npz, start: 10 ms}\n").runs) == 2


def test_a_unit_that_contradicts_the_file_is_told(folder):
    write_csv(folder, "b.csv", csv_rows(), "t [s];x [mm];F [kN]\n")
    text = told(folder, "file: b.csv")
    assert "column 'F' is in 'kN' after its file, in 'N' after the dataset. correct the unit, or write" in text
    accepted = read(folder, HEAD + "  - {file: b.csv, accept: [units]}\n")
    assert np.allclose(accepted.run("b").force, FORCE)


def test_a_unit_that_the_file_spells_otherwise_does_no_harm(folder):
    write_csv(folder, "b.csv", csv_rows(), "t [sec];x [Millimeter];F [N]\n")
    assert len(read(folder, HEAD + "  - {file: b.csv}\n").runs) == 2


def test_an_unknown_unit_of_the_file_is_told_where_the_dataset_is_silent(folder):
    write_csv(folder, "b.csv", csv_rows(), "t [s];x [mm];F [Kraft]\n")
    text = told(folder, "file: b.csv, channels: {force: F}")
    assert "column 'F': unknown unit 'Kraft'" in text and "say the unit of 'force' in the dataset" in text


def test_a_motion_that_never_moves_is_told(folder):
    write_run(folder, "b.npz", x=np.full(COUNT, 2.0))
    assert "its displacement is 0.002 m all the time. check the column" in told(folder, "file: b.npz")


def test_a_dead_force_is_worth_a_warning(folder):
    write_run(folder, "b.npz", F=np.full(COUNT, 3.0))
    dataset = read(folder, HEAD + "  - {file: b.npz}\n")
    assert len(dataset.runs) == 2
    assert "warning: run 'b' (b.npz): its force is 3 N all the time" in str(dataset.problems[0])


def test_columns_of_different_length_are_told(folder):
    write_run(folder, "b.npz", F=FORCE[:-1])
    assert "its columns differ in length: 't' 200, 'x' 200, 'F' 199" in told(folder, "file: b.npz")


def test_a_broken_file_is_told(folder):
    (folder / "b.npz").write_bytes(b"broken")
    assert "run 'b' (b.npz) is set aside: it is not a sound file of numpy arrays" in told(folder, "file: b.npz")


def test_a_line_that_the_reader_cannot_read_is_told(folder):
    rows = csv_rows()
    rows[9] += ";" + rows[10]
    write_csv(folder, "b.csv", rows)
    assert "run 'b' (b.csv) is set aside: line 11: expected 3 values, got 6" in told(folder, "file: b.csv")


def test_repeats_of_a_run_that_is_set_aside_stay_together(folder):
    for name in ("b", "c"):
        write_run(folder, f"{name}.npz")
    for broken in ("{name: a, file: none.npz, held_out: true}", "{name: a, file: good.npz, kind: wrong}"):
        dataset = read(
            folder, HEAD + f"  - {broken}\n  - {{file: b.npz, repeats: a}}\n  - {{file: c.npz, repeats: a}}\n"
        )
        groups = [(run.name, run.group, run.repeats) for run in dataset.runs]
        assert groups == [("good", "good", None), ("b", "b", None), ("c", "b", "b")]


def test_runs_that_repeat_each_other_in_a_circle_are_told(folder):
    dataset = read(
        folder, HEAD + "  - {name: b, file: good.npz, repeats: c}\n  - {name: c, file: good.npz, repeats: b}\n"
    )
    assert [run.name for run in dataset.runs] == ["good"]
    assert len(dataset.problems) == 2


def test_files_outside_are_read_when_allowed(folder, tmp_path_factory):
    other = tmp_path_factory.mktemp("other")
    write_run(other, "b.npz")
    run = f"  - {{file: '{other / 'b.npz'}'}}\n"
    assert len(read(folder, HEAD + run).runs) == 1
    assert len(read_dataset(folder, READERS, allow_outside=True).runs) == 2
    itself = read(folder, "allow_outside: true\n" + HEAD + run)
    assert len(itself.runs) == 1
    assert "cannot allow itself to read files elsewhere. say --allow-outside" in str(itself.problems[0])


def test_a_folder_elsewhere_has_to_hold_a_dataset(folder, tmp_path_factory):
    other = tmp_path_factory.mktemp("other")
    write_run(other, "good.npz")
    text = f"folder: '{other}'\n" + HEAD
    with pytest.raises(InputError, match="expected a folder below that of the dataset, or one that holds a dataset"):
        read(folder, text)
    assert len(read_dataset(folder, READERS, allow_outside=True).runs) == 1
    (other / "dataset.yaml").write_text(HEAD)
    assert len(read(folder, text).runs) == 1


def test_a_link_does_not_lead_outside(folder, tmp_path_factory):
    other = tmp_path_factory.mktemp("other")
    write_run(other, "b.npz")
    (folder / "link.npz").symlink_to(other / "b.npz")
    assert "it lies outside the folder of the dataset" in told(folder, "file: link.npz")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("runs: []\n", "dataset.yaml:1:1: the dataset lacks 'format'"),
        ("format: dashpot-dataset/2\nruns: []\n", "expected one of dashpot-dataset/1, got 'dashpot-dataset/2'"),
        ("format: dashpot-dataset/1\nruns: []\n", "the dataset has no runs. list some under 'runs'"),
        ("format: dashpot-dataset/1\n", "the dataset lacks 'runs'"),
        ("format: dashpot-dataset/1\nruns: {a: b}\n", "'runs': expected a list"),
        ("format: dashpot-dataset/1\nruns: [a]\n", "expected the run number 1 as 'key: value' lines, got the text 'a'"),
        ("format: dashpot-dataset/1\ndefaults: 3\nruns: [{file: a.npz}]\n", "expected the defaults as 'key: value'"),
        ("format: dashpot-dataset/1\nrun: [{file: a.npz}]\n", "the dataset has no key 'run'. did you mean 'runs'?"),
        ("[]\n", "expected the dataset as 'key: value' lines, got a list"),
        ("", "expected the dataset as 'key: value' lines, got nothing"),
    ],
)
def test_what_is_no_dataset_is_told(folder, text, message):
    with pytest.raises(InputError) as caught:
        read(folder, text)
    assert message in str(caught.value)


def test_a_wrong_key_at_the_top_is_told_beside_the_sound_runs(folder):
    dataset = read(folder, "nmae: test\n" + HEAD)
    assert len(dataset.runs) == 1
    assert "dataset.yaml:1:1: the dataset has no key 'nmae'. did you mean 'name'?" in str(dataset.problems[0])


def test_when_no_run_is_left_everything_is_told(folder):
    with pytest.raises(InputError) as caught:
        read(folder, HEAD.replace("good.npz", "none.npz") + "  - {name: b, file: nine.npz}\n")
    assert len(caught.value.problems) == 2


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("nothing", "there is no such file or folder. check the name"),
        ("god.npz", "there is no such file or folder. did you mean 'good.npz'?"),
        ("good.npz", "or write 'good.npz.yaml' yourself"),
        ("empty", "the folder holds no dataset.yaml"),
        ("none.yaml", "there is no such file"),
    ],
)
def test_a_dataset_that_is_not_there_is_told(folder, path, message):
    (folder / "empty").mkdir()
    with pytest.raises(InputError) as caught:
        read_dataset(folder / path, READERS)
    assert message in str(caught.value)


def test_no_file_is_changed(folder):
    write_csv(folder, "b.csv", csv_rows())
    read(folder, HEAD + "  - {file: b.csv}\n")
    before = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in folder.iterdir()}
    read_dataset(folder, READERS)
    assert {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in folder.iterdir()} == before

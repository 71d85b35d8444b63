"""Faults of the channels of single runs: written into a dataset file, and read back from it."""

from __future__ import annotations

import json
import textwrap
from pathlib import Path

import numpy as np
import pytest

from dashpot.data.correction import Correction, corrected_run, corrected_text
from dashpot.data.dataset import Dataset, read_dataset
from dashpot.data.ends import one_force_each
from dashpot.text.problem import InputError
from dashpot_formats import dashpot_formats

READERS = {reader.word: reader() for reader in dashpot_formats()}
COUNT, DT = 400, 1e-3
TIME = DT * np.arange(COUNT)
MOTION = 3.0 * np.sin(2 * np.pi * 5 * TIME)
FORCE = 100 * MOTION + 7.0 * np.cos(2 * np.pi * 5 * TIME)

TEXT = """\
# what the rig wrote
format: dashpot-dataset/1   # the first line
name: test
defaults:
  kind: sweep
  channels:
    time: {column: t, unit: s}
    displacement: {column: x, unit: mm}
    force: {column: F, unit: N}
runs:
  # the slow one
  - {name: a, file: a.npz}
  - name: b   # a second one
    file: b.npz
    channels:
      force: {gain: 2, offset: 3 N}   # as calibrated
  - name: c
    file: c.npz
    repeats: b
"""


def prepare(folder: Path, text: str = TEXT) -> Dataset:
    folder.mkdir(exist_ok=True)
    for number, name in enumerate("abc", 1):
        np.savez(folder / f"{name}.npz", t=TIME, x=MOTION, F=number * FORCE, G=-number * FORCE)
    (folder / "dataset.yaml").write_text(text)
    return read_dataset(folder, READERS)


def written(dataset: Dataset, folder: Path, corrections=None, set_aside=None) -> tuple[Dataset, str]:
    text = corrected_text(dataset, corrections or {}, set_aside or {}, folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "dataset.yaml").write_text(text, encoding="utf-8")
    return read_dataset(folder, READERS), text


CORRECTIONS = [
    Correction(offset=12.0),
    Correction(gain=0.97, offset=-3.25),
    Correction(drift=-41.7),
    Correction(hum=(50.0, 1.3, -2.2)),
    Correction(delay=2.3e-3),
    Correction(delay=-2.3e-3),
    Correction(gain=1.0 / 3.0, offset=1e-7 / 3.0, drift=1e3 / 7.0, delay=0.7e-3, hum=(49.97, 0.1, 11.0 / 3.0)),
]


# --- what a dataset file says -----------------------------------------------------------------------------------------


def test_drift_and_hum_are_what_a_channel_shows_too_much(tmp_path):
    dataset = prepare(
        tmp_path, TEXT + "    channels: {force: {drift: 12 N, hum: {frequency: 50 Hz, cosine: 1 N, sine: 2 N}}}\n"
    )
    too_much = 12.0 * TIME / TIME[-1] + np.cos(100 * np.pi * TIME) + 2.0 * np.sin(100 * np.pi * TIME)
    assert np.allclose(dataset.run("c").force, 3 * FORCE - too_much, rtol=0, atol=1e-10)
    assert np.array_equal(dataset.run("a").force, FORCE)


def test_several_lines_of_hum_are_a_list(tmp_path):
    hum = "[{frequency: 50 Hz, sine: 2 N}, {frequency: 0.15 kHz, cosine: 3 N}]"
    dataset = prepare(tmp_path, TEXT + f"    channels: {{force: {{hum: {hum}}}}}\n")
    too_much = 2.0 * np.sin(100 * np.pi * TIME) + 3.0 * np.cos(300 * np.pi * TIME)
    assert np.allclose(dataset.run("c").force, 3 * FORCE - too_much, rtol=0, atol=1e-10)


def test_drift_and_hum_count_from_the_first_sample_of_a_piece_of_a_file(tmp_path):
    dataset = prepare(
        tmp_path,
        TEXT + "    start: 100 ms\n    channels: {force: {drift: 10 N, hum: {frequency: 50 Hz, cosine: 1 N}}}\n",
    )
    own = TIME[:300]
    assert np.allclose(dataset.run("c").force, 3 * FORCE[100:] - 10.0 * own / own[-1] - np.cos(100 * np.pi * own))


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("drift: 3 mm", "'drift': expected a quantity in N, got 'mm'"),
        ("hum: {cosine: 3 N}", "lacks 'frequency'"),
        ("hum: {frequency: 0 Hz, sine: 1 N}", "expected a frequency above 0, got 0 Hz"),
        ("hum: {frequency: 50 Hz, sin: 1 N}", "has no key 'sin'. did you mean 'sine'?"),
        ("hum: {frequency: 50 Hz, sine: 1 mm}", "expected a quantity in N, got 'mm'"),
        ("hum: 50 Hz", "'hum' as 'key: value' lines"),
    ],
)
def test_what_is_wrong_with_drift_and_hum_is_told(tmp_path, entry, message):
    dataset = prepare(tmp_path, TEXT + f"    channels: {{force: {{{entry}}}}}\n")
    [problem] = dataset.problems
    assert message in str(problem)
    assert [run.name for run in dataset.runs] == ["a", "b"]


def test_a_clock_has_neither_drift_nor_hum(tmp_path):
    dataset = prepare(tmp_path, TEXT + "    channels: {time: {drift: 3 s}}\n")
    assert "the channel 'time' has no key 'drift'" in str(dataset.problems[0])


def test_a_run_that_is_set_aside_is_told_of_in_one_line_and_not_read(tmp_path):
    dataset = prepare(tmp_path, TEXT.replace("file: b.npz", 'file: nowhere.npz\n    set_aside: "the clamp: loose"'))
    assert [run.name for run in dataset.runs] == ["a", "c"]
    [problem] = dataset.problems
    assert problem.severity == "warning"
    assert str(problem).endswith("dataset.yaml:15:16: warning: run 'b' (nowhere.npz) is set aside: the clamp: loose")
    assert dataset.run("c").group == "c"


def test_a_dataset_of_which_every_run_is_set_aside_is_refused(tmp_path):
    text = TEXT.replace("  kind: sweep", "  kind: sweep\n  set_aside: the wrong specimen")
    with pytest.raises(InputError, match="every run of the dataset is set aside"):
        prepare(tmp_path, text)


def test_the_measured_files_may_lie_in_another_folder(tmp_path):
    prepare(tmp_path / "measured")
    beside = tmp_path / "beside"
    beside.mkdir()
    (beside / "dataset.yaml").write_text("folder: ../measured\n" + TEXT)
    dataset = read_dataset(beside, READERS)
    assert dataset.folder.resolve() == (tmp_path / "measured").resolve()
    assert np.array_equal(dataset.run("a").force, FORCE)


def test_no_file_above_that_folder_is_read(tmp_path):
    prepare(tmp_path)
    (tmp_path / "below").mkdir()
    text = "folder: below\n" + TEXT.replace("file: c.npz", "file: ../c.npz")
    with pytest.raises(InputError, match="it lies outside the folder of the dataset"):
        prepare(tmp_path, text)


# --- corrections ------------------------------------------------------------------------------------------------------


def test_a_correction_is_what_it_says():
    found = Correction(2.0, 3.0, 4.0, 0.0, (50.0, 5.0, 6.0)).apply(FORCE, DT)
    hum = 5.0 * np.cos(100 * np.pi * TIME) + 6.0 * np.sin(100 * np.pi * TIME)
    assert np.allclose(found, 2.0 * FORCE - 3.0 - 4.0 * TIME / TIME[-1] - hum, rtol=0, atol=1e-10)


def test_a_channel_that_was_late_is_moved_forward():
    found = Correction(delay=3e-3).apply(np.sin(60.0 * (TIME - 3e-3)), DT)
    assert found.size == COUNT - 3
    assert np.allclose(found, np.sin(60.0 * TIME[:-3]), atol=1e-12)


@pytest.mark.parametrize("correction", CORRECTIONS)
@pytest.mark.parametrize("name", ["a", "b", "c"])
def test_what_is_written_reads_back_as_what_was_corrected(tmp_path, name, correction):
    dataset = prepare(tmp_path / "measured")
    again, _ = written(dataset, tmp_path / "out" / "corrected", {name: correction})
    assert again.problems == () and again.name == "test"
    for run in dataset.runs:
        expected = corrected_run(run, correction) if run.name == name else run
        found = again.run(run.name)
        assert found.time.shape == expected.time.shape
        for channel in expected.channels:
            scale = np.abs(expected.channels[channel]).max()
            assert np.abs(found.channels[channel] - expected.channels[channel]).max() <= 1e-12 * scale
    assert again.run("c").group == "b"


@pytest.mark.parametrize("second", CORRECTIONS)
@pytest.mark.parametrize("first", CORRECTIONS[:4])
def test_a_correction_comes_on_top_of_an_earlier_one(tmp_path, first, second):
    dataset = prepare(tmp_path / "measured")
    once, _ = written(dataset, tmp_path / "one", {"b": first})
    twice, _ = written(once, tmp_path / "two" / "below", {"b": second})
    expected = corrected_run(corrected_run(dataset.run("b"), first), second)
    # the spline of a delay bends a hum of an earlier correction by its own error
    near = 1e-12 if not (first.hum and second.delay) else 1e-6
    assert np.abs(twice.run("b").force - expected.force).max() <= near * np.abs(expected.force).max()


def test_comments_and_all_that_is_not_corrected_stay(tmp_path):
    dataset = prepare(tmp_path / "measured")
    _, text = written(dataset, tmp_path / "out", {"b": Correction(offset=1.5)}, {"c": "the clamp: loose"})
    expected = TEXT.replace("# the first line\nname: test", "# the first line\nfolder: ../measured\nname: test")
    expected = expected.replace("offset: 3 N", "offset: 4.5 N").replace(
        "    repeats: b\n", '    repeats: b\n    set_aside: "the clamp: loose"\n'
    )
    assert text == expected


def test_a_run_that_is_set_aside_stays_away(tmp_path):
    again, _ = written(prepare(tmp_path / "measured"), tmp_path / "out", set_aside={"b": "lost its #preload"})
    assert [run.name for run in again.runs] == ["a", "c"]
    assert "run 'b' (b.npz) is set aside: lost its #preload" in str(again.problems[0])


def test_nothing_changes_beside_the_dataset_itself(tmp_path):
    dataset = prepare(tmp_path)
    assert "folder: ." in corrected_text(dataset, {}, {}, tmp_path)
    assert written(dataset, tmp_path)[0].digest == dataset.digest


@pytest.mark.parametrize(
    "channels",
    [
        "channels: {time: t, displacement: {column: x, unit: mm}, force: F}",
        "channels: {time: t, displacement: {column: x, unit: mm}, force: 3}",
        "channels: &c\n    time: t\n    displacement: {column: x, unit: mm}\n    force: {column: F}",
    ],
)
def test_a_channel_that_is_its_column_alone_can_be_corrected(tmp_path, channels):
    text = f"format: dashpot-dataset/1\ndefaults:\n  kind: sweep\n  {channels}\n"
    text += "runs:\n  - file: a.npz\n  - file: b.npz\n"
    if "&c" in channels:
        text += "    channels: *c\n"
    dataset = prepare(tmp_path / "measured", text)
    again, _ = written(dataset, tmp_path / "out", {"b": Correction(offset=5.0), "a": Correction(drift=1.0)})
    assert np.allclose(again.run("b").force, 2 * FORCE - 5.0)
    assert np.allclose(again.run("a").force, FORCE - TIME / TIME[-1])
    assert again.name == "measured"


def test_an_anchor_may_be_corrected_where_others_refer_to_it(tmp_path):
    own = "{time: t, displacement: {column: x, unit: mm}, force: {column: F, unit: N}}"
    text = f"format: dashpot-dataset/1\nruns:\n  - {{file: a.npz, kind: sweep, channels: &c {own}}}\n"
    text += "  - {file: b.npz, kind: sweep, channels: *c}\n"
    again, _ = written(prepare(tmp_path / "m", text), tmp_path / "out", {"a": Correction(offset=5.0)})
    assert np.allclose(again.run("a").force, FORCE - 5.0)
    assert np.array_equal(again.run("b").force, 2 * FORCE)


def test_a_single_file_with_its_sidecar_becomes_a_dataset_of_one_run(tmp_path):
    prepare(tmp_path / "m")
    (tmp_path / "m" / "a.npz.yaml").write_text(
        textwrap.dedent("""\
        format: dashpot-dataset/1
        kind: random   # white
        settings: {amplitude: 2 mm, tire: 205/55 R16}
        channels: {time: t, displacement: {column: x, unit: mm}, force: {column: F, unit: N}}
        """)
    )
    dataset = read_dataset(tmp_path / "m" / "a.npz", READERS)
    again, _ = written(dataset, tmp_path / "out", {"a": Correction(offset=5.0)})
    assert np.allclose(again.run("a").force, FORCE - 5.0)
    assert (again.name, again.run("a").kind, again.run("a").settings) == ("a", "random", {"amplitude": 0.002})
    assert dict(again.run("a").notes) == {"tire": "205/55 R16"}


def test_the_force_at_a_node_is_corrected_by_the_name_of_its_run(tmp_path):
    text = (
        TEXT
        + """\
    channels: {displacement@left: {column: x, unit: mm}, force@left: {column: F}, force@right: {column: G},
               displacement@right: {column: x, unit: mm}}
"""
    )
    text = (
        text.replace("    displacement: {column: x, unit: mm}\n    force: {column: F, unit: N}\n", "", 1)
        .replace(
            "  - {name: a, file: a.npz}\n  - name: b   # a second one\n    file: b.npz\n    channels:\n"
            "      force: {gain: 2, offset: 3 N}   # as calibrated\n",
            "",
        )
        .replace("    repeats: b\n", "")
    )
    dataset = one_force_each(prepare(tmp_path / "m", text))
    correction = Correction(offset=5.0, delay=1e-3)
    again = one_force_each(written(dataset, tmp_path / "out", {"c@right": correction})[0])
    expected = corrected_run(dataset.run("c@right"), correction)
    assert np.allclose(again.run("c@right").force, expected.force, atol=1e-10)
    assert np.array_equal(again.run("c@left").force, 3 * FORCE[:-1])


def test_what_cannot_be_corrected_is_told(tmp_path):
    dataset = prepare(tmp_path / "m")
    with pytest.raises(InputError, match="has no run 'd'"):
        corrected_text(dataset, {"d": Correction(offset=1.0)}, {}, tmp_path)
    with pytest.raises(InputError, match="has no channel 'force@left'"):
        corrected_text(dataset, {"a@left": Correction(offset=1.0)}, {}, tmp_path)
    with pytest.raises(InputError, match="was made in memory"):
        corrected_text(Dataset("memory", dataset.runs), {}, {}, tmp_path)


def test_a_channel_that_would_mix_with_the_defaults_is_refused(tmp_path):
    text = TEXT.replace("unit: N}\nruns", "unit: kN}\nruns") + "    channels: {force: G}\n"
    dataset = prepare(tmp_path / "m", text)
    assert np.array_equal(dataset.run("c").force, -3 * FORCE)
    with pytest.raises(InputError, match="its channel 'force' cannot be corrected in place. write the channel with"):
        corrected_text(dataset, {"c": Correction(offset=1.0)}, {}, tmp_path)


def test_the_text_is_the_same_every_time(tmp_path):
    dataset = prepare(tmp_path)
    texts = {
        corrected_text(dataset, {"a": Correction(offset=1.0), "b": Correction(drift=2.0)}, {}, tmp_path / "o")
        for _ in range(2)
    }
    assert len(texts) == 1 and json.dumps(texts.pop())


def test_a_displacement_in_another_unit_is_corrected_as_well(tmp_path):
    """Together with the force, where its channel is corrected by the file already."""
    dataset = prepare(tmp_path / "data")
    corrections = {"a": Correction(displacement_gain=25.4), "b": Correction(gain=-1.0, displacement_gain=1e-3)}
    found, text = written(dataset, tmp_path / "out", corrections)
    assert "displacement: {gain: 25.4}" in text
    for name, factor in (("a", 25.4), ("b", 1e-3), ("c", 1.0)):
        assert found.run(name).displacement == pytest.approx(factor * dataset.run(name).displacement, rel=1e-12)
    assert found.run("a").force == pytest.approx(dataset.run("a").force, rel=1e-12)
    assert found.run("b").force == pytest.approx(-dataset.run("b").force, rel=1e-12)
    for name, correction in corrections.items():
        again = corrected_run(dataset.run(name), correction)
        assert found.run(name).displacement == pytest.approx(again.displacement, rel=1e-12)

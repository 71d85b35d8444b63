"""Public rig data of five laboratories are read as their descriptions tell.

They are no part of the package: the tests look for them in the folder DASHPOT_SHARED_DATA, or in `shared/data` beside
the checkout, and are skipped without it.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from dashpot.data.dataset import Dataset, read_dataset
from dashpot_formats import dashpot_formats

READERS = {reader.word: reader() for reader in dashpot_formats()}
BESIDE = Path(__file__).parents[4] / "shared" / "data"
DATA = Path(os.environ.get("DASHPOT_SHARED_DATA", BESIDE))

pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason="no folder DASHPOT_SHARED_DATA with the public rig data")


def read(folder: Path, defaults: str, files: list[Path], extra: str = "") -> Dataset:
    runs = "".join(f"  - {{name: '{file.stem}', file: '{file}'{extra}}}\n" for file in files)
    head = f"format: dashpot-dataset/1\ndefaults: {{{defaults}}}\nruns:\n"
    (folder / "dataset.yaml").write_text(head + runs)
    return read_dataset(folder, READERS, allow_outside=True)


def files_of(name: str, pattern: str) -> list[Path]:
    found = sorted((DATA / name).glob(pattern))
    assert found
    return found


def test_a_friction_damper_in_inches_and_kips_from_json(tmp_path):
    files = files_of("friction_damper_brfd", "*.json")
    channels = "time: {column: 1}, displacement: {column: 2, unit: in}, force: {column: 3, unit: kip}"
    more = "velocity: {column: 4, unit: in/s}"
    dataset = read(tmp_path, f"kind: harmonic, channels: {{{channels}, {more}}}", files)
    assert dataset.problems == () and len(dataset.runs) == len(files)
    for run in dataset.runs:
        assert run.sample_time == 1 / 1024
        commanded = float(run.name.partition("tension")[2].removesuffix("amplitude")) * 25.4e-3
        assert np.ptp(run.displacement) / 2 == pytest.approx(commanded, rel=0.05)
        rate = np.gradient(run.displacement, run.sample_time)
        assert np.corrcoef(rate, run.channels["velocity"])[0, 1] > 0.98
        assert np.abs(rate).max() == pytest.approx(np.abs(run.channels["velocity"]).max(), rel=0.3)
        # a plateau of about 2.7 kip
        assert 10e3 < np.abs(run.force).max() < 20e3


def test_a_rubber_bearing_in_centimetres_and_tons_from_mat(tmp_path):
    channels = "displacement: {column: d, unit: cm}, force: {column: f, unit: tonf}"
    defaults = f"kind: quasi_static, sampling: 100 Hz, channels: {{{channels}}}"
    dataset = read(tmp_path, defaults, files_of("hdrb_bearing", "Test.mat"))
    (run,) = dataset.runs
    assert dataset.problems == () and run.time.size == 26372
    # 148 % shear strain of 15.6 cm rubber; 1.35 tonf/cm secant stiffness in the last cycle
    assert run.displacement.max() == pytest.approx(1.476 * 0.156, rel=0.01)
    last = slice(-975, None)
    secant = np.ptp(run.force[last]) / np.ptp(run.displacement[last])
    assert secant == pytest.approx(1.35 * 980_665, rel=0.02)


def test_a_controllable_damper_from_mat_with_vectors_and_a_matrix(tmp_path):
    files = files_of("mr_damper_labcontrol", "*.mat")
    channels = "time: {column: Tout}, displacement: {column: dist, unit: mm}, force: {column: forc}"
    more = "displacement@copy: {column: x_F(1), unit: mm}"
    dataset = read(tmp_path, f"kind: harmonic, channels: {{{channels}, {more}}}", files)
    assert dataset.problems == () and len(dataset.runs) == len(files)
    for run in dataset.runs:
        assert run.sample_time == pytest.approx(0.01)
        swing, copy = (np.ptp(run.channels[name]) for name in ("displacement", "displacement@copy"))
        assert 5e-3 < swing < 45e-3 and copy == pytest.approx(swing, rel=0.1)


def test_a_servohydraulic_damper_from_text_in_columns_without_names(tmp_path):
    files = files_of("mr_damper_utfsm/preprocessed", "*.txt")
    channels = "time: {column: 1}, displacement: {column: 2, unit: mm}, velocity: {column: 3, unit: mm/s}, force: 4"
    dataset = read(tmp_path, f"kind: harmonic, channels: {{{channels}}}", files)
    assert dataset.problems == () and len(dataset.runs) == len(files) == 30
    for run in dataset.runs:
        assert run.sample_time == pytest.approx(0.001 if run.name.startswith(("10mm1Hz", "5mm3Hz")) else 0.005)
        # their velocity is the difference quotient of their displacement, printed with eight digits
        rate = np.diff(run.displacement) / run.sample_time
        assert np.abs(rate - run.channels["velocity"][1:]).max() < 2e-4 * np.abs(rate).max()


@pytest.mark.parametrize(
    ("name", "rate", "force", "displacement", "swing"),
    [("ME2mm5Hz", 200, "CHANNEL0", "CHANNEL1", 1.64), ("ME5mm3Hz", 1000, "CHANNEL1", "CHANNEL0", 4.6)],
)
def test_a_logger_file_with_a_header_dates_and_events(tmp_path, name, rate, force, displacement, swing):
    channels = f"force: {{column: {force}, gain: 980.665}}, displacement: {{column: {displacement}, unit: cm}}"
    defaults = f"kind: harmonic, sampling: {rate} Hz, channels: {{{channels}}}"
    run = read(tmp_path, defaults, files_of("mr_damper_utfsm/raw", f"{name}.txt")).run(name)
    assert run.sample_time == 1 / rate
    assert np.ptp(run.displacement) / 2 == pytest.approx(swing * 1e-3, rel=0.02)
    # the yield force at 1 A is 1.5 kN
    assert np.abs(run.force).max() == pytest.approx(1.5e3, rel=0.1)


SEAL = "time: {column: 1, unit: ms}, displacement: {column: 5, unit: mm}, force: 7, pressure: {column: 6, unit: bar}"


def test_a_pneumatic_seal_with_gaps_is_set_aside_with_the_longest_piece(tmp_path):
    files = files_of("seal_friction_pneumatic", "*.csv")
    dataset = read(tmp_path, f"kind: quasi_static, channels: {{{SEAL}}}", files)
    aside = [problem for problem in dataset.problems if problem.severity == "error"]
    assert len(aside) + len(dataset.runs) == len(files) and aside
    assert all("it has a gap from" in problem.message and "'start: " in problem.hint for problem in aside)


def test_a_pneumatic_seal_on_an_uneven_clock_is_resampled(tmp_path):
    files = files_of("seal_friction_pneumatic", "*.csv")
    dataset = read(tmp_path, f"kind: quasi_static, channels: {{{SEAL}}}", files, ", start: 5 s")
    assert len(dataset.runs) >= 7
    for run in dataset.runs:
        assert run.sample_time == pytest.approx(0.010, abs=1e-3)
        bars = int(run.name.partition("_")[2].removesuffix("bar"))
        assert np.median(run.channels["pressure"]) == pytest.approx(bars * 1e5, rel=0.05)
        # the force is the pressure on a bore of 25.7 mm, plus friction of some 15 N
        piston = run.channels["pressure"] * np.pi * 0.01285**2
        assert np.abs(run.force - piston).max() < 30
    warnings = [problem.message for problem in dataset.problems if problem.severity == "warning"]
    assert len(warnings) == len(dataset.runs) and all("it was laid on an even grid of" in text for text in warnings)

"""What a diagnosis of a table of dynamic stiffness tells is what its files say: closed forms of K' + i K''."""

from __future__ import annotations

import json

import numpy as np
import pytest
from unit.diagnose.files import assert_is_in_files
from unit.diagnose.rig import DAMPING, NETWORK, STIFFNESS

from dashpot.cli import main

FREQUENCIES, AMPLITUDES = np.geomspace(1.0, 30.0, 8), (0.3e-3, 1e-3, 3e-3)
HEAD = "f,A,K1,K2,T\nHz,mm,N/mm,N/mm,K\n"
DATASET = """\
format: dashpot-dataset/1
name: made
tables:
  - name: rows
    file: rows.csv
    columns:
      frequency: {column: f, unit: Hz}
      amplitude: {column: A, unit: mm}
      storage: {column: K1, unit: N/mm}
      loss: {column: K2, unit: N/mm}
      temperature: {column: T, unit: K}
"""


def relaxing(speed, amplitude, temperature):
    """A spring of 60 N/mm in series with a dashpot."""
    return STIFFNESS + 1j * DAMPING * speed + 60e3 * 20e-3j * speed / (1.0 + 20e-3j * speed)


def rubbing(speed, amplitude, temperature, stiffness=200e3, limit=40.0):
    """The describing function of a spring behind a dry slider."""
    rest, travel = STIFFNESS + 1j * DAMPING * speed, limit / stiffness
    if amplitude <= travel:
        return rest + stiffness
    angle = np.arccos(1.0 - 2.0 * travel / amplitude)
    elastic = stiffness / np.pi * (angle - 0.5 * np.sin(2.0 * angle))
    return rest + elastic + 4j * limit * (amplitude - travel) / (np.pi * amplitude**2)


def warm(speed, amplitude, temperature):
    """Oil whose viscosity falls with the temperature by the law of Arrhenius."""
    colder = 1.0 / temperature - 1.0 / 293.0
    return STIFFNESS + 3j * DAMPING * np.exp(25e3 / 8.314 * colder) * speed


LAWS = {"relaxation": relaxing, "friction": rubbing, "setting_dependence": warm}


def measured(law, folder):
    """A table with two parts in a thousand of scatter, as a dataset."""
    rng, lines = np.random.default_rng(0), []
    for k, frequency in enumerate(FREQUENCIES):
        for j, amplitude in enumerate(AMPLITUDES):
            temperature = 293.0 + 15.0 * ((k + j) % 3)
            found = law(2.0 * np.pi * frequency, amplitude, temperature)
            found += 2e-3 * STIFFNESS * complex(*rng.standard_normal(2))
            numbers = (frequency, 1e3 * amplitude, 1e-3 * found.real, 1e-3 * found.imag, temperature)
            lines.append(",".join(f"{number:.9g}" for number in numbers) + "\n")
    folder.mkdir()
    (folder / "rows.csv").write_text(HEAD + "".join(lines))
    (folder / "dataset.yaml").write_text(DATASET)
    return folder


def errors(network, data, folder, held_out):
    """RMSE of training rows and of held-out rows by `dashpot simulate` and the stiffness of the table."""
    assert main(["simulate", str(network), "--data", str(data), "--table", "-o", str(folder), "--quiet"]) == 0
    names, _, *rows = (folder / "stiffness.csv").read_text().splitlines()
    table = dict(zip(names.split(","), np.array([row.split(",") for row in rows], float).T, strict=True))
    wrong = [table[key] - table[f"measured_{key}"] for key in ("storage", "loss")]
    squares = 0.5 * table["amplitude"] ** 2 * (wrong[0] ** 2 + wrong[1] ** 2)
    unseen = np.isin([f"rows-{number + 1}" for number in range(squares.size)], held_out)
    return {"train": np.sqrt(np.mean(squares[~unseen])), "held_out": np.sqrt(np.mean(squares[unseen]))}


SLOW = ("relaxation", "setting_dependence")


@pytest.mark.parametrize("word", ["friction", *(pytest.param(word, marks=pytest.mark.slow) for word in SLOW)])
def test_the_files_say_what_is_told_of_a_table(word, tmp_path):
    data, out = measured(LAWS[word], tmp_path / "data"), tmp_path / "out"
    (tmp_path / "plain.yaml").write_text(NETWORK)
    assert main(["diagnose", str(tmp_path / "plain.yaml"), str(data), "-o", str(out), "--quiet"]) == 0
    told = json.loads((out / "diagnosis.json").read_text())
    for state, key in (("before", "fitted_model"), ("after", "extended_model")):
        found = errors(out / told[key], data, tmp_path / state, told["held_out"])
        assert found == pytest.approx(told["rmse"][state], rel=1e-6)
    assert_is_in_files(word, out, told)

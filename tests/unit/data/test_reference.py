"""What was measured by other means stands in the dataset; a fit does not see it, a wrong one is told."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot import load_registry
from dashpot.data.dataset import Dataset, read_dataset
from dashpot.fit.study.reading import parse_study
from dashpot.fit.study.references import require_references
from dashpot.text.document import Document
from dashpot.text.problem import InputError
from dashpot_formats import dashpot_formats

READERS = {reader.word: reader() for reader in dashpot_formats()}
HEAD = """\
format: dashpot-dataset/1
name: test
runs:
  - {name: a, file: a.npz, kind: sweep, channels: {time: {column: t, unit: s}, displacement: x, force: F}}
references:
"""
STUDY = "format: dashpot-study/1\nname: s\ndata: d\nmodels: [axle_model_3]\nstages: [{name: all, free: '*'}]\n"
CURVE = "  shock_absorber.damping: {velocity: [-1 m/s, 500 mm/s], force: [-1 kN, 300 N], by: damper test rig}\n"


def read(folder, references: str) -> Dataset:
    time = np.arange(400) / 1000.0
    np.savez(folder / "a.npz", t=time, x=np.sin(30.0 * time), F=np.cos(30.0 * time))
    (folder / "dataset.yaml").write_text(HEAD + references)
    return read_dataset(folder, READERS)


def study_of(text: str = STUDY):
    from pathlib import Path

    return parse_study(Document.parse(text), Path(), load_registry())


def test_numbers_and_curves_are_read_in_si_and_do_not_change_the_digest(tmp_path):
    plain = read(tmp_path, "  {}\n").digest
    found = read(tmp_path, "  wheel_left.mass: {value: 47500 g, by: weighed}\n" + CURVE)
    mass, curve = found.references.values()
    assert (mass.path, mass.by, mass.number("kg")) == ("wheel_left.mass", "weighed", pytest.approx(47.5))
    assert (curve.velocity, curve.force, curve.by) == ((-1.0, 0.5), (-1000.0, 300.0), "damper test rig")
    assert found.digest == plain and not found.problems
    require_references(study_of(), found.references)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("  a.k: {value: heavy}\n", "'value': "),
        (
            "  a.k: {velocity: [0 m/s, 1 m/s], force: [1 N]}\n",
            "as many forces as velocities, two at least, got 2 and 1",
        ),
        ("  a.k: {velocity: [1 m/s, 0 m/s], force: [1 N, 2 N]}\n", "expected growing velocities"),
        ("  a.k: {by: weighed}\n", "lacks 'velocity'"),
        ("  a.k: {value: 1 kg, weighed_by: me}\n", "has no key 'weighed_by'"),
    ],
)
def test_a_wrong_reference_is_told_and_left_out(tmp_path, text, said):
    found = read(tmp_path, text)
    assert not found.references and any(said in problem.message for problem in found.problems)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("  wheel_left.mass: {value: 47 mm}\n", "the reference of 'wheel_left.mass': "),
        ("  wheel_left.mass: {velocity: [0 m/s, 1 m/s], force: [0 N, 1 N]}\n", "expected a number, got a curve"),
        (
            "  shock_absorber.damping: {value: 1500 N*s/m}\n",
            "is the number 1500 N*s/m, in 'axle_model_3' it is another",
        ),
        ("  suspension.stiffness: {velocity: [0 m/s, 1 m/s], force: [0 N, 1 N]}\n", "is a force over velocity, in"),
    ],
)
def test_a_reference_of_another_kind_than_the_parameter_is_refused_before_a_study_begins(tmp_path, text, said):
    with pytest.raises(InputError, match=said.replace("*", r"\*")):
        require_references(study_of(), read(tmp_path, text).references)


def test_a_reference_that_no_model_has_is_left_alone(tmp_path):
    require_references(study_of(), read(tmp_path, "  hub.mass: {value: 3 mm}\n").references)

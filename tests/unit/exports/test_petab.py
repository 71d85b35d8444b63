"""The tables of a PEtab problem, and reading them again."""

from __future__ import annotations

import csv
import io

import numpy as np
import pytest

import dashpot as dp
from dashpot.cli import main
from dashpot.text.problem import InputError

MODEL = """\
format: dashpot-network/1
name: mount
branches:
  rubber: {element: spring, stiffness: {start: 100 N/mm, bounds: [1 N/mm, 1 kN/mm]}}
  relaxing:
    element: maxwell
    stiffness: {start: 30 N/mm, prior: {lognormal: 40 N/mm, deviation: 10 %}}
    relaxation_time: {start: 10 ms, prior: {normal: 20 ms, deviation: 2 ms}}
  oil: {element: damper, damping: {expression: 1 ms * rubber.stiffness}}
  dry: {element: spring, stiffness: 5 N/mm}
measurement: {force: {offset: {setting: bias, value: 0 N}}}
"""


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    folder = tmp_path_factory.mktemp("petab")
    time = np.arange(300) * 1e-3
    rng = np.random.default_rng(5)
    runs = []
    for number, frequency in enumerate((2.0, 5.0)):
        x = 1e-3 * np.sin(2.0 * np.pi * frequency * time)
        table = np.array([time, x, 1.3e5 * x + 0.5 * rng.standard_normal(time.size)]).T
        np.savetxt(folder / f"run_{number}.csv", table, delimiter=",", header="t,x,F", comments="")
        runs.append(
            f"  - {{name: run-{number}, file: run_{number}.csv, kind: harmonic, settings: {{bias: {number} N}}, "
            "channels: {time: {column: t, unit: s}, displacement: {column: x, unit: m}, force: {column: F, unit: N}}}"
        )
    (folder / "dataset.yaml").write_text("format: dashpot-dataset/1\nname: two\nruns:\n" + "\n".join(runs) + "\n")
    (folder / "mount.yaml").write_text(MODEL)
    return folder


def exported(home, text=MODEL, **options):
    export = dp.load_registry().exports["petab"](data=str(home / "dataset.yaml"), **options)
    return export.files(dp.declare(text))


def rows(files, name):
    return list(csv.DictReader(io.StringIO(files[name].decode()), delimiter="\t"))


def test_every_number_that_is_no_expression_and_not_given_by_runs_is_a_parameter(home):
    found = {row["parameterName"]: row for row in rows(exported(home, noise=1.0), "parameters.tsv")}
    assert list(found) == ["rubber.stiffness", "relaxing.stiffness", "relaxing.relaxation_time", "dry.stiffness"]
    rubber = found["rubber.stiffness"]
    assert (rubber["parameterId"], rubber["parameterScale"], rubber["estimate"]) == ("rubber_stiffness", "log", "1")
    assert [float(rubber[key]) for key in ("lowerBound", "upperBound", "nominalValue")] == [1e3, 1e6, 1e5]
    assert (found["dry.stiffness"]["estimate"], float(found["dry.stiffness"]["nominalValue"])) == ("0", 5e3)


def test_priors_are_those_of_the_scale_of_the_search(home):
    found = {row["parameterName"]: row for row in rows(exported(home), "parameters.tsv")}
    share, time = found["relaxing.stiffness"], found["relaxing.relaxation_time"]
    assert share["objectivePriorType"] == "parameterScaleNormal"  # the scale is the natural logarithm
    assert [float(x) for x in share["objectivePriorParameters"].split(";")] == pytest.approx([np.log(40e3), 0.1])
    assert time["objectivePriorType"] == "normal"
    assert [float(x) for x in time["objectivePriorParameters"].split(";")] == pytest.approx([20e-3, 2e-3])


def test_runs_are_conditions_with_the_settings_that_the_network_refers_to(home):
    found = rows(exported(home), "conditions.tsv")
    assert [(row["conditionId"], row["conditionName"], float(row["bias"])) for row in found] == [
        ("run_0", "run-0", 0.0),
        ("run_1", "run-1", 1.0),
    ]


def test_the_noise_is_what_was_said_and_else_a_parameter_where_it_is_unknown(home):
    said = {row["observableId"]: row for row in rows(exported(home, noise=2.5), "observables.tsv")}
    assert float(said["measured_force"]["noiseFormula"]) == 2.5
    assert said["measured_force"]["observableFormula"] == "force"
    files = exported(home)  # two short runs without repeats tell no noise floor
    unknown = {row["observableId"]: row for row in rows(files, "observables.tsv")}
    assert unknown["measured_force"]["noiseFormula"] == "noise_force"
    noise = rows(files, "parameters.tsv")[-1]
    assert (noise["parameterId"], noise["estimate"]) == ("noise_force", "1")
    assert float(noise["lowerBound"]) < 0.5 < float(noise["upperBound"])


def test_every_reference_between_the_tables_holds(home):
    files = exported(home)
    conditions = {row["conditionId"] for row in rows(files, "conditions.tsv")}
    observables = {row["observableId"] for row in rows(files, "observables.tsv")}
    measured = rows(files, "measurements.tsv")
    assert {row["simulationConditionId"] for row in measured} == conditions
    assert {row["observableId"] for row in measured} == observables
    assert len(measured) == 2 * 2 * 300
    assert set(files) == {f"{name}.tsv" for name in ("parameters", "observables", "conditions", "measurements")} | {
        "problem.yaml",
        "mount.yaml",
    }


def test_a_lognormal_prior_on_a_linear_scale_is_refused(home):
    text = MODEL.replace("prior: {lognormal", "scale: linear, prior: {lognormal")
    with pytest.raises(InputError, match="has no equal in PEtab"):
        exported(home, text)


def test_without_a_dataset_it_says_what_to_do():
    with pytest.raises(InputError, match="say --set data=my/dataset.yaml"):
        dp.load_registry().exports["petab"]().files(dp.declare(MODEL))


def test_names_that_become_one_identifier_are_told_apart():
    from dashpot_exports.petab import identifiers

    assert identifiers(["a.b", "a_b", "3x", "a.b"]) == {"a.b": "a_b", "a_b": "a_b_2", "3x": "n_3x"}


DATASET = """\
format: dashpot-dataset/1
name: back
runs:
  - name: again
    file: measurements.tsv
    reader: petab
    file_options: {condition: run_1, conditions: conditions.tsv}
    kind: harmonic
    channels:
      time: {column: time, unit: s}
      displacement: {column: measured_displacement, unit: m}
      force: {column: measured_force, unit: N}
"""


def test_the_tables_are_read_as_they_were_written(home, tmp_path):
    command = ["export", str(home / "mount.yaml"), "--to", "petab", "--set", f"data={home / 'dataset.yaml'}", "--quiet"]
    assert main([*command, "-o", str(tmp_path / "out")]) == 0
    (tmp_path / "out" / "dataset.yaml").write_text(DATASET)
    [back] = dp.load_dataset(tmp_path / "out").runs
    original = dp.load_dataset(home).run("run-1")
    assert back.force == pytest.approx(original.force, rel=1e-15)
    assert back.displacement == pytest.approx(original.displacement, rel=1e-15)


def test_a_channel_that_a_number_follows_stands_among_the_measurements(home, tmp_path):
    """As it was measured, at every sample; another channel is left out, and so is this one where nothing follows it."""
    time = np.arange(300) * 1e-3
    columns = [time, 1e-3 * np.sin(30.0 * time), np.zeros(300), 0.5 + time, np.ones(300)]
    np.savetxt(tmp_path / "run.csv", np.array(columns).T, delimiter=",", header="t,x,F,i,j", comments="")
    channels = "time: {column: t, unit: s}, displacement: {column: x, unit: m}, force: {column: F, unit: N}"
    more = "current: {column: i, unit: A}, current@other: {column: j, unit: A}"
    run = f"{{name: run, file: run.csv, kind: sweep, settings: {{bias: 0 N}}, channels: {{{channels}, {more}}}}}"
    (tmp_path / "dataset.yaml").write_text(f"format: dashpot-dataset/1\nname: one\nruns:\n  - {run}\n")
    over = "{start: 100 N*s/m, bounds: [1 N*s/m, 1 kN*s/m], over: {channel: current, at: 0 A, slope: 2 N*s/m/A}}"
    following = MODEL.replace("{expression: 1 ms * rubber.stiffness}", over)
    found = rows(exported(tmp_path, following, noise=1.0), "measurements.tsv")
    shown = [float(row["measurement"]) for row in found if row["observableId"] == "measured_current"]
    assert shown == pytest.approx((0.5 + time).tolist(), rel=1e-12)
    assert {row["observableId"] for row in found} == {"measured_displacement", "measured_force", "measured_current"}
    plain = rows(exported(tmp_path, noise=1.0), "measurements.tsv")
    assert {row["observableId"] for row in plain} == {"measured_displacement", "measured_force"}

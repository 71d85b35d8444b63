"""Sensitivity studies on a linear car; truth: its frequency response in closed form, and normal quantiles."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from unit.linear_car import car, least_force

from dashpot import load_registry
from dashpot.cli import main
from dashpot.study.sensitivity.content import crossing, sensitivity_content
from dashpot.study.sensitivity.reading import parse_sensitivity
from dashpot.study.sensitivity.run import SensitivityResult, run_sensitivity
from dashpot.text.document import Document
from dashpot.text.problem import InputError

REGISTRY = load_registry()
TIRE, DAMPING = 200e3, 1500.0
STUDY = """\
format: dashpot-sensitivity/1
name: cars
network: car.yaml
rig: eusama
options: {sampling: 500 Hz, duration: 16 s}
metrics: [eusama, phase_shift]
limits: {eusama: 40}
over: {name: wear, parameters: absorber.damping, factors: [1, 0.7, 0.5]}
"""
VARIED = """\
vary:
  - {name: inflation, parameters: tire.stiffness, factors: [0.8, 1.2]}
  - {name: mass, parameters: wheel.added_mass, values: [0 kg, 15 kg]}
"""
SCATTER = "scatter: [{parameters: absorber.damping, deviation: 0.1}]\ndraws: 60\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The car beside its studies."""
    (tmp_path / "car.yaml").write_text(car(DAMPING, TIRE))
    return tmp_path


def found(folder: Path, text: str) -> dict:
    study = parse_sensitivity(Document.parse(text, "cars.yaml"), folder, REGISTRY)
    return sensitivity_content(run_sensitivity(study))


def test_every_curve_is_that_of_the_frequency_response(folder):
    content = found(folder, STUDY + VARIED)
    truths = {
        (None, None): {},
        ("inflation", 0.8): {"tire": 0.8 * TIRE},
        ("inflation", 1.2): {"tire": 1.2 * TIRE},
        ("mass", 0.0): {},
        ("mass", 15.0): {"added": 15.0},
    }
    assert [(curve["vary"], curve["value"]) for curve in content["curves"]] == list(truths)
    for curve in content["curves"]:
        changed = {"tire": TIRE, **truths[curve["vary"], curve["value"]]}
        truth = [least_force(factor * DAMPING, **changed) for factor in (1.0, 0.7, 0.5)]
        assert curve["metrics"]["eusama"] == pytest.approx(truth, abs=1.5)
        assert curve["metrics"]["phase_shift"] == sorted(curve["metrics"]["phase_shift"], reverse=True)
    # what is varied moves the metric by more than what a sweep differs from the response
    spread = [curve["metrics"]["eusama"][2] for curve in content["curves"]]
    assert max(spread) - min(spread) > 10.0


def test_the_band_is_that_of_the_scatter(folder):
    limit = round(least_force(0.5 * DAMPING, TIRE))  # about every second worn car has less
    text = STUDY.replace("{eusama: 40}", f"{{eusama: {limit}}}") + SCATTER
    content = found(folder, text)
    [band] = [each for each in content["bands"] if each["metric"] == "eusama"]
    for place, factor in enumerate((1.0, 0.7, 0.5)):
        low, middle, high = (least_force(factor * DAMPING * (1.0 + 0.1 * z), TIRE) for z in (-1.645, 0.0, 1.645))
        assert band["median"][place] == pytest.approx(middle, abs=2.0)
        # 5 and 95 % of 60 draws have a standard error of a fifth of a band's width
        assert band["low"][place] == pytest.approx(low, abs=1.5 + 0.4 * (high - low))
        assert band["high"][place] == pytest.approx(high, abs=1.5 + 0.4 * (high - low))
        assert band["low"][place] < band["median"][place] < band["high"][place]
    # a share of 60 draws has a standard error of 0.065
    assert band["failing"] == [0.0, 0.0, pytest.approx(failing_share(limit), abs=0.2)]
    assert found(folder, text) == content


def failing_share(limit: float) -> float:
    """How many cars of half the damping have less than a limit, of even quantiles of a normal scatter."""
    from scipy.stats import norm

    drawn = 0.5 * DAMPING * (1.0 + 0.1 * norm.ppf((np.arange(400) + 0.5) / 400))
    return float(np.mean([least_force(damping, TIRE) < limit for damping in drawn]))


@pytest.mark.parametrize(
    ("values", "limit", "at"),
    [
        ([80.0, 40.0, 0.0], 60.0, 0.75),
        ([80.0, 40.0, 0.0], 90.0, 1.0),
        ([80.0, 70.0, 60.0], 50.0, None),
        ([80.0, np.nan, 40.0], 60.0, 0.5),
        ([np.nan, 40.0, 0.0], 60.0, 0.5),
        ([np.nan, np.nan, np.nan], 60.0, None),
    ],
)
def test_a_limit_is_reached_where_the_line_crosses_it(values, limit, at):
    assert crossing([1.0, 0.5, 0.0], values, limit) == at


def test_specimens_without_a_metric_do_not_pass_it(folder):
    """Of four cars one has no number, and one of the others less than the limit; at the last place none has one."""
    study = parse_sensitivity(Document.parse(STUDY + SCATTER, "cars.yaml"), folder, REGISTRY)
    drawn = np.full((2, 3, 4), np.nan)
    drawn[0, :2] = [[50.0, 30.0, np.nan, 60.0], [50.0, 60.0, 70.0, 80.0]]
    result = SensitivityResult(study, np.full((2, 3), 50.0), (), drawn)
    band, _ = sensitivity_content(result)["bands"]
    assert band["failing"] == [pytest.approx(1.0 / 3.0), 0.0, None] and band["median"] == [50.0, 65.0, None]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (STUDY.replace("phase_shift", "phase_shfit"), "there is no metric 'phase_shfit'"),
        (STUDY.replace("absorber.damping", "absorbr.damping"), "there is no parameter 'absorbr.damping'"),
        (STUDY.replace("factors: [1, 0.7, 0.5]", "values: [3 mm]"), "mm"),
        (STUDY.replace("factors: [1, 0.7, 0.5]", ""), "expected either 'values' or 'factors'"),
        (STUDY.replace("{eusama: 40}", "{hysteresis: 40}"), "'hysteresis' is none of the metrics"),
        (STUDY + "scatter: [{parameters: absorber.damping}]\n", "expected either 'deviation'"),
        (STUDY + "scatter: [{parameters: absorber.damping, deviation: 5}]\n", "expected a deviation above 0"),
        (STUDY.replace("sampling: 500 Hz", "sampeling: 500 Hz"), "sampeling"),
    ],
)
def test_mistakes_are_told(folder, text, told):
    with pytest.raises(InputError, match=told):
        found(folder, text)


def test_a_test_without_the_metric_is_refused(folder):
    text = STUDY.replace("rig: eusama", "rig: triangle").replace("options: {sampling: 500 Hz, duration: 16 s}\n", "")
    with pytest.raises(InputError, match="'eusama' cannot be taken from 'triangle'"):
        found(folder, text)
    with pytest.raises(InputError, match="several of its runs have it: eusama_m0, eusama_m5"):
        found(folder, STUDY.replace("duration: 16 s", 'duration: 16 s, added_masses: "0 kg, 5 kg"'))


def test_measured_runs_stand_beside_the_bands(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    (folder / "cars.yaml").write_text(STUDY + SCATTER)
    assert main(["simulate", "car.yaml", "--rig", "eusama", "-o", "car_data"]) == 0
    assert main(["study", "cars.yaml", "car_data", "-o", "out"]) == 0
    content = json.loads((folder / "out/sensitivity.json").read_text())
    measured = {row["metric"]: row["measured"] for row in content["measured"]}
    assert measured["eusama"] == pytest.approx(least_force(DAMPING, TIRE), abs=1.5)
    assert {path.name for path in (folder / "out").iterdir()} >= {"curves.csv", "bands.csv", "report.html"}
    assert least_force(0.5 * DAMPING, TIRE) > 40.0 and "eusama does not fall to 40 %" in capsys.readouterr().out

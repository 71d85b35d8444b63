"""Residuals, covariance and criteria of a fit against linear regression, and estimators of scikit-learn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of

import dashpot as dp
from dashpot.notebook.progress import Cancelled

TIME = np.arange(0.0, 20.0, 2e-3)
# a cubic in time: the path between samples is exact, and displacement and velocity are correlated
X, V = 1e-6 * (TIME + 1.0) ** 3, 3e-6 * (TIME + 1.0) ** 2
NOISE = 2.0
VOIGT = {
    "rubber": {"element": "spring", "stiffness": {"start": "150 N/mm"}},
    "loss": {"element": "damper", "damping": {"start": "5 N*s/mm"}},
}


@pytest.fixture(scope="module")
def regression():
    """A fit of two numbers, and what linear regression says of them: numbers, covariance, residual."""
    rng = np.random.default_rng(seed_of("fit_results"))
    force = 2e5 * X + 8e3 * V + NOISE * rng.normal(size=TIME.size)
    fit = dp.fit(dp.Network("voigt", VOIGT), dp.Data.from_arrays(TIME, X, force, name="press", kind="transient"))
    design = np.column_stack([X, V])
    numbers = np.linalg.lstsq(design, force, rcond=None)[0]
    residual = force - design @ numbers
    covariance = np.sum(residual**2) / (TIME.size - 2) * np.linalg.inv(design.T @ design)
    return fit, numbers, covariance, residual


def test_residuals_are_measured_less_simulated(regression):
    fit, numbers, _, residual = regression
    assert fit.free == ("rubber.stiffness", "loss.damping")
    assert [fit.model["rubber"].stiffness, fit.model["loss"].damping] == pytest.approx(numbers.tolist(), rel=1e-5)
    assert fit.residuals["press"] == pytest.approx(residual, abs=2e-2)


def test_the_covariance_is_that_of_regression_under_white_noise(regression):
    fit, _, covariance, _ = regression
    # 40 blocks of half a second: variances are known to some 20 %
    assert fit.covariance == pytest.approx(covariance, rel=0.4)
    correlation = covariance[0, 1] / np.sqrt(covariance[0, 0] * covariance[1, 1])
    assert fit.correlation[0, 1] == pytest.approx(correlation, abs=0.02)
    deviations = np.sqrt(np.diag(fit.covariance))
    intervals = [slot.value.interval for slot in fit.fitted.slots()]
    halves = [0.5 * (high - low) for low, high in intervals]
    assert all(1.9 * deviation < half < 2.6 * deviation for deviation, half in zip(deviations, halves, strict=True))


def test_a_number_that_shows_nowhere_has_no_finite_variance():
    force = 2e5 * X + np.random.default_rng(seed_of("fit_results")).normal(size=TIME.size)
    idle = {**VOIGT, "loss": {"element": "end_stop", "stiffness": {"start": "1 kN/mm"}, "compression": "1 m"}}
    fit = dp.fit(dp.Network("idle", idle), dp.Data.from_arrays(TIME, X, force, kind="transient"))
    assert np.isinf(fit.covariance[1, 1]) and fit.covariance[0, 1] == 0.0 and np.isfinite(fit.covariance[0, 0])


def test_criteria_are_those_of_the_residual(regression):
    fit, _, _, residual = regression
    likelihood = TIME.size * np.log(np.mean(residual**2))
    assert fit.aic == pytest.approx(likelihood + 4.0, abs=1e-2)
    assert fit.bic == pytest.approx(likelihood + 2.0 * np.log(TIME.size), abs=1e-2)


def test_a_fit_without_intervals_has_no_covariance(regression):
    with pytest.raises(ValueError, match="expected a fit with intervals"):
        replace(regression[0], correlation=None).covariance  # noqa: B018


def test_a_fit_predicts_other_runs(regression):
    fit, numbers, _, _ = regression
    other = dp.Data.from_arrays(TIME, 0.5 * X, 1e5 * X, name="half", kind="transient")
    assert fit.predict(other)["half"] == pytest.approx(0.5 * (numbers[0] * X + numbers[1] * V), rel=1e-4)


# --- scikit-learn --------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def sines():
    rng = np.random.default_rng(seed_of("sines"))
    time = np.arange(0.0, 2.0, 2e-3)
    parts = []
    for frequency in (2.0, 4.0, 8.0):
        for repeats in (None, f"f{frequency:g}"):
            phase = 2.0 * np.pi * frequency * time
            force = 200.0 * np.sin(phase) + 2.0 * np.pi * frequency * np.cos(phase) + rng.normal(size=time.size)
            name = f"f{frequency:g}" + "_b" * bool(repeats)
            parts.append(dp.Data.from_arrays(time, 1e-3 * np.sin(phase), force, name=name, repeats=repeats))
    return dp.Data.join(parts)


def test_cross_validation_leaves_groups_out(sines):
    selection = pytest.importorskip("sklearn.model_selection")
    folds = selection.GroupKFold(3)
    scores = selection.cross_val_score(
        dp.Estimator(dp.Network("voigt", VOIGT)), sines.runs, groups=sines.groups, cv=folds
    )
    for score, (train, test) in zip(scores, folds.split(sines.runs, groups=sines.groups), strict=True):
        assert {sines.groups[k] for k in train}.isdisjoint(sines.groups[k] for k in test)
        # the noise has variance 1, the force nearly that of its sine
        assert 1.0 - score == pytest.approx(1.0 / (200.0**2 / 2.0), rel=0.2)


def test_a_grid_search_chooses_the_model_that_predicts(sines):
    selection = pytest.importorskip("sklearn.model_selection")
    spring, voigt = dp.Network("spring", {"rubber": VOIGT["rubber"]}), dp.Network("voigt", VOIGT)
    search = selection.GridSearchCV(dp.Estimator(spring), {"model": [spring, voigt]}, cv=selection.GroupKFold(3))
    search.fit(sines.runs, groups=sines.groups)
    assert search.best_params_["model"].name == "voigt"
    [force] = search.predict(sines.select(["f4"]))
    assert force == pytest.approx(sines.run("f4").force, abs=5.0)
    assert search.best_estimator_.fit_.split.held_out == ()


# --- progress and cancelling ---------------------------------------------------------------------------------------


def test_progress_is_heard_and_a_line_is_wiped(sines, capsys):
    stages = []
    dp.fit(dp.Network("voigt", VOIGT), sines, progress=lambda stage, *_: stages.append(stage))
    assert {"voigt: search", "voigt: refinement"} <= set(stages) and capsys.readouterr().err == ""
    dp.fit(dp.Network("voigt", VOIGT), sines, progress=True)
    said = capsys.readouterr().err
    assert "voigt: search" in said and said.rpartition("\r")[0].rpartition("\r")[2].strip() == ""


def test_a_fit_and_a_diagnosis_end_when_they_are_told_to(sines):
    asked = iter([False, False, True])
    with pytest.raises(Cancelled, match="ended by its caller at 'voigt: "):
        dp.fit(dp.Network("voigt", VOIGT), sines, cancel=lambda: next(asked))
    with pytest.raises(Cancelled):
        dp.diagnose(dp.Network("voigt", VOIGT), sines, cancel=lambda: True)


def test_an_interruption_comes_through(sines):
    def interrupt(*_):
        raise KeyboardInterrupt

    for jobs in (1, 2):
        with pytest.raises(KeyboardInterrupt):
            dp.compare([dp.Network("voigt", VOIGT)], sines, progress=interrupt, jobs=jobs)

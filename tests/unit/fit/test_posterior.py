"""Posteriors against closed forms: Bayesian linear regression, and a normal distribution that a bound cuts off."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import ready, runs

import dashpot as dp
from dashpot.fit.api import prepare
from dashpot.fit.objective import Objective
from dashpot.fit.posterior import LogPosterior, require_sampler, scattered_starts
from dashpot.notebook.progress import Cancelled
from dashpot.text.problem import InputError

TIME = np.arange(0.0, 20.0, 2e-3)
# a cubic in time: the path between samples is exact, and displacement and velocity are correlated
X, V = 1e-6 * (TIME + 1.0) ** 3, 3e-6 * (TIME + 1.0) ** 2
STIFFNESS, DAMPING, NOISE = 2e5, 8e3, 15.0
MIDDLE, DEVIATION = 8.5e3, 1e3  # of the damping, N s/m
VOIGT = {
    "rubber": {"element": "spring", "stiffness": {"start": "150 N/mm", "scale": "linear"}},
    "loss": {
        "element": "damper",
        "damping": {"start": 5e3, "scale": "linear", "prior": {"normal": MIDDLE, "deviation": DEVIATION}},
    },
}
ERRORS = 4.0  # Monte Carlo standard errors


def data(name: str) -> dp.Dataset:
    """A press that is slowly closed, with white noise."""
    noise = NOISE * np.random.default_rng(seed_of(name)).standard_normal(TIME.size)
    return dp.Data.from_arrays(TIME, X, STIFFNESS * X + DAMPING * V + noise, name="press", kind="transient")


def off(share: float, density: float, effective: float) -> float:
    """How far a quantile of a ``share`` may be off, from the density there and the effective number of draws."""
    return float(ERRORS * np.sqrt(share * (1.0 - share) / effective) / density)


def counted(fit: dp.Fit) -> tuple[np.ndarray, np.ndarray]:
    """Displacement and velocity (2, n), and force (n,) of the samples that count."""
    first = prepare(fit.dataset, fit.seed).train[0].first
    return np.array([X, V])[:, first:], fit.dataset.runs[0].force[first:]


@pytest.fixture(scope="module")
def fit() -> dp.Fit:
    pytest.importorskip("emcee", reason="the extra sampler is not installed")
    return dp.fit(dp.Network("voigt", VOIGT), data("posterior"), sampler="emcee", seed=3)


@pytest.fixture(scope="module")
def closed(fit):
    """Mean (2,) and covariance (2, 2) of white noise of the error that the posterior has, with the prior."""
    table, force = counted(fit)
    precision = table @ table.T / fit.posterior.error**2 + np.diag([0.0, DEVIATION**-2])
    covariance = np.linalg.inv(precision)
    told = table @ force / fit.posterior.error**2 + np.array([0.0, MIDDLE / DEVIATION**2])
    return covariance @ told, covariance


def test_a_sample_counts_for_the_noise(fit):
    # from 40 blocks of half a second
    assert fit.posterior.error == pytest.approx(NOISE, rel=0.35)


def test_means_and_deviations_are_those_of_the_posterior(fit, closed):
    mean, covariance = closed
    draws = fit.posterior.draws.reshape(-1, 2)
    deviations = np.sqrt(np.diag(covariance))
    effective = np.array([each.effective for each in fit.posterior.marginals])
    assert np.all(np.abs(draws.mean(axis=0) - mean) < ERRORS * deviations / np.sqrt(effective))
    assert draws.std(axis=0) == pytest.approx(deviations, rel=0.1)
    correlation = covariance[0, 1] / np.prod(deviations)
    assert np.corrcoef(draws.T)[0, 1] == pytest.approx(correlation, abs=0.05)


def test_neither_data_nor_prior_decide_alone_in_this_test(closed):
    assert 0.3 < np.sqrt(closed[1][1, 1]) / DEVIATION < 0.95


def test_medians_and_intervals_are_those_of_the_posterior(fit, closed):
    mean, covariance = closed
    for each, middle, deviation in zip(fit.posterior.marginals, mean, np.sqrt(np.diag(covariance)), strict=True):
        found = (np.array([each.low, each.median, each.high]) - middle) / deviation
        tail = off(0.025, 0.0584, each.effective)
        assert found[[0, 2]] == pytest.approx([-1.96, 1.96], abs=tail)
        assert found[1] == pytest.approx(0.0, abs=off(0.5, 0.3989, each.effective))


def test_it_ends_when_it_has_converged_and_says_so(fit):
    assert fit.posterior.converged
    assert fit.posterior.discarded + fit.posterior.steps < 10_000
    told = fit.as_dict()["posterior"]
    assert told["converged"] and "the posterior converged" in fit.summary()
    each = told["parameters"]["loss.damping"]
    assert each["unit"] == "N/(m/s)" and each["r_hat"] < 1.05 and each["autocorrelation_time"] > 1.0
    assert each["effective_draws"] == pytest.approx(told["steps"] * told["walkers"] / each["autocorrelation_time"])


def test_all_draws_are_within_a_bound_and_lie_there_as_half_a_normal_distribution():
    pytest.importorskip("emcee", reason="the extra sampler is not installed")
    measured = data("posterior2")
    # the damping is known, the stiffness ends where the data would have its middle
    known = {"loss": {"element": "damper", "damping": DAMPING}}
    free = {"rubber": {"element": "spring", "stiffness": {"start": 1.5e5, "scale": "linear"}}}
    table, force = counted(dp.fit(dp.Network("free", {**free, **known}), measured))
    middle = float(table[0] @ (force - DAMPING * table[1]) / (table[0] @ table[0]))
    bound = {"start": 1.5e5, "scale": "linear", "bounds": [1e5, middle]}
    network = dp.Network("cut", {"rubber": {"element": "spring", "stiffness": bound}, **known})
    found = dp.fit(network, measured, sampler="emcee").posterior
    deviation = found.error / np.sqrt(table[0] @ table[0])
    [each] = found.marginals
    assert found.converged and found.draws.max() <= middle
    # quantiles of the absolute value of a standard normal number, and twice the normal density there
    for number, share, quantile, density in (
        (each.median, 0.5, 0.6745, 0.6356),
        (each.low, 0.975, 2.2414, 0.0647),
        (each.high, 0.025, 0.0313, 0.7975),
    ):
        assert (middle - number) / deviation == pytest.approx(quantile, abs=off(share, density, each.effective))


@pytest.mark.parametrize(
    "scale, prior, log_density",
    [
        ("log", "normal: 2.02e5, deviation: 8e3", lambda k: -0.5 * ((k - 2.02e5) / 8e3) ** 2 + np.log(k)),
        ("linear", "normal: 2.02e5, deviation: 8e3", lambda k: -0.5 * ((k - 2.02e5) / 8e3) ** 2),
        ("log", "lognormal: 2.02e5, deviation: 5 %", lambda k: -0.5 * (np.log(k / 2.02e5) / 0.05) ** 2),
        ("linear", "lognormal: 2.02e5, deviation: 5 %", lambda k: -0.5 * (np.log(k / 2.02e5) / 0.05) ** 2 - np.log(k)),
    ],
)
def test_a_prior_is_the_same_distribution_on_every_scale(scale, prior, log_density):
    scored = [run for run in runs(lambda x, v, a: 2e5 * x)]
    branch = f"rubber: {{element: spring, stiffness: {{start: 1e5, scale: {scale}, prior: {{{prior}}}}}}}"
    spec, objective, coordinates = ready(branch, scored)
    error = 3e4
    stiffness = np.array([1.8e5, 2e5, 2.3e5])
    points = (np.log(stiffness) if scale == "log" else stiffness)[:, None]
    found = LogPosterior(objective, coordinates, spec, error)(points)
    # all runs weigh the same: a long one's samples count for less
    squares = sum(
        objective.total / len(scored) * np.mean(run.drive.displacement[run.first :] ** 2) * (stiffness - 2e5) ** 2
        for run in scored
    )
    expected = -0.5 * squares / error**2 + log_density(stiffness)
    assert found - found[1] == pytest.approx(expected - expected[1], rel=1e-6)


def test_what_is_out_of_bounds_is_not_simulated(monkeypatch):
    spec, objective, coordinates = ready("rubber: {element: spring, stiffness: {start: 1e5}}", runs())
    asked = []
    monkeypatch.setattr(objective, "losses", lambda values: asked.append(len(values)) or np.zeros(len(values)))
    beyond = np.array([coordinates.high + 0.1, coordinates.start, coordinates.low - 0.1])
    assert np.isfinite(LogPosterior(objective, coordinates, spec, 1.0)(beyond)).tolist() == [False, True, False]
    assert asked == [1]


def test_data_without_noise_have_no_posterior():
    spec, objective, coordinates = ready("rubber: {element: spring, stiffness: {start: 1e5}}", runs())
    with pytest.raises(InputError, match="its posterior is a point"):
        LogPosterior(objective, coordinates, spec, 0.0)


def test_half_of_the_walkers_are_one_block(monkeypatch):
    pytest.importorskip("emcee", reason="the extra sampler is not installed")
    lanes, losses, steps = [], Objective.losses, 100

    def counting(self, values):
        lanes.append(len(values))
        return losses(self, values)

    def watch(stage, done, *_):
        # of the sampler's steps alone
        if stage.endswith("posterior") and done == 1.0 / steps:
            lanes.clear()

    monkeypatch.setattr(Objective, "losses", counting)
    dp.fit(dp.Network("voigt", VOIGT), data("posterior3"), sampler="emcee", sampler_steps=steps, progress=watch)
    assert lanes == [16] * 2 * (steps - 1)


def test_few_steps_do_not_converge_which_is_said():
    pytest.importorskip("emcee", reason="the extra sampler is not installed")
    asked = dict(sampler="emcee", sampler_steps=100, seed=5)
    one, other = (dp.fit(dp.Network("voigt", VOIGT), data("posterior4"), **asked) for _ in range(2))
    assert not one.posterior.converged
    assert "did not converge" in one.summary() and "--sampler-steps" in one.summary()
    assert one.posterior.draws.shape == (75, 32, 2)
    assert np.array_equal(one.posterior.draws, other.posterior.draws)


def test_a_thinned_chain_has_no_more_rows_than_asked(fit):
    table = fit.posterior.thinned(500)
    assert len(table) <= 500 and table.shape[1] == 4
    step, walker = table[-1, :2].astype(int)
    assert table[-1, 2:] == pytest.approx(fit.posterior.draws[step - fit.posterior.discarded, walker])


def test_it_can_be_cancelled():
    pytest.importorskip("emcee", reason="the extra sampler is not installed")
    stages = []
    with pytest.raises(Cancelled, match="voigt: posterior"):
        dp.fit(
            dp.Network("voigt", VOIGT),
            data("posterior5"),
            sampler="emcee",
            progress=lambda stage, *_: stages.append(stage),
            cancel=lambda: stages[-3:] == ["voigt: posterior"] * 3,
        )


def test_without_emcee_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "emcee", None)
    heard = []
    with pytest.raises(InputError, match=r"pip install 'dashpot\[sampler\]'"):
        dp.fit(
            dp.Network("voigt", VOIGT),
            data("posterior6"),
            sampler="emcee",
            progress=lambda *told: heard.append(told),
        )
    assert heard == []


def test_another_sampler_and_too_few_steps_are_refused():
    with pytest.raises(InputError, match="expected a sampler, got 'emce'.*did you mean 'emcee'"):
        require_sampler("emce")
    with pytest.raises(InputError, match="expected 100 steps or more, got 5"):
        require_sampler("emcee", 5)


def test_a_fit_does_not_import_the_sampler_unasked(monkeypatch):
    monkeypatch.setitem(sys.modules, "emcee", None)
    assert dp.fit(dp.Network("voigt", VOIGT), data("posterior7")).posterior is None


def test_interchangeable_branches_keep_their_order_in_every_draw():
    pytest.importorskip("emcee", reason="the extra sampler is not installed")
    branches = {
        name: {"element": "maxwell", "stiffness": {"start": stiffness}, "relaxation_time": {"start": time}}
        for name, stiffness, time in (("quick", "60 N/mm", "20 ms"), ("slow", "60 N/mm", "80 ms"))
    }
    rng = np.random.default_rng(seed_of("posterior8"))
    x = 1e-4 * np.cumsum(rng.standard_normal(5000)) / 10.0
    force = 1e5 * x + 200.0 * rng.standard_normal(x.size)
    measured = dp.Data.from_arrays(2e-3 * np.arange(x.size), x, force, name="walk")
    found = dp.fit(dp.Network("two", branches), measured, sampler="emcee", sampler_steps=200).posterior
    paths = [each.path for each in found.marginals]
    quick, slow = (found.draws[..., paths.index(f"{name}.relaxation_time")] for name in branches)
    assert np.all(quick <= slow)
    # of both, some draws are above a draw of the other: without an order they would change places
    assert quick.max() > slow.min()


def test_walkers_span_every_direction_where_a_sum_alone_is_told():
    """The sampler refuses walkers on a line: of two springs in parallel the data tell the sum."""
    springs = "\n".join(f"{name}: {{element: spring, stiffness: {{start: 5e4}}}}" for name in ("one", "other"))
    spec, objective, coordinates = ready(springs, runs())
    density, errors = LogPosterior(objective, coordinates, spec, 1e3), np.array([2e4, 2e4])
    starts = scattered_starts(density, errors, np.array([[1.0, -1.0], [-1.0, 1.0]]), np.random.default_rng(0))
    spread = np.linalg.svd((starts - starts.mean(axis=0)) / starts.std(axis=0), compute_uv=False)
    assert spread[1] > 1e-4 * spread[0]


def test_numbers_known_from_elsewhere_are_held_and_named():
    pytest.importorskip("emcee", reason="the extra sampler is not installed")
    known = {"known": DAMPING, "interval": [0.9 * DAMPING, 1.1 * DAMPING]}
    network = dp.Network("held", {"rubber": VOIGT["rubber"], "loss": {"element": "damper", "damping": known}})
    found = dp.fit(network, data("posterior9"), sampler="emcee", sampler_steps=100).posterior
    assert found.held == ("loss.damping",)
    assert [each.path for each in found.marginals] == ["rubber.stiffness"]

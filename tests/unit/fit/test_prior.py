"""Priors in a fit, against Bayesian linear regression, whose posterior has a closed form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from seeds import seed_of
from unit.fit.bench import STIFFNESS, network, ready, runs

from dashpot.fit.kept_curves import refinement
from dashpot.fit.prior import WithPriors, priors_of, refine_beside_priors, rows_beside, told_priors, with_earlier
from dashpot.fit.refine import refine
from dashpot.fit.uncertainty import assess_uncertainty, effective_error
from dashpot.model.identified import Identified
from dashpot.text.problem import InputError

NOISE, DRAWS = 40.0, 60
MIDDLES, DEVIATIONS = np.array([2.02e5, 310.0]), np.array([800.0, 20.0])
NORMAL = f"""
    rubber:
      element: spring
      stiffness: {{start: 1e5, scale: linear, prior: {{normal: {MIDDLES[0]}, deviation: {DEVIATIONS[0]}}}}}
    oil:
      element: damper
      damping: {{start: 1000, scale: linear, prior: {{normal: {MIDDLES[1]}, deviation: {DEVIATIONS[1]}}}}}
"""


@pytest.fixture(scope="module")
def noisy():
    rng = np.random.default_rng(seed_of("test_prior"))
    return [replace(each, first=0, force=each.force + NOISE * rng.standard_normal(each.force.size)) for each in runs()]


@pytest.fixture(scope="module")
def posterior(noisy):
    """Mean (2,) and covariance (2, 2) of stiffness and damping, of white noise and both priors."""
    x = np.concatenate([each.drive.displacement for each in noisy])
    v = np.concatenate([each.drive.velocity for each in noisy])
    table, force = np.array([x, v]), np.concatenate([each.force for each in noisy])
    precision = table @ table.T / NOISE**2 + np.diag(DEVIATIONS**-2)
    covariance = np.linalg.inv(precision)
    return covariance @ (table @ force / NOISE**2 + MIDDLES / DEVIATIONS**2), covariance


def test_the_fit_is_the_mean_of_the_posterior(noisy, posterior):
    spec, objective, coordinates = ready(NORMAL, noisy)
    found = refine(WithPriors(objective, objective, priors_of(spec), NOISE), coordinates, coordinates.start)
    assert coordinates.numbers(found.point) == pytest.approx(posterior[0], rel=1e-7)


def test_neither_data_nor_priors_decide_alone_in_this_test(posterior):
    share = np.sqrt(np.diag(posterior[1])) / DEVIATIONS
    assert np.all((share > 0.3) & (share < 0.95))


def test_the_intervals_are_those_of_the_posterior(posterior):
    rng = np.random.default_rng(seed_of("test_prior noises"))
    clean = [replace(each, first=0) for each in runs()]
    squares = []
    for _ in range(DRAWS):
        noisy = [replace(each, force=each.force + NOISE * rng.standard_normal(each.force.size)) for each in clean]
        spec, objective, coordinates = ready(NORMAL, noisy)
        found = refine(WithPriors(objective, objective, priors_of(spec), NOISE), coordinates, coordinates.start)
        rows = priors_of(spec).rows(coordinates, found.point)
        known = assess_uncertainty(objective, coordinates, found.point, priors=rows, error=NOISE)
        squares.append((known.errors * coordinates.unit) ** 2)
    # the scatter between blocks of one record is an estimate, which errs by a quarter; the priors are exact
    assert np.sqrt(np.mean(squares, axis=0)) == pytest.approx(np.sqrt(np.diag(posterior[1])), rel=0.12)


def test_a_sample_of_white_noise_counts_for_its_deviation(noisy):
    _, objective, coordinates = ready(NORMAL, noisy)
    found = refine(objective, coordinates, coordinates.start)
    assert effective_error(objective, coordinates, found.point) == pytest.approx(NOISE, rel=0.35)


def test_a_sample_of_slow_noise_counts_for_more():
    rng = np.random.default_rng(seed_of("test_prior2"))
    scored = runs()
    for each in scored:
        # the same force error in hundred neighbouring samples: a hundredth of them are independent
        each.force[:] += NOISE * np.repeat(rng.standard_normal(each.force.size // 100), 100)
    _, objective, coordinates = ready(NORMAL, scored)
    found = refine(objective, coordinates, coordinates.start)
    assert effective_error(objective, coordinates, found.point) > 2.0 * found.loss


def test_a_prior_decides_what_the_data_do_not():
    # so many that what a sample counts for, from the scatter between blocks of half a second, is half as much again
    # by chance in one of 100 000 sessions
    scored = [each for _ in range(8) for each in runs(lambda x, v, a: STIFFNESS * x)]
    rng = np.random.default_rng(seed_of("test_prior3"))
    for each in scored:
        each.force[:] += 0.1 * rng.standard_normal(each.force.size)
    spec, objective, coordinates = ready(
        """
        first: {element: spring, stiffness: {start: 1e5, prior: {lognormal: 80 N/mm, deviation: 5 %}}}
        second: {element: spring, stiffness: {start: 1e5}}
        """,
        scored,
    )
    found, error = refine_beside_priors(refinement(spec, objective, lambda slot: True), objective, 60, None)
    first, second = coordinates.numbers(found.point)
    assert first == pytest.approx(80e3, rel=1e-6)
    assert second == pytest.approx(STIFFNESS - 80e3, rel=1e-4)
    assert error == pytest.approx(0.1, rel=0.5)
    at = refinement(spec, objective, lambda slot: True).at(found.point)
    _, objective, coordinates = at, objective, replace(coordinates, base=np.array([first, second]))
    before, error = rows_beside(objective, coordinates, at, None)
    known = assess_uncertainty(objective, coordinates, coordinates.start, (), None, before, error)
    assert known.errors == pytest.approx([0.05, 0.05 * 80.0 / 120.0], rel=1e-3)
    assert known.idle == ()
    [told] = told_priors(at, coordinates, known.errors)
    assert told.narrowed == pytest.approx(1.0, rel=1e-3)
    assert abs(told.pull) < 1e-3
    assert "the data add nothing to it" in told.sentence


def test_residuals_and_rows_belong_to_the_same_loss(noisy):
    spec, objective, coordinates = ready(NORMAL, noisy)
    whole = WithPriors(objective, objective, priors_of(spec), NOISE)
    values = coordinates.to_values(np.array([coordinates.start, coordinates.start * 1.1]))
    assert np.sqrt(np.mean(whole.residuals(values) ** 2, axis=1)) == pytest.approx(whole.losses(values), rel=1e-12)
    moves = np.diag([10.0, 0.1])
    squares = sum(whole.linearise(values[0], moves, lambda _, rows: float(rows[0] @ rows[0])))
    assert np.sqrt(squares / objective.total) == pytest.approx(whole.losses(values)[0], rel=1e-12)


EARLIER = """
    rubber: {element: spring, stiffness: {value: 2e5, interval: [1.9e5, 2.05e5]}}
    oil: {element: damper, damping: {value: 300, interval: [280, 320], scale: linear}}
    other: {element: spring, stiffness: {start: 1e5}}
"""
NEXT = """
    rubber: {element: spring, stiffness: {start: 1e5}}
    oil: {element: damper, damping: {start: 1000, scale: linear}}
    other: {element: spring, stiffness: {start: 1e5}}
"""


def test_an_earlier_fit_gives_priors_of_the_parameters_it_identified():
    earlier = replace(network(EARLIER), identified=Identified({"data": "0123"}))
    found = priors_of(with_earlier(network(NEXT), earlier, "4567", "earlier.yaml"))
    assert found.paths == ("rubber.stiffness", "oil.damping")
    assert found.log.tolist() == [True, False]
    # 1.96 deviations on the wider side
    assert found.deviation == pytest.approx([np.log(2e5 / 1.9e5) / 1.959964, 20.0 / 1.959964])


def test_a_fit_of_the_same_data_is_refused_as_prior():
    earlier = replace(network(EARLIER), identified=Identified({"data": "0123"}))
    with pytest.raises(InputError, match="the same data would count twice"):
        with_earlier(network(NEXT), earlier, "0123456789", "earlier.yaml")


def test_an_earlier_fit_without_a_common_parameter_is_refused():
    with pytest.raises(InputError, match="expected identified parameters with intervals that 'bench' searches"):
        with_earlier(network(NEXT), network(NEXT), "0", "earlier.yaml")


@pytest.mark.parametrize(
    ("prior", "told"),
    [
        ("{normal: 60 N/mm}", "lacks 'deviation'"),
        ("{deviation: 5 N/mm}", "expected 'normal: MEAN' or 'lognormal: MEDIAN', got deviation"),
        ("{normal: 60 N/mm, lognormal: 60 N/mm, deviation: 1}", "expected 'normal: MEAN' or 'lognormal: MEDIAN'"),
        ("{normal: 60 N, deviation: 5 N/mm}", "expected a quantity in N/m"),
        ("{normal: 60 N/mm, deviation: 0 N/mm}", "expected a deviation above 0"),
        ("{lognormal: 60 N/mm, deviation: 5 N/mm}", "expected a plain number"),
        ("{lognormal: -60 N/mm, deviation: 5 %}", "expected a positive median"),
        ("{normal: 60 N/mm, deviation: 5 N/mm, width: 3}", "has no key 'width'"),
        ("{normal: 600 N/mm, deviation: 5 N/mm}", "expected a prior around a number inside its bounds"),
        ("60 N/mm", "expected rubber.stiffness, 'prior'"),
    ],
)
def test_what_is_no_prior_is_refused_with_its_place(prior, told):
    with pytest.raises(InputError) as caught:
        network(
            f"rubber: {{element: spring, stiffness: {{start: 50 N/mm, bounds: [1 N/mm, 100 N/mm], prior: {prior}}}}}"
        )
    assert told in str(caught.value)
    assert "n.yaml:4:" in str(caught.value)

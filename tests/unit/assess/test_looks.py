"""A look is taken once, and a search ends after so many of them."""

from inspect import signature

import numpy as np
import pytest
from unit.assess.rig import REGISTRY, STEP, fitted, sweep

import dashpot
from dashpot.assess.contest import Bench
from dashpot.assess.court import MOST_LOOKS, Court
from dashpot.assess.diagnose import diagnose
from dashpot.assess.pursuit import Pursuer
from dashpot.cli.diagnose import verb
from dashpot.data.dataset import Dataset
from dashpot.fit.api import prepare
from dashpot.model.reading import parse_network

SPRING = """\
format: dashpot-network/1
name: straight
branches:
  stiffness: {element: spring, stiffness: {start: 150 N/mm}}
"""
CAUSES = ("viscous_damping", "moving_mass", "stiffness_curve")


def heavy(x, v):
    """A spring of 200 N/mm, a damper and a mass of 2 kg."""
    return 200e3 * x + 400.0 * v + 2.0 * np.gradient(v, STEP)


def data(rng):
    runs = [sweep(f"r{k}", a, p, rng, heavy, k == 3)
            for k, (a, p) in enumerate([(2e-3, 10e-3), (4e-3, 12e-3), (6e-3, 16e-3), (4e-3, 14e-3)])]  # fmt: skip
    return Dataset("made", tuple(runs))


@pytest.fixture
def court(rng):
    setting = prepare(data(rng))
    bench = Bench(setting.train, REGISTRY.elements, {}, unseen=setting.held_out)
    return Court(bench, setting.held_out, [REGISTRY.causes[word] for word in CAUSES], 0)


def test_a_model_that_was_looked_at_is_not_looked_at_again(court):
    look = court.look(fitted(court.bench, SPRING), None)
    assert court.look(look.model, look.noise) is look
    assert court.effort.looks == 1
    court.glance(look.model, look)
    assert court.effort.looks == 2


def test_without_the_last_cause_it_is_the_look_in_which_that_was_found(court):
    pursuer = Pursuer(court, lambda what, done: None)
    first = court.look(fitted(court.bench, SPRING), None)
    (one,) = pursuer.best_trial(first, 0.0)
    second = court.look(one.trial.model, first.noise)
    (two,) = pursuer.best_trial(second, first.model.chi_square - second.model.chi_square)
    third = court.look(two.trial.model, second.noise)
    assert {entry.finding.candidate.cause.word for entry in (one, two)} == {"viscous_damping", "moving_mass"}
    looks = court.effort.looks
    assert court.look_without(two, [one], third, first.model) is second
    assert court.effort.looks == looks
    without = court.look_without(one, [two], third, first.model)
    assert court.effort.looks == looks + 1
    assert {leaf.name for leaf in without.model.fitted.leaves()} == {"stiffness", two.finding.candidate.cause.word}


def test_a_model_that_leaves_nothing_is_only_glanced_at(court):
    """The columns of all suspects are made anew as long as there is something to see, and then no more."""
    pursuer = Pursuer(court, lambda what, done: None)
    first = court.look(fitted(court.bench, SPRING), None)
    (one,) = pursuer.best_trial(first, 0.0)
    fall = first.model.chi_square - one.trial.model.chi_square
    second = court.look_after(one.trial.model, first, fall)
    assert second.columns.bank is not first.columns.bank
    (two,) = pursuer.best_trial(second, fall)
    third = court.look_after(two.trial.model, second, first.model.chi_square - two.trial.model.chi_square)
    assert third.columns.bank is second.columns.bank
    assert third.noise is second.noise and third.model is two.trial.model


def diagnosed(rng, **limits):
    spec = parse_network(SPRING, REGISTRY.elements)
    return diagnose(spec, data(rng), registry=REGISTRY, **limits)


def test_a_search_of_few_looks_ends_with_what_it_has_and_says_so(rng):
    whole, short = diagnosed(rng), diagnosed(rng, most_looks=1)
    assert (whole.verdict, len(whole.named), whole.pursuit.cut_short) == ("explained", 2, False)
    assert (short.verdict, len(short.named), short.pursuit.cut_short) == ("partly_explained", 1, True)
    assert any("--most-looks" in remark for remark in short.triage.remarks)
    assert not any("--most-looks" in remark for remark in whole.triage.remarks)


def test_all_ways_to_ask_for_a_diagnosis_allow_as_many_looks():
    options = {option.name: option.default for option in verb.params}
    assert options["most_looks"] == MOST_LOOKS
    for asked in (dashpot.diagnose, diagnose):
        assert signature(asked).parameters["most_looks"].default == MOST_LOOKS

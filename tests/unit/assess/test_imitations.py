"""A law with many numbers makes up that of another cause: what explains nearly as much with fewer is the cause."""

from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.assess.court import Court
from dashpot.assess.finalists import imitated, in_doubt, makes_up, settle_ties


def trial(word, gain, numbers, imitates=(), failure="", usual=0, strength=1.0):
    suspect = SimpleNamespace(imitates=imitates, usual=usual)
    candidate = SimpleNamespace(cause=SimpleNamespace(word=word), suspect=suspect, site=None)
    finding = SimpleNamespace(candidate=candidate, strengths=np.array([strength]))
    return SimpleNamespace(
        finding=finding, model=SimpleNamespace(numbers=numbers), gain=gain, merit=gain - 12.0 * numbers, failure=failure
    )


SLIDERS = {"word": "friction", "gain": 1000.0, "numbers": 15, "imitates": ("amplitude_softening",)}


@pytest.mark.parametrize(("gain", "numbers", "failure", "is_cause"), [
    (1100.0, 12, "", True),
    (985.0, 12, "", True),
    (975.0, 12, "", False),
    (985.0, 15, "", False),
    (985.0, 12, "the refit did not come to a finite end", False),
])  # fmt: skip
def test_a_law_that_explains_nearly_as_much_with_fewer_numbers_is_the_cause(gain, numbers, failure, is_cause):
    other = trial("amplitude_softening", gain, numbers, failure=failure)
    assert imitated(trial(**SLIDERS), [other]) == [other] * is_cause


def test_no_other_cause_is_imitated():
    assert not imitated(trial(**SLIDERS), [trial("relaxation", 999.0, 12)])


@pytest.mark.parametrize(("gain", "told"), [(10_000.0, False), (10_040.0, False), (10_060.0, True)])
def test_an_imitation_that_leads_by_more_than_forms_mostly_err_is_a_rival(gain, told):
    sliders = trial("friction", gain, 13, ("amplitude_softening",))
    assert in_doubt(sliders, trial("amplitude_softening", 10_000.0, 12)) is told
    assert not in_doubt(sliders, trial("relaxation", 10_000.0, 12))


@pytest.mark.parametrize(("more", "only_made_up"), [(15.0, True), (25.0, False)])
def test_an_imitation_does_not_take_the_place_of_a_law_for_little_more(more, only_made_up):
    sliders, law = (trial(word, 0.0, 13, words).finding for word, words in (
        ("friction", ("amplitude_softening",)), ("amplitude_softening", ())))  # fmt: skip
    assert makes_up(sliders, law, more, 1000.0) is only_made_up
    assert not makes_up(law, sliders, more, 1000.0)


@pytest.mark.parametrize(("more", "rivals"), [(2.0, 0), (40.0, 0), (80.0, 1)])
def test_a_law_that_contains_another_one_is_its_rival_only_where_it_leads(more, rivals):
    """Of 10 000 that both explain the larger one explains a little more, by two numbers at a price of 12 each."""
    plain, larger = trial("relaxation", 1e4, 3), trial("preload_dependent_damping", 1e4 + more, 5, ("relaxation",))
    for each in (plain, larger):
        each.finding.candidate.name = (each.finding.candidate.cause.word, "")
    chosen, others = settle_ties([plain, larger])
    assert chosen is plain
    assert len(others) == rivals


@pytest.mark.parametrize(("strength", "named"), [(6e-5, "delay"), (-6e-5, "viscous_damping")])
def test_of_causes_alike_one_of_an_unusual_sign_comes_last(strength, named):
    """A force that comes too early looks like a dashpot, by one number each."""
    delay = trial("delay", 1000.0, 1, usual=1, strength=strength)
    dashpot = trial("viscous_damping", 998.0, 1)
    for each in (delay, dashpot):
        each.finding.candidate.name = (each.finding.candidate.cause.word, "")
    chosen, others = settle_ties([delay, dashpot])
    assert chosen.finding.candidate.cause.word == named
    assert len(others) == 1


def test_an_imitation_comes_again_when_what_it_imitates_is_gone():
    def entry(word):
        candidate = SimpleNamespace(
            name=(word, ""), suspect=SimpleNamespace(form="a form"), cause=SimpleNamespace(word=word), site=None
        )
        return SimpleNamespace(finding=SimpleNamespace(candidate=candidate))

    court, friction, stribeck = Court(None, (), (), 0), entry("friction"), entry("velocity_dependent_friction")
    court.bar_imitation(stribeck, friction)
    assert court.barred == {("velocity_dependent_friction", "", "a form")}
    court.readmit_imitations(stribeck)
    assert court.barred == {("velocity_dependent_friction", "", "a form")}
    court.readmit_imitations(friction)
    assert not court.barred

"""A law with many numbers makes up that of another cause: what explains nearly as much with fewer is the cause."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.assess import reasons
from dashpot.assess.accepted import Accepted
from dashpot.assess.contest import Trial
from dashpot.assess.court import Court
from dashpot.assess.finalists import imitated, in_doubt, makes_up, settle_ties
from dashpot.assess.revision import Revision


def trial(word, gain, numbers, imitates=(), failure="", usual=0, strength=1.0, mends=False):
    suspect = SimpleNamespace(imitates=imitates, usual=usual, mends=mends)
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


def accepted(one):
    return Accepted(one.finding, Trial(one.finding, one.model, one.gain, one.merit), 0.0, None, ())


class Merging:
    """A court before which a refit is the model itself."""

    def __init__(self):
        self.rejected, self.rebuilt = [], []

    def rebuild(self, kept, model, first, noise):
        self.rebuilt = [entry.finding for entry in kept]
        return self.model

    def reject(self, finding, reason, foreseen, gain):
        self.rejected.append(reason)

    def gain_of(self, before, after):
        return None

    def look(self, model, noise):
        return SimpleNamespace(model=model, noise=noise)


@pytest.mark.parametrize("faults", [0, 1])
@pytest.mark.parametrize(("chi_square", "merged"), [(76_835.0, True), (76_990.0, False)])
def test_one_richer_law_takes_the_place_of_two_causes_where_it_explains_as_much(chi_square, merged, faults):
    """Friction that falls with speed, instead of friction and a damper that takes from it; an offset stays."""
    plain, falling, damper, offset = (accepted(one) for one in (
        trial("friction", 37e3, 23), trial("velocity_dependent_friction", 37.7e3, 26, ("friction",)),
        trial("power_law_damping", 600.0, 25), trial("offset", 900.0, 26, mends=True)))  # fmt: skip
    plain = replace(plain, others=(falling.trial,), base="before")
    between = [offset] * faults
    court = Merging()
    court.model = SimpleNamespace(chi_square=chi_square, numbers=26)
    look = SimpleNamespace(
        model=SimpleNamespace(chi_square=76_934.0, numbers=25), noise=None, screen=SimpleNamespace(samples=80_000)
    )
    before = [plain, *between, damper]
    entries, after = Revision(court, look.model, None).merge(before, look)
    expected = [falling, *between] if merged else before
    assert [entry.finding for entry in entries] == [entry.finding for entry in expected]
    assert court.rebuilt == [falling.finding, *(entry.finding for entry in between)]
    assert (after is look) is not merged
    assert court.rejected == [reasons.ONE_LAW] * merged


@pytest.mark.parametrize("still", [True, False])
def test_a_simpler_cause_takes_a_place_only_where_it_is_still_what_it_says(still, monkeypatch):
    """A relaxation with a factor over deflection that came out level is no damping that depends on preload."""
    level, later = trial("preload_dependent_damping", 1e4, 7), accepted(trial("friction", 500.0, 10))
    law = replace(accepted(trial("relaxation", 1e4, 8)), simpler=(level,), base="before")
    court = Merging()
    court.model = SimpleNamespace(chi_square=76_934.0, numbers=12)
    look = SimpleNamespace(
        model=SimpleNamespace(chi_square=76_934.0, numbers=13), noise=None, screen=SimpleNamespace(samples=80_000)
    )
    monkeypatch.setattr("dashpot.assess.revision.admitted", lambda *asked: still)
    entries, after = Revision(court, look.model, None).reconsider([law, later], look)
    assert entries[0].finding is (level.finding if still else law.finding)
    assert (after is look) is not still
    assert court.rejected == [reasons.SIMPLER_WILL_DO] * still

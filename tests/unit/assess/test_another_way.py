"""A cause that is accepted twice may imitate what two others do: the way without it is tried, and taken if better."""

from types import SimpleNamespace

import pytest

from dashpot.assess.court import Court
from dashpot.assess.pursuit import Pursuer

SAMPLES = 1000


def entry(word, form="a form", gain=1000.0):
    candidate = SimpleNamespace(name=(word, ""), suspect=SimpleNamespace(form=form), cause=SimpleNamespace(word=word),
                                site=None)  # fmt: skip
    return SimpleNamespace(finding=SimpleNamespace(candidate=candidate), trial=SimpleNamespace(gain=gain))


def look(chi_square, numbers, *findings):
    screen = SimpleNamespace(samples=SAMPLES, findings=[one.finding for one in findings])
    return SimpleNamespace(model=SimpleNamespace(chi_square=chi_square, numbers=numbers), screen=screen)


TWICE = [entry("drift", "settling"), entry("drift", "steady")]
TWO = [entry("gain"), entry("softening")]


def way(monkeypatch, instead, chi_square, numbers=12):
    """What is accepted where the way without drift ends with some causes at a chi square, the first at 5000."""
    asked = []

    def pursue(self, accepted, seen, first, most):
        asked.append(self.court.barred)
        return instead, look(chi_square, numbers)

    monkeypatch.setattr(Pursuer, "pursue", pursue)
    court = Court(None, (), (), 0)
    first = look(9000.0, 5, *TWICE, *TWO)
    accepted, _ = Pursuer(court, print).another_way(TWICE, look(5000.0, 12), first)
    assert asked == [{("drift", "", "settling"), ("drift", "", "steady")}]
    return accepted, court


def test_a_better_way_without_the_cause_is_taken(monkeypatch):
    accepted, court = way(monkeypatch, TWO, 4900.0)
    assert accepted == TWO
    assert [one.cause for one in court.rejected] == ["drift", "drift"]
    assert ("drift", "", "steady") in court.barred


@pytest.mark.parametrize(("instead", "chi_square", "numbers"), [
    (TWO, 5100.0, 12),
    (TWO, 4995.0, 12),
    (TWO, 4900.0, 40),
    ([entry("gain"), entry("gain")], 4900.0, 12),
])  # fmt: skip
def test_a_way_that_is_no_better_or_costs_more_numbers_is_not(monkeypatch, instead, chi_square, numbers):
    accepted, court = way(monkeypatch, instead, chi_square, numbers)
    assert accepted == TWICE
    assert not court.rejected and not court.barred


def test_a_second_form_of_next_to_nothing_is_what_the_first_one_leaves():
    seen, small = look(5000.0, 12), [entry("drift", "settling"), entry("drift", "steady", gain=20.0)]
    assert Pursuer(Court(None, (), (), 0), print).another_way(small, seen, seen) == (small, seen)


def test_without_a_cause_that_came_twice_there_is_no_other_way():
    seen = look(5000.0, 12)
    assert Pursuer(Court(None, (), (), 0), print).another_way(TWO, seen, seen) == (TWO, seen)

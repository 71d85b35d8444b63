"""Of an unusual sign, or with numbers gone astray: what was accepted is looked at once more."""

from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.assess.contest import Bench, Trial
from dashpot.assess.court import Court
from dashpot.assess.instead import of_usual_sign
from dashpot.fit.refine import Outcome

LOOK = SimpleNamespace(screen=SimpleNamespace(samples=80_000), floor=79.9e3, model=None, noise=None)


def trial(gain, numbers, chi_square, strength=1.0):
    suspect = SimpleNamespace(usual=1)
    finding = SimpleNamespace(candidate=SimpleNamespace(suspect=suspect), strengths=np.array([strength]))
    model = SimpleNamespace(numbers=numbers, chi_square=chi_square, outcome=Outcome.CONVERGED)
    return SimpleNamespace(finding=finding, gain=gain, model=model, failure="")


@pytest.mark.parametrize(("strength", "left", "stays"), [
    (-1.0, 79.8e3, False),  # a dashpot and a mass do better than a force that comes early
    (-1.0, 80.5e3, True),  # not by what is of interest
    (1.0, 79.8e3, True),  # a force that comes late is as usual as a dashpot
])  # fmt: skip
def test_a_usual_cause_takes_the_place_of_one_of_an_unusual_sign(monkeypatch, strength, left, stays):
    both = trial(66.7e3, 26, left)
    monkeypatch.setattr("dashpot.assess.instead.with_the_next", lambda court, form, look: [both])
    delay, dashpot = trial(65.9e3, 25, 80.55e3, strength), trial(65.8e3, 25, 80.6e3)
    court = SimpleNamespace(relevance=1.5e-3, leaves_room=lambda model, look: True)
    assert of_usual_sign(court, delay, [delay, dashpot], LOOK) is (None if stays else dashpot)


@pytest.mark.parametrize(("begins", "back", "admits", "counts"), [
    (83.5e3, 80.0e3, True, True),
    (83.5e3, 83.499e3, True, False),  # no better
    (83.5e3, 80.0e3, False, False),  # no longer what the cause says
    (80.0e3, 79.9e3, True, False),  # there was nothing left
])  # fmt: skip
def test_numbers_that_went_astray_start_anew_beside_what_is_accepted(monkeypatch, begins, back, admits, counts):
    model, other = (SimpleNamespace(chi_square=value, astray={"a": 1.0}) for value in (begins, back))
    monkeypatch.setattr(Bench, "revive", lambda bench, model, numbers, noise: other)
    monkeypatch.setattr("dashpot.assess.court.admitted", lambda trial, base, model: admits)
    first = Trial(None, model, 1e3, 9e2)
    found = Court(Bench((), {}, {}), (), (), 0).brought_back(first, LOOK)
    assert (found.model is other) is counts
    assert found.gain - first.gain == found.merit - first.merit == (begins - back) * counts

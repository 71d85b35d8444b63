"""Faults of many single runs: what acts in all runs may look like them, and those alike have one name."""

from types import SimpleNamespace

import pytest

from dashpot.assess.accepted import likely_fault
from dashpot.assess.instead import of_all_runs
from dashpot.fit.refine import Outcome

LOOK = SimpleNamespace(screen=SimpleNamespace(samples=80_000))
COURT = SimpleNamespace(relevance=1.5e-3)


def trial(gain, numbers, chi_square, runs=0):
    suspect = SimpleNamespace(local=bool(runs))
    finding = SimpleNamespace(candidate=SimpleNamespace(suspect=suspect), atoms=(0.0,) * (runs or 1))
    model = SimpleNamespace(numbers=numbers, chi_square=chi_square, outcome=Outcome.CONVERGED)
    return SimpleNamespace(finding=finding, gain=gain, model=model, failure="")


@pytest.mark.parametrize(("runs", "gain", "left", "stays"), [
    (7, 23e3, 80.0e3, False),  # softening and creep do better than seven drifts, with fewer numbers
    (7, 23e3, 80.6e3, True),  # not better
    (7, 15e3, 80.0e3, True),  # does not come near
    (3, 23e3, 80.0e3, True),  # faults of a few runs are faults
])  # fmt: skip
def test_a_cause_of_all_runs_takes_the_place_of_faults_of_many(monkeypatch, runs, gain, left, stays):
    both = trial(24e3, 31, left)
    monkeypatch.setattr("dashpot.assess.instead._with_the_next", lambda court, form, look: [both])
    drift, softening = trial(24e3, 32, 80.5e3, runs), trial(gain, 29, 81.5e3)
    assert of_all_runs(COURT, drift, [drift, softening], LOOK) is (None if stays else softening)


def fault(word, gain, *rivals):
    suspect = SimpleNamespace(local=word in ("gain", "offset", "drift"))
    candidate = SimpleNamespace(suspect=suspect, cause=SimpleNamespace(word=word))
    return SimpleNamespace(
        finding=SimpleNamespace(candidate=candidate), trial=SimpleNamespace(gain=gain), rivals=rivals
    )


def test_faults_that_may_all_be_one_have_the_name_of_the_largest():
    assert likely_fault([fault("offset", 9.0, "gain"), fault("gain", 5.0, "offset")]) == {"offset"}
    assert likely_fault([fault("offset", 2.0, "gain"), fault("friction", 9.0), fault("gain", 5.0, "offset")]) == {
        "gain"
    }
    assert likely_fault([fault("offset", 9.0, "gain"), fault("drift", 5.0)]) == set()
    assert likely_fault([fault("friction", 9.0)]) == set()

"""Faults of many single runs: what acts in all runs may look like them, and those alike have one name."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.assess.accepted import Accepted, likely_fault
from dashpot.assess.contest import Bench
from dashpot.assess.court import Court
from dashpot.assess.instead import of_all_runs
from dashpot.assess.mend import Mend
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
    monkeypatch.setattr("dashpot.assess.instead.with_the_next", lambda court, form, look: [both])
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


@dataclass(eq=False)
class Found:
    """A finding of faults in single runs."""

    word: str
    chosen: tuple[int, ...]
    candidate: SimpleNamespace = field(init=False)

    def __post_init__(self):
        self.candidate = SimpleNamespace(cause=SimpleNamespace(word=self.word), suspect=SimpleNamespace(local=True))

    def keeping(self, kept):
        return Found(self.word, tuple(self.chosen[k] for k in kept))


def mend_of(word, *runs):
    """One place for each of the runs."""
    shapes = {f"r{run}": np.eye(len(runs))[:, [k]] * np.ones(50) for k, run in enumerate(runs)}
    return Mend(Found(word, runs), tuple(range(len(runs))), shapes, np.ones(len(runs)), np.ones(len(runs)))


def accepted_with(rival, own):
    """An offset alike a gain; a model with the mend of the offset misses by 8e4."""
    models = [SimpleNamespace(chi_square=8e4, numbers=20, mends=(mend,), declared=None, fitted=None)
              for mend in (own, rival)]  # fmt: skip
    trials = [SimpleNamespace(finding=model.mends[0].finding, model=model, gain=1e3) for model in models]
    return Accepted(own.finding, trials[0], 0.1, None, ("gain",), (trials[1],)), models[0]


@pytest.mark.parametrize(("chi_square", "named"), [(8.0005e4, "gain"), (8.01e4, "offset")])
def test_a_fault_takes_the_known_name_in_the_runs_that_it_has_kept_if_it_is_alike_there(monkeypatch, chi_square, named):
    """It was found in two runs, one of which has another fault now; in that one the rival must not act."""
    entry, model = accepted_with(mend_of("gain", 3, 7), mend_of("offset", 7))
    tried = []

    def fit(self, declared, fitted, noise, mends):
        tried.append(mends)
        return SimpleNamespace(chi_square=chi_square, numbers=20)

    monkeypatch.setattr(Bench, "fit", fit)
    monkeypatch.setattr(Court, "look", lambda court, model, noise: "a look")
    court = Court(Bench((), {}, {}), (), (), 0)
    look = SimpleNamespace(model=model, noise=None, screen=SimpleNamespace(samples=80_000))
    agreed = court.agreed([entry], {"gain"}, look)
    ((instead,),) = tried
    assert set(instead.shapes) == {"r7"}
    assert instead.finding.chosen == (7,)
    if named == "offset":
        assert agreed is None
    else:
        (renamed,), seen = agreed
        assert (renamed.finding.word, renamed.rivals, seen) == ("gain", (), "a look")

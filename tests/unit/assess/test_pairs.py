"""Two causes of which each alone makes unseen runs worse are found together, and keep their places at the end."""

from types import SimpleNamespace

import pytest

from dashpot.assess.gain import Gain
from dashpot.assess.pursuit import Pursuer

FIRST = SimpleNamespace(name="first")
GAINS = {"curve and friction": -0.1, "curve and relaxation": 0.3, "curve and delay": 0.0}


def trial(words, merit):
    return SimpleNamespace(finding=words, model=words, gain=merit, merit=merit)


class Court:
    """Knows the gain of every model over the first one; a model is known by its words."""

    relevance = 0.0025
    bench = SimpleNamespace(runs=())
    asked = ()

    def look(self, model, noise):
        return SimpleNamespace(model=model, noise=noise)

    def foresee(self, finding, look):
        return 0.2

    def gain_of(self, before, after):
        assert before is FIRST
        return Gain(GAINS[after], (GAINS[after], GAINS[after]))

    def share_of_change(self, before, after):
        return 0.5

    def objection(self, trial, gain, change, look, explained):
        self.asked = (*self.asked, (trial.model, explained))
        return "" if gain.value > self.relevance else "does not make the held-out runs better"


@pytest.fixture
def pursuer(monkeypatch):
    monkeypatch.setattr(Pursuer, "accept", lambda self, ranked, imitations, gain, look: (ranked[0].model, gain.value))
    return Pursuer(Court(), lambda what, done: None)


def pair_of(pursuer, monkeypatch, trials):
    monkeypatch.setattr(Pursuer, "refit_finalists", lambda self, look, explained, exchange=False: trials)
    return pursuer.best_pair(trial("curve", 40.0), SimpleNamespace(model=FIRST, noise=None), 100.0)


def test_the_best_second_cause_with_which_unseen_runs_get_better_is_accepted_with_the_first(pursuer, monkeypatch):
    trials = [
        trial(f"curve and {word}", merit) for word, merit in (("relaxation", 8.0), ("delay", 3.0), ("friction", 9.0))
    ]
    first, second = pair_of(pursuer, monkeypatch, trials)
    assert first.trial.model == "curve"
    assert first.base is FIRST
    assert second == ("curve and relaxation", 0.3)
    assert pursuer.court.asked == (("curve and friction", 140.0), ("curve and relaxation", 140.0))


def test_where_no_second_cause_makes_them_better_neither_is_accepted(pursuer, monkeypatch):
    assert pair_of(pursuer, monkeypatch, [trial("curve and friction", 9.0), trial("curve and delay", 3.0)]) == []


@pytest.mark.parametrize(("as_the_last", "stays"), [(0.2, True), (0.001, False)])
def test_a_cause_that_gains_beside_all_others_is_not_useless(monkeypatch, as_the_last, stays):
    """In its own turn it made unseen runs worse."""
    value = Gain(as_the_last, (as_the_last, as_the_last))
    court = SimpleNamespace(relevance=0.0025, rebuild=lambda kept, model, first, noise: kept,
                            gain_of=lambda before, after: value)  # fmt: skip
    look = SimpleNamespace(model=None)
    found = Pursuer(court, None).gain_of_last(0, ["curve", "relaxation"], look, ["first", "curve", "both"])
    assert (found == value) is stays
    assert Pursuer(court, None).gain_of_last(0, ["curve"], look, ["first", "curve"]) is None

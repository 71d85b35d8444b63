"""Trials that fit the training runs alike, judged on held-out runs."""

from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.assess import court
from dashpot.assess.court import Court
from dashpot.assess.gain import Gain

STEP, SAMPLES = 1e-3, 20000


def trial(error, local=False):
    """A trial whose model leaves noise of so many N on the held-out run."""
    suspect = SimpleNamespace(local=local)
    return SimpleNamespace(model=error, finding=SimpleNamespace(candidate=SimpleNamespace(suspect=suspect)))


@pytest.fixture
def judging(monkeypatch):
    noise = np.random.default_rng().standard_normal(SAMPLES)
    monkeypatch.setattr(court, "misfits_of", lambda error, runs: [error * noise])
    runs = [SimpleNamespace(drive=SimpleNamespace(dt=STEP))]
    return Court(bench=None, held_out=runs, causes=(), seed=0)


@pytest.mark.parametrize(("own", "error", "local", "holds"), [
    (0.3, 1.0, False, True),
    (0.3, 1.001, False, True),
    (0.3, 1.02, False, False),
    (0.001, 1.0, False, False),
    (0.001, 1.02, True, True),
])  # fmt: skip
def test_a_tie_is_none_where_held_out_runs_tell_the_two_apart(judging, monkeypatch, own, error, local, holds):
    """``own`` is the gain of the other trial, ``error`` what it leaves where the best one leaves 1 N."""
    monkeypatch.setattr(Court, "gain_of", lambda self, before, after: Gain(own, (own, own)))
    look = SimpleNamespace(model=2.0)
    assert judging.holds_as_well(trial(error, local), trial(1.0), Gain(0.3, (0.25, 0.35)), look) is holds

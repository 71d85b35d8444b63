"""A cause that hardly makes the error smaller is refused, and what is hardly is the user's to say."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from dashpot.assess import reasons
from dashpot.assess.court import SMALLEST_GAIN, Court
from dashpot.assess.gain import Gain
from dashpot.assess.misfits import share_of_change

BEFORE = 1e6
RUNS = [SimpleNamespace(name="a", force=np.zeros(2), drive=SimpleNamespace(dt=1e-3), first=0, samples=2)]


def refusal(fall: float, gain: Gain | None = None, **relevance: float) -> str:
    """Why a trial whose training error is smaller by the share ``fall`` is refused."""
    court = Court(None, (), (), 0, **relevance)
    after = BEFORE * (1.0 - fall) ** 2
    trial = SimpleNamespace(
        failure="", merit=BEFORE - after, gain=BEFORE - after, model=SimpleNamespace(chi_square=after)
    )
    look = SimpleNamespace(screen=SimpleNamespace(threshold=10.0), model=SimpleNamespace(chi_square=BEFORE))
    return court.objection(trial, gain, fall, look, 0.0)


@pytest.mark.parametrize(("fall", "relevance", "refused"), [(0.04, 0.05, True), (0.06, 0.05, False)])
def test_a_smaller_gain_than_the_user_cares_for_is_refused(fall, relevance, refused):
    assert ("of no practical relevance" in refusal(fall, relevance=relevance)) is refused


@pytest.mark.parametrize(("gain", "refused"), [
    (Gain(0.02, (0.01, 0.03)), False),
    (Gain(0.02, (0.001, 0.04)), True),
    (Gain(0.02, (0.01, 0.03), "runs that show it"), True),
])  # fmt: skip
def test_a_first_cause_may_show_in_the_held_out_runs_alone(gain, refused):
    """Not where these were chosen because they show it."""
    assert ("of no practical relevance" in refusal(0.5 * SMALLEST_GAIN, gain)) is refused


def test_without_a_word_fifteen_of_ten_thousand_are_enough():
    assert "0.15%" in refusal(0.9 * SMALLEST_GAIN)
    assert refusal(1.1 * SMALLEST_GAIN) == ""


def test_the_change_is_what_a_cause_makes_of_the_plain_error(monkeypatch):
    """An effect of a fifth of the noise, and the noise: the root of 1 / 1.04 of the error is left."""
    rng = np.random.default_rng()
    noise, effect = rng.standard_normal((2, 100_000))
    misfits = {"before": noise + 0.2 * effect, "after": noise}
    monkeypatch.setattr("dashpot.assess.misfits.misfits_of", lambda model, runs: [misfits[model]])
    assert share_of_change("before", "after", RUNS, {}) == pytest.approx(1.0 - 1.04**-0.5, rel=0.05)
    assert share_of_change("before", "before", RUNS, {}) == 0.0


@pytest.mark.parametrize(("effect", "share"), [
    (np.array([3.0, -3.0]), 1.0 - np.sqrt(1.0 - 3.0**2 / 5.0**2)),
    (np.array([12.0, 12.0]), 1.0 - np.sqrt(1.0 - 12.0**2 / (20.0**2 + 5.0**2))),
])  # fmt: skip
def test_what_a_data_sheet_admits_does_not_hide_a_change_nor_shrink_one(effect, share, monkeypatch):
    """An offset of 20 N, of which the sheet admits 30 N, beside an error of 5 N."""
    before = np.array([25.0, 15.0])
    misfits = {"before": [before], "after": [before - effect]}
    monkeypatch.setattr("dashpot.assess.misfits.misfits_of", lambda model, runs: misfits[model])
    assert share_of_change("before", "after", RUNS, {"a": {"zero": 10.0}}) == pytest.approx(share)


def test_a_long_run_counts_no_more_than_a_short_one(monkeypatch):
    rng = np.random.default_rng()
    short, long = rng.standard_normal(20_000), rng.standard_normal(60_000)
    misfits = {"before": [1.2 * short, long], "after": [short, long]}
    monkeypatch.setattr("dashpot.assess.misfits.misfits_of", lambda model, runs: misfits[model])
    before = (1.2**2 + 1.0) / 2.0
    expected = 1.0 - np.sqrt(1.0 - 0.2**2 / 2.0 / before)
    assert share_of_change("before", "after", [*RUNS, *RUNS], {}) == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize(("word", "gain", "refused"), [
    ("end_stop", 12e3, True), ("end_stop", 18e3, False), ("friction", 12e3, False)])  # fmt: skip
def test_a_law_that_the_accepted_curve_could_make_up_has_to_explain_more_than_its_form(word, gain, refused):
    """A curve through knots has explained 500 000 of chi square, a stop comes on top."""
    court = Court(None, (), (), 0)
    court.made_up = {"end_stop"}
    finding = SimpleNamespace(candidate=SimpleNamespace(cause=SimpleNamespace(word=word)))
    after = SimpleNamespace(chi_square=90e3 - gain)
    trial = SimpleNamespace(failure="", merit=gain, gain=gain, model=after, finding=finding)
    look = SimpleNamespace(
        screen=SimpleNamespace(threshold=10.0, together=gain), model=SimpleNamespace(chi_square=90e3)
    )
    said = court.objection(trial, Gain(0.05, (0.04, 0.06)), 0.05, look, 500e3)
    assert said == (reasons.WITHIN_FORM if refused else "")


def test_a_fault_that_gains_nothing_on_pieces_of_the_only_runs_does_not_hold():
    """Without held-out runs there is nothing else to judge it by."""
    court = Court(None, (), (), 0)
    assert court.holds(None, None, None)
    assert court.holds(None, None, Gain(0.01, (0.0, 0.02)))
    assert not court.holds(None, None, Gain(-0.01, (-0.02, 0.0)))

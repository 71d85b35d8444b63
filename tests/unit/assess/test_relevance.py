"""A cause that hardly makes the error smaller is refused, and what is hardly is the user's to say."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from dashpot.assess.pursuit import SMALLEST_GAIN, Pursuer

BEFORE = 1e6


def refusal(fall: float, **relevance: float) -> str:
    """Why a trial whose training error is smaller by the share ``fall`` is refused."""
    pursuer = Pursuer(None, (), (), 0, print, **relevance)
    after = BEFORE * (1.0 - fall) ** 2
    trial = SimpleNamespace(
        failure="", merit=BEFORE - after, gain=BEFORE - after, model=SimpleNamespace(chi_square=after)
    )
    look = SimpleNamespace(screen=SimpleNamespace(threshold=10.0), model=SimpleNamespace(chi_square=BEFORE))
    return pursuer.objection(trial, None, look, 0.0)


@pytest.mark.parametrize(("fall", "relevance", "refused"), [(0.04, 0.05, True), (0.06, 0.05, False)])
def test_a_smaller_gain_than_the_user_cares_for_is_refused(fall, relevance, refused):
    assert ("of no practical relevance" in refusal(fall, relevance=relevance)) is refused


def test_without_a_word_half_a_thousandth_is_enough():
    assert "0.05%" in refusal(0.9 * SMALLEST_GAIN)
    assert refusal(1.1 * SMALLEST_GAIN) == ""

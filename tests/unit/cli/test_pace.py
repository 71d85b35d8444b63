"""The time left is what is left of the work at the pace so far."""

from __future__ import annotations

import pytest

from dashpot.cli.pace import Pace, shown_left


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


def test_work_at_an_even_pace_ends_when_foretold():
    clock = Clock()
    pace = Pace(clock)
    assert pace.left() is None
    for seconds in range(1, 10):
        clock.now = 100.0 + seconds
        pace.note(seconds / 10)
        assert pace.left() == pytest.approx(10 - seconds)
    clock.now += 0.25
    assert pace.left() == pytest.approx(0.75)
    clock.now += 60.0
    assert pace.left() == 0.0


def test_a_new_piece_of_work_has_a_pace_of_its_own():
    clock = Clock()
    pace = Pace(clock)
    clock.now = 200.0
    pace.note(0.9)
    pace.note(0.0)
    assert pace.left() is None
    clock.now = 201.0
    pace.note(0.5)
    assert pace.left() == pytest.approx(1.0)


def test_silence_about_the_share_changes_nothing():
    pace = Pace(Clock())
    pace.note(0.5)
    pace.note(None)
    assert pace.share == 0.5


@pytest.mark.parametrize(
    "seconds, text", [(None, "-:-- left"), (0.2, "0:00 left"), (125.0, "2:05 left"), (3725.0, "1:02:05 left")]
)
def test_the_time_left_is_read_like_a_clock(seconds, text):
    assert shown_left(seconds) == text

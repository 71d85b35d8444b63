"""What is left counts where it is certain and not negligible beside the noise, or beside what is explained."""

from __future__ import annotations

import pytest

from dashpot.assess.leftover import Leftover


@pytest.mark.parametrize(
    ("score", "size", "explained", "notable"),
    [
        (50.0, 0.15, 0.0, True),
        (50.0, 0.05, 0.0, False),
        (3.0, 0.5, 0.0, False),
        (50.0, 0.05, 10.0, False),
        (50.0, 0.05, 0.1, True),
        (3.0, 0.05, 0.1, False),
        (50.0, 0.15, 10.0, True),
    ],
)
def test_what_is_left_is_measured_by_the_noise_and_by_what_is_explained(score, size, explained, notable):
    assert Leftover(score, size, "follows the velocity").notable(explained) is notable

"""Facts of searches that advance together."""

from __future__ import annotations

import numpy as np
import pytest

from dashpot.contract.optimizer import Search, Space
from dashpot.contract.side_by_side import agreement, side_by_side

SPACE = Space(("a",), np.array([0.5]))


class Steps(Search):
    """Asks a number of times; remembers what it was told; may change what it needs."""

    word = "steps"

    def __init__(self, lanes: int, times: int, needs: str = "losses"):
        self.lanes, self.times, self.needs, self.told, self.closed = lanes, times, needs, [], False

    def search(self, space, rng):
        for _ in range(self.times):
            self.told.append((yield np.full((self.lanes, 1), space.start)))

    def close(self) -> None:
        super().close()
        self.closed = True


class Owner(Search):
    """Runs its members side by side."""

    word = "owner"

    def __init__(self, *members):
        self.members = members

    def search(self, space, rng):
        spaces = [Space(("a",), np.array([0.1 * number])) for number in range(len(self.members))]
        self.best = yield from side_by_side(self, self.members, spaces, [0] * len(spaces))


def run(owner: Owner, values=lambda points, round: points[:, 0] + round) -> list[tuple[str, list[float]]]:
    """What was asked in each round."""
    asked = []
    owner.begin(SPACE, 1)
    while (points := owner.ask()) is not None:
        asked.append((owner.needs, points[:, 0].tolist()))
        owner.tell(points, values(points, len(asked)))
    return asked


def test_blocks_are_asked_as_one_and_told_apart() -> None:
    first, second = Steps(2, 2), Steps(1, 2)
    asked = run(Owner(first, second))
    assert asked == [("losses", [0.0, 0.0, 0.1])] * 2
    assert [values.tolist() for values in first.told] == [[1.0, 1.0], [2.0, 2.0]]
    assert [values.tolist() for values in second.told] == [[1.1], [2.1]]


def test_a_member_that_is_done_drops_out() -> None:
    asked = run(Owner(Steps(1, 1), Steps(1, 3)))
    assert [points for _, points in asked] == [[0.0, 0.1], [0.1], [0.1]]


def test_members_with_other_needs_wait() -> None:
    asked = run(Owner(Steps(1, 2), Steps(1, 1, "residuals")))
    assert asked == [("losses", [0.0]), ("losses", [0.0]), ("residuals", [0.1])]


def test_the_best_loss_of_each_is_returned() -> None:
    owner = Owner(Steps(2, 2), Steps(1, 1, "residuals"))
    losses = iter([np.array([3.0, 2.0]), np.array([5.0, 4.0]), np.array([[7.0, 7.0]])])
    run(owner, lambda points, round: next(losses))
    assert owner.best == [2.0, 7.0]


def test_all_are_closed_when_the_owner_is() -> None:
    members = Steps(1, 9), Steps(1, 9)
    owner = Owner(*members)
    owner.begin(SPACE, 1)
    for member in members:
        member.closed = False
    owner.close()
    assert all(member.closed for member in members)


@pytest.mark.parametrize(
    ("best", "share"), [([1.0, 1.009, 1.02], "2 of 3"), ([2.0], "1 of 1"), ([0.0, 0.0, 1.0], "2 of 3")]
)
def test_agreement_counts_the_starts_that_end_alike(best: list[float], share: str) -> None:
    assert agreement(best) == f"{share} starts end within 1 % of the best"

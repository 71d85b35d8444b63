"""Several searches that advance together, so that their blocks are evaluated as one."""

from __future__ import annotations

from collections.abc import Generator, Sequence

import numpy as np

from dashpot.contract.optimizer import Optimizer, Search, Space, losses_of

ALIKE = 0.01


def side_by_side(
    owner: Search, members: Sequence[Optimizer], spaces: Sequence[Space], seeds: Sequence[int]
) -> Generator[np.ndarray, np.ndarray, list[float]]:
    """Run each member from its own start; returns the best loss of each.

    For `best = yield from side_by_side(...)` in the `search` of `owner`, whose needs follow those of the members. A
    member that is done drops out; one that needs something else than the first waits a round.
    """
    best = [np.inf] * len(members)
    try:
        for member, space, seed in zip(members, spaces, seeds, strict=True):
            member.begin(space, seed)
        while asked := {number: points for number, m in enumerate(members) if (points := m.ask()) is not None}:
            owner.needs = members[min(asked)].needs
            asked = {number: points for number, points in asked.items() if members[number].needs == owner.needs}
            values = yield np.concatenate(list(asked.values()))
            ends = np.cumsum([len(points) for points in asked.values()])
            for (number, points), part in zip(asked.items(), np.split(values, ends[:-1]), strict=True):
                best[number] = min(best[number], float(losses_of(part).min()))
                members[number].tell(points, part)
    finally:
        for member in members:
            member.close()
    return best


def agreement(best: Sequence[float]) -> str:
    """How many searches end at nearly the same loss: the evidence that it is the smallest one."""
    alike = sum(loss <= (1.0 + ALIKE) * min(best) for loss in best)
    return f"{alike} of {len(best)} starts end within {100.0 * ALIKE:g} % of the best"

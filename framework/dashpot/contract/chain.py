"""Optimizers by what the user writes: a word, or `A+B`, where B begins at the best point of A."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dashpot.contract.optimizer import Blocks, Needs, Optimizer, Search, Space, losses_of
from dashpot.contract.options import read_options
from dashpot.text.problem import nearest

JOINT = "+"
LEFT_FOR_THE_REST = 0.25


class Chain(Search):
    """Each optimizer begins at the best point of those before it.

    With an allowance the ones before the last leave a quarter of what is left to those behind them.
    """

    def __init__(self, members: Sequence[Optimizer]) -> None:
        self.members = tuple(members)
        self.word = JOINT.join(member.word for member in members)  # type: ignore[misc]
        self.needs: Needs = self.members[0].needs

    def search(self, space: Space, rng: np.random.Generator) -> Blocks:
        """Run one after the other."""
        best, loss, spent, remarks = space.start, np.inf, 0, []
        for number, member in enumerate(self.members):
            last = number == len(self.members) - 1
            share = self._share(spent, last)
            member.allowance = share
            member.begin(Space(space.names, best), int(rng.integers(2**32)))
            used = 0
            try:
                while (points := member.ask()) is not None and (last or share is None or used + len(points) <= share):
                    self.needs = member.needs
                    values = yield points
                    used += len(points)
                    losses = losses_of(values)
                    if losses.min() < loss:
                        best, loss = points[losses.argmin()].copy(), float(losses.min())
                    member.tell(points, values)
                remarks.append(f"{member.word}: {member.conclusion or 'its share of the budget is spent'}")
            finally:
                member.close()
            spent += used
        return "; ".join(remarks)

    def _share(self, spent: int, last: bool) -> int | None:
        if self.allowance is None:
            return None
        left = self.allowance - spent
        return left if last else int((1.0 - LEFT_FOR_THE_REST) * left)


def make_optimizer(
    text: str, known: Mapping[str, type[Optimizer]], options: Mapping[str, Any] | None = None
) -> Optimizer:
    """The optimizer `text` with options; those of a chain are called `word.option`.

    ValueError for a word or an option that is not known, or a library that is not installed.
    """
    words = text.split(JOINT)
    made = [known_optimizer(word, known)(**_own(options or {}, word, len(words))) for word in words]
    return made[0] if len(made) == 1 else Chain(made)


def read_optimizer_options(text: str, known: Mapping[str, type[Optimizer]], texts: Mapping[str, str]) -> dict[str, Any]:
    """The options `texts` of the optimizer `text`, each in its type. ValueError when they do not fit."""
    words = text.split(JOINT)
    for name in texts if len(words) > 1 else ():
        if name.partition(".")[0] not in words or "." not in name:
            raise ValueError(f"option '{name}': expected '{words[0]}.option' or another word of '{text}' in its place")
    found: dict[str, Any] = {}
    for word in words:
        own = read_options(known_optimizer(word, known), _own(texts, word, len(words)))
        found |= own if len(words) == 1 else {f"{word}.{name}": value for name, value in own.items()}
    return found


def known_optimizer(word: str, known: Mapping[str, type[Optimizer]]) -> type[Optimizer]:
    """The optimizer of a single word. ValueError when there is none or its library is not installed."""
    if word not in known:
        hint = nearest(word, known) or f"there are: {', '.join(known) or 'none'}"
        raise ValueError(f"No such optimizer '{word}', {hint}")
    missing = known[word].missing()
    if missing:
        raise ValueError(f"optimizer '{word}' needs the library '{missing}': pip install 'dashpot[{missing}]'")
    return known[word]


def _own(options: Mapping[str, Any], word: str, members: int) -> dict[str, Any]:
    if members == 1:
        return dict(options)
    return {name.partition(".")[2]: value for name, value in options.items() if name.partition(".")[0] == word}

"""The detection limit of each cause: the smallest effect that is found with 95 % power."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dashpot.diagnose.candidate import Candidate
from dashpot.diagnose.look import Look

Array = NDArray[np.float64]

POWER = 0.95
QUANTILE = 1.6448536269514722  # of the normal distribution, at this power
SEEN = 1e-5  # of the square of a column that a refit has to leave


@dataclass(frozen=True)
class Limit:
    """``strength`` at the place where a cause shows best, ``force`` the RMS in N that it makes, ``left`` by a refit."""

    candidate: Candidate
    strength: float
    force: float
    left: float


def find_limits(look: Look, relevance: float) -> list[tuple[Candidate, Limit | None]]:
    """The limit of every cause at every site; None where the runs do not show it beside the parameters of the model.

    An effect is found where its nats exceed its prior odds, and is named where the error would grow by the share
    ``relevance`` without it.
    """
    found: dict[tuple[str, str], tuple[Candidate, Limit | None]] = {}
    odds, first = look.odds, look.layout.first_candidate
    left = look.front.squares
    noise = np.sqrt(float(left[0]) / float(look.samples.sum()))
    for candidate in (candidate for candidate in look.candidates if candidate.provable):
        _, best = found.setdefault(candidate.name, (candidate, None))
        for place in range(candidate.columns.start, candidate.columns.stop):
            at = first + place
            size = look.sizes[at]
            if not size > 0.0 or left[at] < SEEN * float(look.samples.sum()) * (size / look.rich) ** 2:
                continue
            needed = noise * (np.sqrt(2.0 * odds.price(candidate.cause.kind)) + QUANTILE) / np.sqrt(left[at])
            relevant = noise * np.sqrt(2.0 * relevance * float(look.samples.sum()) / left[at])
            strength = float(max(needed, relevant))
            seen = strength * np.sqrt(left[at] / float(look.samples.sum())) * look.rich
            limit = Limit(candidate, strength, float(strength * size), float(min(seen, strength * size)))
            if strength <= candidate.suspect.largest and (best is None or limit.force < best.force):
                best = limit
        found[candidate.name] = candidate, best
    return list(found.values())

"""How well probabilities told come true: Brier score and reliability diagram."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.stats import binomtest

sys.path.insert(0, str(Path(__file__).parents[1]))

from real.drawing import Panel, panels  # the small pictures of the measured sets

Told = tuple[float, bool]  # the probability of a name, and whether it was hidden
EDGES = (0.0, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0)
EXPECTED_COLOR, FOUND_COLOR = "#8b949e", "#0072b2"


@dataclass(frozen=True)
class Bin:
    """The names told with a probability from `low` to `high`, the mean of these, and how many were right."""

    low: float
    high: float
    told: float
    right: int
    count: int

    @property
    def share(self) -> float:
        """The share that was right."""
        return self.right / self.count

    @property
    def interval(self) -> tuple[float, float]:
        """The exact 95 % interval of the share (Clopper and Pearson)."""
        found = binomtest(self.right, self.count).proportion_ci(method="exact")
        return float(found.low), float(found.high)


def brier(told: Sequence[Told]) -> float | None:
    """Mean square of probability minus outcome (Brier 1950): 0 is perfect, 0.25 says nothing; None without names."""
    return sum((probability - right) ** 2 for probability, right in told) / len(told) if told else None


def reliability(told: Sequence[Told], edges: Sequence[float] = EDGES) -> list[Bin]:
    """The bins that hold a name; each has its lower edge, the last one both. ValueError for what is no probability."""
    if wrong := [probability for probability, _ in told if not edges[0] <= probability <= edges[-1]]:
        raise ValueError(f"probability: expected {edges[0]:g} to {edges[-1]:g}, got {wrong[0]:g}")
    places = [min(int(np.searchsorted(edges, probability, side="right")), len(edges) - 1) for probability, _ in told]
    found = []
    for place in sorted(set(places)):
        inside = [one for one, at in zip(told, places, strict=True) if at == place]
        mean = sum(probability for probability, _ in inside) / len(inside)
        found.append(Bin(edges[place - 1], edges[place], mean, sum(right for _, right in inside), len(inside)))
    return found


def as_text(bins: Sequence[Bin]) -> str:
    """A table, one line a bin."""
    lines = ["told              mean   right          95 % interval"]
    for one in bins:
        low, high = one.interval
        lines.append(
            f"{one.low:4.2f} to {one.high:4.2f}  {one.told:8.3f}  {f'{one.right} of {one.count}':>12}  "
            f"{low:6.2f} to {high:4.2f}"
        )
    return "\n".join(lines)


def diagram(bins: Sequence[Bin]) -> str:
    """The reliability diagram as SVG: share right over mean probability with its interval, beside the diagonal."""
    ends = np.array([0.0, 1.0])
    told, share = (np.array([getattr(one, name) for one in bins]) for name in ("told", "share"))
    whiskers = [(FOUND_COLOR, np.full(2, one.told), np.array(one.interval)) for one in bins]
    curves = [(EXPECTED_COLOR, ends, ends), *whiskers, *([(FOUND_COLOR, told, share)] if bins else [])]
    legend = [(FOUND_COLOR, "share right, 95 % interval"), (EXPECTED_COLOR, "as told")]
    names = sum(one.count for one in bins)
    return panels([Panel(f"{names} names", curves)], "probability told", "share right", legend)

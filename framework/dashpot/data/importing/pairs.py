"""Which two columns are displacement and force: how well the one explains the other, and whether work is lost."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from dashpot.data.importing.correlation import correlation
from dashpot.data.importing.signs import THIN, falls, find_signs, lost_work

# from this correlation on two columns are one signal
SAME = 0.9995
# a motion explains a force from this share of its variance on
MOSTLY = 0.5
_SAMPLES = 4000
# from this rank correlation with the time on
_WITH_CLOCK = 0.9


@dataclass(frozen=True)
class Pair:
    """Two columns, the share of the force that the motion explains, and other columns that may be the force.

    These are as well explained, and the other displacements explain as well, as far as the pair itself leaves open.
    """

    displacement: str
    force: str
    explained: float
    rivals: tuple[str, ...] = ()
    other_displacements: tuple[str, ...] = ()


def explained(motion: np.ndarray, force: np.ndarray) -> float:
    """The share of the variance of a force (n,) that deflection (n,), its rate and its direction explain."""
    rate = np.gradient(motion)
    stride = max(1, motion.size // _SAMPLES)
    x, v, seen = (_scaled(values)[::stride] for values in (motion, rate, force))
    basis = np.stack([np.ones_like(x), x, x**2, x**3, v, v * np.abs(v), np.tanh(3.0 * v)], axis=1)
    rest = seen - basis @ np.linalg.lstsq(basis, seen, rcond=None)[0]
    variance = float(np.var(seen))
    return 1.0 - float(np.var(rest)) / variance if variance > 0.0 else 0.0


def loses_work(motion: np.ndarray, force: np.ndarray) -> bool:
    """Whether a force makes a loop over the motion that is wider than a machine may feign, whichever way round."""
    return abs(lost_work(motion, force)) > THIN


def best_pair(columns: Mapping[str, np.ndarray], displacements: Sequence[str], forces: Sequence[str]) -> Pair | None:
    """The best of all pairs of these columns; None where there is none.

    A force that loses work comes before one that does not, if the motion explains most of it: copies of the motion and
    accelerations lose none.
    """
    found: dict[tuple[str, str], tuple[bool, float]] = {}
    for first in displacements:
        for second in forces:
            if first != second and not is_like(columns[first], columns[second]):
                share = explained(columns[first], columns[second])
                found[first, second] = share > MOSTLY and loses_work(columns[first], columns[second]), share
    if not found:
        return None
    first, second = max(found, key=lambda pair: found[pair])
    lossy, share = found[first, second]
    as_good = [
        pair for pair, (also, another) in found.items() if also == lossy and not is_clearly_better(share, another)
    ]
    rivals = tuple(other for one, other in as_good if one == first and other != second)
    # copies of the displacement differ in their unit only
    others = tuple(
        one for one, other in as_good if other == second and one != first and not is_like(columns[one], columns[first])
    )
    return Pair(first, second, share, rivals, others)


def is_clearly_better(share: float, another: float) -> bool:
    """Whether what one motion leaves of a force is less than half of what another one leaves."""
    return another < share - (1.0 - share)


def likely_displacements(columns: Mapping[str, np.ndarray]) -> list[str]:
    """The columns that may be a displacement, as another one loses work over them and grows with them.

    One alone where it clearly explains another one better than it is explained by it, as a deflection tells the force
    of a specimen with friction, which does not tell the deflection back. Else those that need no other sign.
    """
    ways: dict[str, list[tuple[float, float, bool]]] = {}
    for first, motion in columns.items():
        for name, values in columns.items():
            if name != first and not is_like(motion, values) and (way := _way(motion, values)):
                ways.setdefault(first, []).append(way)
    ahead = {first: max(told)[:2] for first, told in ways.items()}
    order = sorted(ahead, key=lambda name: ahead[name], reverse=True)
    # copies of the first one, as its volts, are no other column
    others = [ahead[name][0] for name in order if not is_like(columns[name], columns[order[0]])]
    if order and ahead[order[0]][0] - max(others, default=0.0) > 1.0 - ahead[order[0]][1]:
        return order[:1]
    return [name for name in order if any(straight for _, _, straight in ways[name])] or order


def _way(motion: np.ndarray, force: np.ndarray) -> tuple[float, float, bool] | None:
    """By how much a motion explains a force better than the reverse, how well, and whether no sign is to be turned.

    None for what cannot be a force over this motion.
    """
    share = explained(motion, force)
    first, second, _ = find_signs(motion, force)
    signed = first * motion, second * force
    if share < MOSTLY or lost_work(*signed) < THIN or falls(*signed):
        return None
    return share - explained(force, motion), share, first == second


def goes_with_clock(values: np.ndarray) -> bool:
    """Whether a column nearly only grows, or falls, over the record, as a temperature or a counter does."""
    ranks = np.argsort(np.argsort(values, kind="stable"), kind="stable")
    return abs(correlation(ranks.astype(float), np.arange(float(values.size)))) > _WITH_CLOCK


def is_like(values: np.ndarray, other: np.ndarray) -> bool:
    """Whether two columns are one signal, up to scale and zero."""
    return abs(correlation(values, other)) > SAME


def is_like_any(values: np.ndarray, others: Iterable[np.ndarray]) -> bool:
    """Whether a column is one of these signals once more."""
    return any(is_like(values, other) for other in others)


def _scaled(values: np.ndarray) -> np.ndarray:
    spread = float(np.std(values))
    return (values - np.mean(values)) / spread if spread > 0.0 else np.zeros_like(values)

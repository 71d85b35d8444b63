"""Which two columns are displacement and force: how well the one explains the other, and whether work is lost."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from dashpot.data.importing.correlation import correlation

# from this correlation on two columns are one signal
SAME = 0.9995
_SAMPLES = 4000
# a testing machine of class 1 after ISO 7500-1 may make so wide a loop of a force without any
_THIN = 0.015


@dataclass(frozen=True)
class Pair:
    """Two columns, the share of the force that the motion explains, and other columns that may be the force.

    These are as well explained as far as the pair itself leaves open.
    """

    displacement: str
    force: str
    explained: float
    rivals: tuple[str, ...] = ()


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
    way, middle = np.diff(motion), _middle(force - np.mean(force))
    moved = float(np.sum(np.abs(middle * way)))
    return moved > 0.0 and abs(float(middle @ way)) > _THIN * moved


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
                found[first, second] = share > 0.5 and loses_work(columns[first], columns[second]), share
    if not found:
        return None
    first, second = max(found, key=lambda pair: found[pair])
    lossy, share = found[first, second]
    rivals = (
        other
        for (one, other), (also, another) in found.items()
        if one == first and other != second and also == lossy and another >= share - (1.0 - share)
    )
    return Pair(first, second, share, tuple(rivals))


def likely_displacement(columns: Mapping[str, np.ndarray]) -> str | None:
    """The column that explains another one better than it is explained by it; None where none does so clearly.

    A deflection tells the force of a specimen with friction, which does not tell the deflection back.
    """
    ahead = {}
    for first, motion in columns.items():
        others = [(name, values) for name, values in columns.items() if name != first and not is_like(motion, values)]
        shares = [(explained(motion, values), explained(values, motion)) for _, values in others]
        ahead[first] = max(((there - back, there) for there, back in shares), default=(0.0, 0.0))
    order = sorted(ahead, key=lambda name: ahead[name], reverse=True)
    best, second = (*order, *order)[:2]
    open_share = 1.0 - ahead[best][1]
    alone = len(order) == 1 or ahead[best][0] - ahead[second][0] > open_share
    return best if ahead[best][0] > 0.0 and alone else None


def is_like(values: np.ndarray, other: np.ndarray) -> bool:
    """Whether two columns are one signal, up to scale and zero."""
    return abs(correlation(values, other)) > SAME


def is_like_any(values: np.ndarray, others: Iterable[np.ndarray]) -> bool:
    """Whether a column is one of these signals once more."""
    return any(is_like(values, other) for other in others)


def _scaled(values: np.ndarray) -> np.ndarray:
    spread = float(np.std(values))
    return (values - np.mean(values)) / spread if spread > 0.0 else np.zeros_like(values)


def _middle(values: np.ndarray) -> np.ndarray:
    return 0.5 * (values[1:] + values[:-1])

"""Answers to the blocks of a search: from the record of an interrupted one first, then freshly evaluated."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from dashpot.contract.optimizer import Needs, losses_of

Evaluate: TypeAlias = Callable[[np.ndarray], np.ndarray]


class ReplayError(Exception):
    """The record is not of this search."""


@dataclass(frozen=True, eq=False)
class Block:
    """What was asked, points (lanes, n), and told, losses (lanes,) or residuals (lanes, samples).

    values may be None, where residuals are too many to be kept: they are evaluated again.
    """

    points: np.ndarray
    values: np.ndarray | None


class Answers:
    """Answers blocks from the record while it lasts, then by evaluation."""

    def __init__(
        self,
        losses: Evaluate,
        residuals: Evaluate,
        recorded: Iterable[Block] = (),
        keep: Callable[[Block], None] | None = None,
    ):
        self._evaluate: dict[Needs, Evaluate] = {"losses": losses, "residuals": residuals}
        self._recorded = iter(recorded)
        self._keep = keep
        self._count = 0

    def full(self, points: np.ndarray, needs: Needs) -> tuple[np.ndarray, np.ndarray]:
        """Values and losses of a whole block, kept for a later replay when it is new."""
        block = next(self._recorded, None)
        self._count += 1
        if block is not None:
            self._check(block, points)
        if block is not None and block.values is not None:
            return _checked(block.values, points, needs)
        values, losses = self.part(points, needs)
        if block is None and self._keep is not None:
            self._keep(Block(points, values))
        return values, losses

    def part(self, points: np.ndarray, needs: Needs) -> tuple[np.ndarray, np.ndarray]:
        """Values and losses of points that are not a whole block; not kept."""
        return _checked(self._evaluate[needs](points), points, needs)

    def _check(self, block: Block, points: np.ndarray) -> None:
        if block.points.shape == points.shape and block.points.tobytes() == points.tobytes():
            return
        raise ReplayError(
            f"block {self._count} of the record: expected the points that were recorded, "
            f"{_outline(block.points)}, the optimizer asked for {_outline(points)}. The record belongs to another "
            "optimizer, option, seed, start or version; start again without it"
        )


def _checked(values: np.ndarray, points: np.ndarray, needs: Needs) -> tuple[np.ndarray, np.ndarray]:
    """The values with every failed lane +inf throughout, and their losses; the evaluated array is left as it is."""
    values = np.asarray(values, dtype=float)
    shape = (len(points),) if needs == "losses" else (len(points), values.shape[-1] if values.ndim else 0)
    if values.shape != shape or 0 in shape:
        raise ValueError(f"expected {needs} for {len(points)} lanes, got an array of shape {values.shape}")
    losses = losses_of(values)
    failed = np.isinf(losses)
    if failed.any():
        values = values.copy()
        values[failed] = np.inf
    return values, losses


def _outline(points: np.ndarray) -> str:
    with np.printoptions(precision=17, threshold=4):
        return f"{points.shape[0]} x {points.shape[-1]} from {points[0]}"

"""The numbers behind a figure as one tidy table, to which the traces refer."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

Reference = dict[str, Any]


class TidyTable:
    """Grows block by block (one block a run, say); `columns` at the end hold every block, one below the other."""

    def __init__(self, *headings: str) -> None:
        self._blocks: dict[str, list[np.ndarray]] = {heading: [] for heading in headings}
        self._length = 0

    def add(self, block: Mapping[str, Any]) -> dict[str, Reference]:
        """Append a block of equally long arrays; a scalar stands for all its rows, a heading left out for no value.

        Returns what a trace writes instead of each array.
        """
        length = max(np.size(values) for values in block.values())
        start, self._length = self._length, self._length + length
        for heading, blocks in self._blocks.items():
            blocks.append(np.broadcast_to(np.asarray(block.get(heading, np.nan)), (length,)))
        return {heading: {"column": heading, "rows": [start, self._length]} for heading in block}

    @property
    def columns(self) -> dict[str, np.ndarray]:
        return {heading: _joined(blocks) for heading, blocks in self._blocks.items()}


def _joined(blocks: list[np.ndarray]) -> np.ndarray:
    if not blocks:
        return np.empty(0)
    # a column that holds texts anywhere holds objects, so that its numbers stay numbers
    if any(block.dtype.kind not in "fiub" for block in blocks):
        blocks = [block.astype(object) for block in blocks]
    return np.concatenate(blocks)

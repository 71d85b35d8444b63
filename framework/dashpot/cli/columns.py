"""Rows of text in aligned columns."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest


def in_columns(rows: Sequence[Sequence[str]]) -> str:
    """The rows as lines, each column as wide as its longest cell."""
    widths = [max(len(cell) for cell in column) for column in zip_longest(*rows, fillvalue="")]
    lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=False)) for row in rows)
    return "\n".join(line.rstrip() for line in lines)

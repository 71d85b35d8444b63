"""The rows of a file that can be used: text, empty cells and what fills up its last block are left out."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

# numbers beyond that were not measured
_LARGEST = 1e30


def numeric(values: np.ndarray) -> np.ndarray:
    """The numbers of a column (n,); NaN where a text stands, or a number that nobody measures."""
    if values.dtype == object:
        values = np.array([np.nan if isinstance(value, str) else value for value in values])
    numbers = np.asarray(values, dtype=float)
    return np.where(np.abs(numbers) > _LARGEST, np.nan, numbers)


def usable_rows(columns: Iterable[np.ndarray]) -> tuple[int, int]:
    """The first row and the one past the last (from 0) between which the ends of all columns are numbers.

    At most a tenth is cut off; holes in the middle stay.
    """
    sound = np.all([np.isfinite(values) for values in columns], axis=0)
    places = np.flatnonzero(sound)
    if not places.size:
        return 0, len(sound)
    first, last = int(places[0]), int(places[-1]) + 1
    return (first, last) if last - first >= 0.9 * len(sound) else (0, len(sound))


def without_filling(columns: Iterable[np.ndarray]) -> int:
    """The row past the last (from 0) that is not zero in every column, as where zeros fill up the last block of a file.

    All rows where that is a single zero, which may have been measured, or more than half of the file.
    """
    moved = np.any([values != 0.0 for values in columns], axis=0)
    filled = int(np.argmax(moved[::-1]))
    return len(moved) - filled if 1 < filled <= 0.5 * len(moved) else len(moved)


def of_one_length(columns: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The columns that belong together: those of the length that most of them have, the longer one of two."""
    lengths = [len(values) for values in columns.values()]
    usual = max(set(lengths), key=lambda length: (lengths.count(length), length))
    return {name: values for name, values in columns.items() if len(values) == usual}

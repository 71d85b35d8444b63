"""Names of columns that are names and stand for one column each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence


def distinct(names: Sequence[str], kind: str) -> list[str]:
    """Unique names as they are, others with their number: `force (channel 3)`; empty ones are `channel 3`.

    `kind` is the word before the number.
    """
    count = Counter(names)
    return [
        name if name and count[name] == 1 else f"{name} ({kind} {number})" if name else f"{kind} {number}"
        for number, name in enumerate(names, 1)
    ]

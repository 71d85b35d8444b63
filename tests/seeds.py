"""The seeds of tests: fixed, so that a test that passed will pass; drawn anew by ``pytest -m random``.

All seeds of a session come from one number, DRAW_SEEDS, with the name of each draw; without it from the names alone.
"""

from __future__ import annotations

import os
import sys
from collections import defaultdict
from zlib import crc32

DRAWN: defaultdict[str, list[str]] = defaultdict(list)  # what each module drew, in words


def seed_of(name: str) -> int:
    """The seed of a draw, by a name of its own; it stands with a failure, so that the draw can be repeated."""
    seed = crc32(f"{os.environ.get('DRAW_SEEDS', '')} {name}".strip().encode())
    told = f"seed {seed} ({name})"
    DRAWN[sys._getframe(1).f_globals["__name__"]].append(told)
    print(told)
    return seed

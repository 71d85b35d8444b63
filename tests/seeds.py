"""The seeds of tests: fixed, so that a test that passed will pass; drawn anew where DRAW_SEEDS is set."""

from __future__ import annotations

import os
from zlib import crc32


def seed_of(name: str) -> int:
    """The seed of a test, by a name of its own, printed so that a draw can be repeated."""
    seed = int.from_bytes(os.urandom(4), "little") if os.environ.get("DRAW_SEEDS") else crc32(name.encode())
    print(f"seed {seed}")
    return seed

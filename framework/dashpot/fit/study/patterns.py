"""Names with `*` for any text and `?` for any character; brackets mean themselves, as in `spring.stiffness[3]`."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache


def chosen(name: str, patterns: Iterable[str]) -> bool:
    """Whether one of the patterns names it."""
    return any(_expression(pattern).fullmatch(name) for pattern in patterns)


def is_wild(pattern: str) -> bool:
    """Whether a pattern may stand for several names."""
    return "*" in pattern or "?" in pattern


@cache
def _expression(pattern: str) -> re.Pattern[str]:
    parts = ({"*": ".*", "?": "."}.get(character, re.escape(character)) for character in pattern)
    return re.compile("".join(parts), re.DOTALL)

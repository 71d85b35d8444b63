"""Names with `*` for any text and `?` for any character; brackets mean themselves, as in `spring.stiffness[3]`."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from functools import cache


def chosen(name: str, patterns: Iterable[str]) -> bool:
    """Whether one of the patterns names it."""
    return any(_expression(pattern).fullmatch(name) for pattern in patterns)


def nameless(patterns: Collection[str], things: Collection[Iterable[str]]) -> list[str]:
    """The patterns that are wrong: they name none of the things, each of which may go by several names.

    Where some of the patterns name things, those with wildcards may name none.
    """
    idle = [pattern for pattern in patterns if not any(chosen(name, [pattern]) for names in things for name in names)]
    return [pattern for pattern in idle if not is_wild(pattern)] or (idle if len(idle) == len(patterns) else [])


def is_wild(pattern: str) -> bool:
    """Whether a pattern may stand for several names."""
    return "*" in pattern or "?" in pattern


@cache
def _expression(pattern: str) -> re.Pattern[str]:
    parts = ({"*": ".*", "?": "."}.get(character, re.escape(character)) for character in pattern)
    return re.compile("".join(parts), re.DOTALL)

"""Two versions of a text, line by line."""

from __future__ import annotations

import difflib


def diff(before: str, after: str) -> str:
    """The whole of both texts, each line marked: "+ " came, "- " went, "  " stayed."""
    old, new = (text.removesuffix("\n").split("\n") for text in (before, after))
    matcher = difflib.SequenceMatcher(a=old, b=new, autojunk=False)
    marked: list[str] = []
    for kind, a, b, c, d in matcher.get_opcodes():
        if kind == "equal":
            marked += [f"  {line}" for line in old[a:b]]
        else:
            marked += [f"- {line}" for line in old[a:b]] + [f"+ {line}" for line in new[c:d]]
    return "\n".join(marked)

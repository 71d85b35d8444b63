"""Names that become names of files and stand in reports: what they may not contain."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from unicodedata import category

LONGEST = 120
# of 255 that file systems take: results and records append kinds, numbers and endings
MOST_BYTES = 200
UNFIT = frozenset('/\\:*?"<>|')
# control characters, those that turn the direction of writing or cannot be seen, and ends of lines
UNSEEN = ("Cc", "Cf", "Cs", "Zl", "Zp")
RULE = (
    "leave out / \\ : * ? \" < > |, invisible characters and a leading '.', "
    f"and take {LONGEST} characters, and {MOST_BYTES} bytes in UTF-8, at most"
)


def is_name(text: str) -> bool:
    """Whether a text can be the name of a network or run, as ``RULE`` says."""
    fitting = all(sign not in UNFIT and category(sign) not in UNSEEN for sign in text)
    short = fitting and 0 < len(text) <= LONGEST and len(text.encode()) <= MOST_BYTES
    return short and not text.startswith(".") and text == text.strip()


def shown(text: str) -> str:
    """A text in quotes, with what cannot be seen written out, and not all of it where it is too long."""
    seen = visible(text[:LONGEST])
    return f"'{seen}'" if len(text) <= LONGEST else f"'{seen}...' of {len(text)} characters"


def visible(text: str, kept: str = "") -> str:
    """A text with what cannot be seen written out, but for the signs that are ``kept``.

    A terminal obeys control characters, and a text that turns its direction reads as another one.
    """
    return "".join(sign if sign in kept or category(sign) not in UNSEEN else f"\\u{ord(sign):04x}" for sign in text)


def joined_name(name: str, words: Sequence[str]) -> str:
    """A name followed by words, with ``+`` between them: as many words as it may have, then how many more there are."""
    for count in range(len(words), 0, -1):
        left = [f"{len(words) - count}_more"] * (count < len(words))
        if is_name(found := "+".join([name, *words[:count], *left])):
            return found
    more = f"+{len(words)}_more"
    return f"{start_of(name[: LONGEST - len(more)], MOST_BYTES - len(more))}{more}"


def shortened(text: str) -> str:
    """A text that is made of several names, as part of the name of a file: a long one ends with its digest."""
    whole = text.encode(errors="surrogatepass")
    if len(whole) <= MOST_BYTES:
        return text
    end = f"-{hashlib.sha256(whole).hexdigest()[:16]}"
    return f"{start_of(text, MOST_BYTES - len(end))}{end}"


def start_of(text: str, count: int) -> str:
    """The whole characters that the first ``count`` bytes of a text in UTF-8 hold."""
    return text.encode(errors="surrogatepass")[:count].decode(errors="ignore")

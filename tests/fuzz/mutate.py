"""Files made from sound ones by the accidents that happen to files, and by worse ones."""

from __future__ import annotations

import random
import re
import struct

_WORDS = [0, 1, 0x7F, 0x80, 0xFF, 0x7FFF, 0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF]
_NUMBERS = [
    b"0",
    b"-1",
    b"1e308",
    b"-1e-308",
    b"nan",
    b"inf",
    b"99999999999999999999",
    b"1,5",
    b"1.2.3",
    b"",
    b'"',
    b"x" * 40,
]


def flip(content: bytearray, chance: random.Random) -> None:
    """One bit the other way round."""
    content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)


def scramble(content: bytearray, chance: random.Random) -> None:
    """A few bytes replaced by random ones."""
    start = chance.randrange(len(content))
    size = min(chance.choice([1, 2, 4, 16, 64]), len(content) - start)
    content[start : start + size] = chance.randbytes(size)


def set_word(content: bytearray, chance: random.Random) -> None:
    """A number of two, four or eight bytes replaced by one at an edge of its range."""
    word = struct.pack(chance.choice("<>") + "Q", chance.choice(_WORDS))
    size = chance.choice([2, 4, 8])
    start = chance.randrange(max(1, len(content) - size))
    content[start : start + size] = word[:size] if word[0] else word[-size:]


def cut(content: bytearray, chance: random.Random) -> None:
    """The end lost."""
    del content[chance.randrange(len(content)) :]


def lose(content: bytearray, chance: random.Random) -> None:
    """A piece lost."""
    start = chance.randrange(len(content))
    del content[start : start + chance.choice([1, 3, 8, 100, 512])]


def repeat(content: bytearray, chance: random.Random) -> None:
    """A piece written twice."""
    start = chance.randrange(len(content))
    piece = content[start : start + chance.choice([1, 8, 100, 512])]
    place = chance.randrange(len(content))
    content[place:place] = piece


def renumber(content: bytearray, chance: random.Random) -> None:
    """A number written in digits replaced by something else."""
    found = list(re.finditer(rb"[0-9.]+", bytes(content)))
    if found:
        match = chance.choice(found)
        content[match.start() : match.end()] = chance.choice(_NUMBERS)


def insert(content: bytearray, chance: random.Random) -> None:
    """Signs that mean something in text files, put in."""
    place = chance.randrange(len(content))
    content[place:place] = chance.choice(
        [b"\n", b"\r", b"\0", b";", b",", b"\t", b'"', b"#", b"{", b"[", b"\xff\xfe", b"**"]
    )


_WAYS = (flip, flip, scramble, set_word, set_word, cut, lose, repeat, renumber, insert)


def mutated(sound: bytes, chance: random.Random) -> bytes:
    """The content after one to six accidents."""
    content = bytearray(sound)
    for _ in range(chance.choice([1, 1, 2, 3, 6])):
        if content:
            chance.choice(_WAYS)(content, chance)
    return bytes(content)

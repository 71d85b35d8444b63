"""What merely counts in the names of runs: those that differ by more were measured under other conditions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

Words = tuple[str, ...]

_CLOCK = r"[T_ -]+\d{2}[-:.h]?\d{2}(?:[-:.m]?\d{2})?s?"
_DATE = re.compile(
    rf"(?<!\d)(?:\d{{4}}[-._]\d{{2}}[-._]\d{{2}}|\d{{2}}[-._]\d{{2}}[-._]\d{{4}}|\d{{6}}|\d{{8}}|\d{{12}}|\d{{14}})"
    rf"(?:{_CLOCK})?(?![A-Za-z\d])"
)
# a point or comma between digits belongs to the number, a minus before one that stands alone, too
_BETWEEN = re.compile(r"(?:[\s_()\[\]#]|(?<=[^\s_])-|-(?!\d)|(?<!\d)[.,]|[.,](?!\d))+")
_AGAIN = re.compile(r"(?:rep[a-z]*|rerun|wdh|wiederholung|copy|kopie|again|nochmal)\d*|r\d+", re.I)
_TESTS = r"run|test|trial|lauf|messung|versuch|no|nr|num|rec|record|file|datei|sheet|tabelle|table"
_NUMBERED = re.compile(rf"(?:{_TESTS})\d+", re.I)
_ORDER = re.compile(r"([A-Za-z]*)(\d+)")


def without_counters(names: Iterable[str]) -> dict[str, Words]:
    """The words of each name that tell conditions: without dates, numbers of tests, and marks of repetition.

    A number at the beginning, or one or a letter at the end, counts where those of all names go on one by one: of
    those from the first to the last at least half are there. Other numbers tell something, as `T23`, `T40` and `T60`.

    Examples:
        >>> without_counters(["03_sine_open", "04_sine_open_2", "05_sine_closed"])
        {'03_sine_open': ('sine', 'open'), '04_sine_open_2': ('sine', 'open'), '05_sine_closed': ('sine', 'closed')}
        >>> without_counters(["sine_T23", "sine_T40"])
        {'sine_T23': ('sine', 't23'), 'sine_T40': ('sine', 't40')}
    """
    words = _without_order({name: _words(name) for name in names})
    while (left := _without_ends(words)) != words:
        words = left
    return words


def _words(name: str) -> Words:
    found: list[str] = []
    parts = [part for part in _BETWEEN.split(_DATE.sub(" ", name)) if part]
    for before, part in zip(["", *parts], parts, strict=False):
        if part.isdigit() and re.fullmatch(_TESTS, before, re.I):
            found.pop()
        elif not _AGAIN.fullmatch(part) and not _NUMBERED.fullmatch(part):
            found.append(part.lower())
    return tuple(found)


def _without_order(words: Mapping[str, Words]) -> dict[str, Words]:
    """Without the place in the order of the tests that names begin with, as `m03_` or `shock_03_`."""
    series: dict[str, list[int]] = {}
    begins = {name: found for name, each in words.items() if (found := _order(each))}
    for title, number, _ in begins.values():
        series.setdefault(title, []).append(number)
    counted = {title for title, numbers in series.items() if len(set(numbers)) == len(numbers) > 1 and _go_on(numbers)}
    return {
        name: begins[name][2] if name in begins and begins[name][0] in counted else each for name, each in words.items()
    }


def _order(words: Words) -> tuple[str, int, Words] | None:
    """What a name begins with, the number there, and the words behind it."""
    for count in (1, 2):
        match = _ORDER.fullmatch("".join(words[:count]))
        if match and (count == 1 or words[1].isdigit()):
            return match[1], int(match[2]), words[count:]
    return None


def _without_ends(words: Mapping[str, Words]) -> dict[str, Words]:
    """Without a number or a letter at the end of which the names with the same words have one each."""
    ends: dict[Words, list[int]] = {each: [1] for each in words.values() if each}
    for each in set(words.values()):
        if each and (number := _number(each[-1])) is not None:
            ends.setdefault(each[:-1], []).append(number)
    return {
        name: each[:-1]
        if each and _number(each[-1]) is not None and _go_on(_alike(ends[each[:-1]], each[-1]))
        else each
        for name, each in words.items()
    }


def _number(word: str) -> int | None:
    """A number as one, and a letter as its place in the alphabet, below 0 to be told from numbers; else None."""
    if word.isdigit():
        return int(word)
    return -(ord(word) - ord("a") + 1) if re.fullmatch("[a-z]", word) else None


def _alike(numbers: Iterable[int], word: str) -> list[int]:
    """Of numbers and letters those of the kind of a word; letters begin with a."""
    letters = not word.isdigit()
    return [abs(number) for number in (*numbers, *([-1] if letters else [])) if (number < 0) == letters]


def _go_on(numbers: Iterable[int]) -> bool:
    found = set(numbers)
    return len(found) >= 0.5 * (max(found) - min(found) + 1)

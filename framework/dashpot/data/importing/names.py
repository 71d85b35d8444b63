"""What the names of files say about the conditions of a run: `bush_40degC`, `25mm0x5Hz0x25A`, `damper_click5`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from dashpot.text.quantity import measure

# unit in a name -> setting, and how the unit is written
_UNITS = {
    "A": ("current", "A"),
    "mA": ("current", "mA"),
    "V": ("voltage", "V"),
    "mV": ("voltage", "mV"),
    "bar": ("pressure", "bar"),
    "mbar": ("pressure", "mbar"),
    "kPa": ("pressure", "kPa"),
    "MPa": ("pressure", "MPa"),
    "psi": ("pressure", "psi"),
    "degC": ("temperature", "degC"),
    "°C": ("temperature", "degC"),
    "grad": ("temperature", "degC"),
    "C": ("temperature", "degC"),
}
_CONDITION = re.compile(
    r"(?:(?<=[_ ])(?P<minus>-|m(?=\d)))?(?<![\d.,])(?P<number>\d+(?:[.,xp]\d+)?)[ _]?"
    rf"(?P<unit>{'|'.join(sorted(map(re.escape, _UNITS), key=len, reverse=True))})(?![A-Za-z])"
)
# word before or behind a number -> setting
_WORDS = {
    **dict.fromkeys("click clicks klick klicks raste".split(), "clicks"),
    **dict.fromkeys("valve ventil".split(), "valve_position"),
    **dict.fromkeys("stage stufe".split(), "stage"),
}
_WORD = "|".join(sorted(_WORDS, key=len, reverse=True))
_NUMBERED = re.compile(
    rf"(?<![A-Za-z])(?:(?P<word>{_WORD})[ _-]?(?P<number>\d+(?:[.,xp]\d+)?)"
    rf"|(?<![.,\d])(?P<before>\d+)[ _-]?(?P<noun>{_WORD}))(?![A-Za-z\d.,])",
    re.I,
)


def conditions_of(name: str) -> dict[str, str]:
    """Settings that the name of a file states, as texts with units; a decimal point may be written as x, p or comma.

    Without units are the positions of a valve, its clicks or stages.

    Examples:
        >>> conditions_of("25mm0x5Hz0x25A")
        {'current': '0.25 A'}
        >>> conditions_of("bush_-20degC_2")
        {'temperature': '-20 degC'}
        >>> conditions_of("damper_click5")
        {'clicks': '5'}
    """
    found: dict[str, str] = {}
    for match in _CONDITION.finditer(name):
        setting, unit = _UNITS[match["unit"]]
        number = re.sub("[,xp]", ".", match["number"])
        found.setdefault(setting, f"{'-' if match['minus'] else ''}{number} {unit}")
    for match in _NUMBERED.finditer(name):
        setting = _WORDS[(match["word"] or match["noun"]).lower()]
        found.setdefault(setting, re.sub("[,xp]", ".", match["number"] or match["before"]))
    return found


def differ(first: Mapping[str, str], second: Mapping[str, str]) -> bool:
    """Whether two runs were measured under other conditions, as far as both state them."""
    return any(measure(first[key]) != measure(second[key]) for key in first.keys() & second.keys())


def stated_by_all(names: Iterable[str]) -> dict[str, dict[str, str]]:
    """The conditions in names, without those that only some of the names state: a letter may mean anything there."""
    found = {name: conditions_of(name) for name in names}
    common = set.intersection(*(set(each) for each in found.values())) if found else set()
    return {name: {key: text for key, text in each.items() if key in common} for name, each in found.items()}

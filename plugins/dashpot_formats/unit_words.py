"""Units as measuring programs write them, in the spelling that datasets know."""

from __future__ import annotations

from functools import lru_cache

from dashpot.text.quantity import is_unit

_WORDS = {
    "s": "sec secs second seconds sek sekunde sekunden",
    "ms": "msec millisec millisecond milliseconds",
    "min": "minute minutes minuten",
    "mm": "millimeter millimetre millimeters",
    "m": "meter metre meters",
    "um": "micron microns mikrometer",
    "in": "inch inches zoll",
    "N": "newton newtons",
    "kN": "kilonewton kilonewtons",
    "kgf": "kp kilopond",
    "lbf": "lbs pounds",
    "m/s^2": "m/s2 m/sec^2 m/sec2 m/s/s m/s**2",
    "mm/s": "mm/sec",
    "m/s": "m/sec",
    "degC": "°c deg_c deg.c c celsius grad_c",
    "deg": "degree degrees grad",
    "V": "volt volts",
    "%": "percent prozent",
    "rpm": "1/min u/min",
}
_BY_WORD = {word: unit for unit, words in _WORDS.items() for word in words.split()}


@lru_cache(maxsize=4096)
def plain_unit(stated: str) -> str:
    """The unit behind a spelling such as `Sek` or `inches`; what nobody knows stays as it is, `-` is no unit."""
    text = stated.strip().strip("[](){}<>").strip()
    if text in ("-", "--", "none", "None", ""):
        return ""
    if is_unit(text):
        return text
    return _BY_WORD.get(text.lower().replace(" ", "_"), _BY_WORD.get(text.lower(), text))


@lru_cache(maxsize=4096)
def names_a_unit(text: str) -> bool:
    """Whether a text is a unit, in whatever spelling."""
    return is_unit(plain_unit(text))

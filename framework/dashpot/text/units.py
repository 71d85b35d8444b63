"""Units as people write them, `N*s/mm` or `kN/(mm/s)`: their exact factors to base units, and what they measure.

The units are our own short list, on purpose: an angle is a dimension of its own (so rad/s never passes for Hz),
`rpm` counts revolutions per minute, and a pound is a mass (the force is `lbf`).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from functools import cache

_PREFIXES = {
    **{"": 0, "nano": -9, "micro": -6, "milli": -3, "centi": -2, "deci": -1, "deca": 1, "hecto": 2, "kilo": 3},
    **{"mega": 6, "giga": 9, "n": -9, "u": -6, "m": -3, "c": -2, "d": -1, "da": 1, "h": 2, "k": 3, "M": 6, "G": 9},
}

# all names of a unit, how many of what it is, and where it has its zero
_UNITS = """
meter m = 1 [length]
second s = 1 [time]
gram g = 1 [mass]
kelvin K = 1 [temperature]
ampere A = 1 [current]
radian rad = 1 [angle]
percent % = 0.01 1
minute min = 60 s
hour h = 3600 s
hertz Hz = 1 1/s
rpm = 1 1/min
inch in = 0.0254 m
foot ft = 12 in
tonne t = 1000 kg
pound lb = 0.45359237 kg
standard_gravity g0 = 9.80665 m/s^2
newton N = 1 kg*m/s^2
kilogram_force kgf = 1 kg*g0
ton_force tonf = 1 t*g0
pound_force lbf = 1 lb*g0
kip = 1000 lbf
newton_second Ns = 1 N*s
newton_meter Nm = 1 N*m
newton_millimeter Nmm = 1 N*mm
pascal Pa = 1 N/m^2
bar = 100000 Pa
psi = 1 lbf/in^2
joule J = 1 N*m
watt W = 1 J/s
volt V = 1 W/A
degree deg = 0.017453292519943295 rad
revolution rev = 360 deg
degree_Celsius degC celsius = 1 K 273.15
"""
_MEANINGS = {
    name: meaning
    for names, meaning in (line.split(" = ") for line in _UNITS.strip().splitlines())
    for name in names.split()
}

_NUMBER = r"-?\d(?:\.\d{1,3})?"
_FACTOR = rf"(?:[A-Za-z%][A-Za-z_]*\d?|1)(?:(?:\^|\*\*)(?:{_NUMBER}|\({_NUMBER}(?:/[1-9])?\)))?"
_BETWEEN = r"(?: *[*/] *| +)"
_GROUP = rf"(?:{_FACTOR}|\({_FACTOR}(?:{_BETWEEN}{_FACTOR}){{0,5}}\)(?:(?:\^|\*\*){_NUMBER})?)"
_PRODUCT = re.compile(rf"{_GROUP}(?:{_BETWEEN}{_GROUP}){{0,5}}")
_NEXT = re.compile(rf"(^|{_BETWEEN})({_GROUP})")
_RAISED = re.compile(r"(?:\((?P<product>.*)\)|(?P<name>[^(^*]*))(?:(?:\^|\*\*)(?P<power>.*))?")
_LONGEST = 80
_SPELLINGS = {
    **{"·": "*", "⋅": "*", "²": "^2", "³": "^3", "μ": "u", "µ": "u", "°C": "degC", "°": "deg", "−": "-"},
    **{" per ": "/", " squared": "^2", " cubed": "^3"},
}


class UnknownUnitError(ValueError):
    """A text that is no unit; its argument is the word at fault."""


@dataclass(frozen=True)
class Unit:
    """A number in this unit times `scale`, plus `offset`, is in base units; `powers` of what it measures, none zero."""

    scale: Decimal = Decimal(1)
    powers: Mapping[str, Fraction] = field(default_factory=dict)
    offset: Decimal = Decimal(0)

    def __mul__(self, other: Unit) -> Unit:
        """The product; the zero of a scale of temperature has no part in one."""
        if self == ONE:
            return other
        sums = dict(self.powers)
        for name, power in other.powers.items():
            sums[name] = sums.get(name, Fraction(0)) + power
        return Unit(self.scale * other.scale, {name: power for name, power in sums.items() if power})

    def __pow__(self, power: Fraction) -> Unit:
        if power == 1:
            return self
        scale = self.scale ** (Decimal(power.numerator) / power.denominator)
        return Unit(scale, {name: each * power for name, each in self.powers.items() if power})


ONE = Unit()


@cache
def read_unit(text: str) -> Unit:
    """The unit that a text stands for. Raises UnknownUnitError for none."""
    plain = text.strip()
    for written, meant in _SPELLINGS.items():
        plain = plain.replace(written, meant)
    if len(plain) > _LONGEST or not _PRODUCT.fullmatch(plain):
        raise UnknownUnitError(plain)
    return _product(plain)


def _product(text: str) -> Unit:
    found = ONE
    for between, factor in _NEXT.findall(text):
        unit = _raised(factor)
        found = found * (unit ** Fraction(-1) if "/" in between else unit)
    return found


def _raised(text: str) -> Unit:
    parts = _RAISED.fullmatch(text)
    assert parts is not None
    unit = _named(parts["name"]) if parts["product"] is None else _product(parts["product"])
    over, _, under = (parts["power"] or "1").strip("()").partition("/")
    return unit ** (Fraction(over) / Fraction(under or "1"))


@cache
def _named(word: str) -> Unit:
    """A unit by its name, with a prefix and in the plural as it may be; a single letter has no plural."""
    if word in ("1", "dimensionless"):
        return ONE
    for prefix, power in _PREFIXES.items():
        stem = word.removeprefix(prefix)
        names = (stem, stem.removesuffix("s")) if len(stem) > 2 else (stem,)
        unit = next((_meaning(name) for name in names if name in _MEANINGS), None)
        if unit and word.startswith(prefix) and not (prefix and unit.offset):
            return Unit(Decimal(10) ** power) * unit
    raise UnknownUnitError(word)


def _meaning(name: str) -> Unit:
    number, of, zero = [*_MEANINGS[name].split(), "0"][:3]
    unit = Unit(powers={of: Fraction(1)}) if of.startswith("[") else _product(of)
    return Unit(Decimal(number) * unit.scale, unit.powers, Decimal(zero))
